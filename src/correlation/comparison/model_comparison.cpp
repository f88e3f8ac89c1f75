// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/model_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "base/clock.h"
#include "base/document_record.h"
#include "base/random.h"
#include "base/text.h"
#include "correlation/comparison/moved_models.h"
#include "correlation/comparison/spectral_bands.h"
#include "correlation/laboratory/virtual_recording.h"
#include "correlation/target/limits_by_name.h"
#include "formats/tables/csv_table.h"
#include "numerics/signals/mean.h"

namespace latsch::correlation {
namespace {

std::unique_ptr<experiment::Test> read_case(const Document& document,
                                            const std::filesystem::path& folder,
                                            const experiment::Language& language,
                                            const Channels* measured) {
  const Node root = document.root();
  experiment::TestSource source{folder, nullptr};
  if (measured)
    source.measured = [measured](const Node& table,
                                 const std::vector<experiment::MeasuredCondition>& conditions) {
      if (table.text("from") != "measurement.reference")
        table.reject("from", "is none, expected \"measurement.reference\"");
      Channels channels;
      for (const auto& one : conditions) {
        const Channel* found = measured->find(one.channel);
        if (!found && !one.is_needed) continue;
        if (!found)
          table.reject("from",
                       "needs the channel " + in_quotes(one.channel) +
                           ", which the reference does not record: name it in recorded");
        channels.add({one.channel, one.unit, found->values});
      }
      return channels;
    };
  auto test = language.read_test(root, source);
  root.close();
  return test;
}

/// Returns the channels that a model records in a test. Sets `limits`, unless it is null, to the
/// limits that the model met.
Channels run_of(const ComparedModel& model,
                const Document& numbers,
                const experiment::Test& test,
                const std::string& name,
                std::vector<std::string>* limits = nullptr) {
  auto channels = recorded_channels(*model.kind, numbers, test, limits);
  if (!channels)
    throw std::runtime_error(
        fmt::format("{} in {}: {}", model.title, name, channels.failure().reason));
  return std::move(*channels);
}

/// Returns the compared samples of every compared channel.
std::vector<std::vector<double>> samples_of(const ModelComparisonFile& file,
                                            const Channels& channels,
                                            const std::string& whose) {
  std::vector<std::vector<double>> samples;
  for (const std::string& name : file.channels)
    samples.push_back(selected_samples(file, channels, name, whose));
  return samples;
}

/// Throws InputError for a channel in the key `told` that no test of the models records.
void check_told(const ModelComparisonFile& file,
                const std::vector<std::unique_ptr<experiment::Test>>& tests) {
  for (const std::string& name : file.told) {
    std::vector<std::string> recorded;
    for (const auto& test : tests)
      for (const experiment::ChannelInfo& channel : test->channels())
        if (std::find(recorded.begin(), recorded.end(), channel.name) == recorded.end())
          recorded.push_back(channel.name);
    if (std::find(recorded.begin(), recorded.end(), name) != recorded.end()) continue;
    throw InputError(
        {file.file.string(), 0},
        fmt::format(
            "told has {}, which no test records{}", in_quotes(name), did_you_mean(name, recorded)));
  }
}

ModelRun run_model(const ModelComparisonFile& file,
                   const ComparedModel& model,
                   const experiment::Test& test,
                   const ComparedCase& one,
                   const std::vector<FitPosterior>& fits,
                   const CaseComparison& compared) {
  const auto& reference = compared.reference;
  ModelRun run;
  const double begin = thread_cpu_seconds();
  const Channels channels = run_of(model, model.numbers, test, one.name, &run.limits);
  run.cpu = thread_cpu_seconds() - begin;
  run.times = selected_samples(file, channels, "time", model.title);
  run.samples = samples_of(file, channels, model.title);
  run.densities = densities_of(file, channels, model.title);
  for (std::size_t c = 0; c < reference.size(); ++c)
    if (run.densities[c].value.size() != reference[c].value.size() ||
        std::abs(run.densities[c].frequency.back() - reference[c].frequency.back()) > 1e-3)
      throw InputError({file.file.string(), 0},
                       fmt::format("{} in {} is not sampled like the reference: expected the same "
                                   "sample_step, run_in and duration in both tests",
                                   model.title,
                                   one.name));
  for (const std::string& name : file.told)
    run.told.push_back(channels.find(name)
                           ? numerics::mean(selected_samples(file, channels, name, model.title))
                           : std::nan(""));
  std::vector<MovedDensities> others;
  int beyond = 0, count = 0;
  for (const MovedModel& moved : band_models(file, model, fits)) {
    std::vector<std::string> limits;
    others.push_back(
        {densities_of(file, run_of(model, moved.numbers, test, one.name, &limits), model.title),
         moved.count});
    ++count;
    if (limits.size() > run.limits.size()) ++beyond;
  }
  if (beyond > 0)
    run.limits.push_back(fmt::format(
        "{} of {} models moved for the bands met limits that the model itself did not, ranges of "
        "its file or the loss of the road: the bands are too narrow there",
        beyond,
        count));
  add_bands(file, model, fits, others, run);
  compare_run(file, compared, run);
  return run;
}

/// Calls work(0) ... work(count - 1), distributed over this number of threads, and rethrows the
/// first exception.
void share_out(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::mutex guard;
  std::exception_ptr trouble;
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (!trouble) trouble = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(take);
  take();
  for (std::thread& other : others) other.join();
  if (trouble) std::rethrow_exception(trouble);
}

}  // namespace

std::vector<std::string> limits_of_models(const ModelComparisonFile& file,
                                          const ModelComparison& comparison) {
  LimitsByName limits;
  for (std::size_t i = 0; i < file.cases.size(); ++i)
    for (const std::string& limit : comparison.cases[i].limits_of_reference)
      limits.add(file.reference.title + ": " + limit, file.cases[i].name);
  for (std::size_t m = 0; m < file.models.size(); ++m)
    for (std::size_t i = 0; i < file.cases.size(); ++i)
      for (const std::string& limit : comparison.cases[i].models[m].limits)
        limits.add(file.models[m].title + ": " + limit, file.cases[i].name);
  return limits.before_names();
}

double ModelRun::mean_distance(std::size_t band) const { return numerics::mean(distance[band]); }
double ModelRun::mean_decibels(std::size_t band) const { return numerics::mean(decibels[band]); }

Channels record_reference(const ModelComparisonFile& file,
                          std::size_t index,
                          const experiment::Language& language,
                          std::vector<std::string>* limits) {
  const ComparedCase& one = file.cases[index];
  const auto test =
      read_case(one.reference_test, file.tests[one.test].reference_folder, language, nullptr);
  const Channels clean = run_of(file.reference, file.reference.numbers, *test, one.name, limits);
  for (const auto& [name, deviation] : file.noise)
    if (!clean.find(name))
      throw InputError({file.file.string(), 0},
                       "reference.noise." + name +
                           " is of a channel that the reference does not record; expected one of "
                           "the compared channels");
  Channels noisy;
  std::uint64_t number = 64 * index;  // random stream, different for each channel of each case
  for (Channel channel : clean.all()) {
    RandomStream random(static_cast<std::uint64_t>(file.seed), number++);
    if (const auto noise = file.noise.find(channel.name); noise != file.noise.end())
      for (double& value : channel.values) value += noise->second * random.normal();
    noisy.add(std::move(channel));
  }
  return noisy;
}

Channels kept_of(const ModelComparisonFile& file, const Channels& all) {
  std::vector<std::string> names = {"time"};
  names.insert(names.end(), file.channels.begin(), file.channels.end());
  names.insert(names.end(), file.recorded.begin(), file.recorded.end());
  Channels kept;
  for (const std::string& name : names) {
    const Channel* channel = all.find(name);
    if (!channel)
      throw InputError({file.file.string(), 0}, "the reference does not record " + in_quotes(name));
    if (!kept.find(name)) kept.add(*channel);
  }
  return kept;
}

Channels reference_of(const ModelComparisonFile& file,
                      std::size_t index,
                      const experiment::Language& language,
                      std::vector<std::string>* limits) {
  const std::size_t source = file.find_case(file.cases[index].recording);
  if (file.recordings.empty())
    return kept_of(file, record_reference(file, source, language, limits));
  const auto recording = recording_file(file, source);
  if (file.is_virtual)
    if (const std::string why = why_to_record(recording, recipe_of_case(file, source, language));
        !why.empty())
      throw InputError({file.file.string(), 0},
                       fmt::format("the recording {} of {} is virtual, and {}. Expected: latsch "
                                   "run {}, which records it",
                                   in_quotes(recording.string()),
                                   file.reference.title,
                                   why,
                                   file.file.string()));
  return formats::CsvTable::read(recording).channels();
}

std::filesystem::path recording_file(const ModelComparisonFile& file, std::size_t index) {
  return file.recordings / (file.cases[index].name + ".csv");
}

std::string recipe_of_case(const ModelComparisonFile& file,
                           std::size_t index,
                           const experiment::Language& language) {
  const ComparedCase& one = file.cases[index];
  const DocumentRecord record(one.reference_test.root());
  const auto read = language.read_identified_test(record.node(),
                                                  {file.tests[one.test].reference_folder, nullptr});
  std::string text =
      file.reference.kind->name() + "\n" + canonical_text(file.reference.numbers) + read.identity;
  if (!file.noise.empty()) text += fmt::format("seed {} of case {}\n", file.seed, index);
  for (const auto& [channel, deviation] : file.noise)
    text += channel + " " + canonical(deviation, "1") + "\n";
  return fingerprint(text);
}

bool is_recorded_here(const ModelComparisonFile& file, std::size_t index) {
  return file.cases[index].recording == file.cases[index].name;
}

namespace {

/// Sets the models to the best points of their fits.
ModelComparisonFile at_fits(ModelComparisonFile file, const std::vector<FitPosterior>& fits) {
  for (ComparedModel& model : file.models) {
    for (const std::size_t k : model.fits)
      move_to(file.fits[k], file.fits[k].study->space.to_unit(fits[k].point), model.numbers);
    model.kind->check(model.numbers);
  }
  return file;
}

}  // namespace

ModelComparison compare_models(const ModelComparisonFile& as_written,
                               const experiment::Language& language,
                               int threads,
                               const std::function<void(long, long)>& tell) {
  ModelComparison all;
  for (const FitSource& source : as_written.fits)
    all.fits.push_back(fit_posterior(source, as_written.segment));
  const ModelComparisonFile file = at_fits(as_written, all.fits);
  const std::size_t count = file.cases.size();
  all.cases.resize(count);
  std::vector<std::unique_ptr<experiment::Test>> tests(count);
  share_out(count, threads, [&](std::size_t i) {
    const Channels recording = reference_of(file, i, language, &all.cases[i].limits_of_reference);
    for (const std::string& name : file.channels)
      all.cases[i].units.push_back(recording.find(name) ? recording.find(name)->unit : "");
    all.cases[i].times = selected_samples(file, recording, "time", file.reference.title);
    all.cases[i].samples = samples_of(file, recording, file.reference.title);
    all.cases[i].reference = densities_of(file, recording, file.reference.title);
    check_power(file, all.cases[i].reference);
    all.cases[i].noise = noise_of(file, recording);
    all.cases[i].models.resize(file.models.size());
    const Channels conditions = low_passed(file, recording);
    tests[i] = read_case(
        file.cases[i].model_test, file.tests[file.cases[i].test].folder, language, &conditions);
  });
  check_told(file, tests);
  std::mutex guard;
  long done = 0;
  const std::size_t runs = count * file.models.size();
  share_out(runs, threads, [&](std::size_t k) {
    const std::size_t i = k / file.models.size(), m = k % file.models.size();
    all.cases[i].models[m] =
        run_model(file, file.models[m], *tests[i], file.cases[i], all.fits, all.cases[i]);
    const std::lock_guard lock(guard);
    if (tell) tell(++done, static_cast<long>(runs));
  });
  if (file.pictures) {
    const auto [model, index] = *file.pictures;
    const ComparedModel& shown = file.models[model];
    auto details = tests[index]->details(*shown.kind->build(shown.numbers));
    if (!details) throw std::runtime_error(details.failure().reason);
    all.pictures = std::move(details->pictures);
  }
  return all;
}

}  // namespace latsch::correlation
