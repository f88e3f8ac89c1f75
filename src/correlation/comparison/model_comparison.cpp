// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/model_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <exception>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "base/random.h"
#include "base/text.h"
#include "formats/tables/csv_table.h"
#include "measurement/band_level.h"
#include "numerics/signals/butterworth.h"

namespace latsch::correlation {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double rate_of(const Channels& channels) {
  const auto& time = channels["time"];
  return static_cast<double>(time.size() - 1) / (time.back() - time.front());
}

/// One way, from the steady state of its first 20 ms: what comes later does not reach back.
Channels low_passed(const Channels& recording, double edge) {
  if (edge == 0.0) return recording;
  constexpr double kFirst = 0.02;  // s
  const double rate = rate_of(recording);
  const auto filter =
      numerics::polynomials_of(numerics::butterworth(2, numerics::Band::low_pass, {edge}, rate));
  const auto rest = numerics::steady_state(filter);
  Channels channels;
  for (Channel channel : recording.all()) {
    if (channel.name != "time") {
      const auto first = std::clamp<std::size_t>(
          static_cast<std::size_t>(kFirst * rate), 1, channel.values.size());
      const double level = mean(
          {channel.values.begin(), channel.values.begin() + static_cast<std::ptrdiff_t>(first)});
      std::vector<double> state = rest;
      for (double& value : state) value *= level;
      channel.values = numerics::filter(filter, channel.values, state);
    }
    channels.add(std::move(channel));
  }
  return channels;
}

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
                       "takes the channel " + in_quotes(one.channel) +
                           ", which the reference does not record: name it in recorded");
        channels.add({one.channel, one.unit, found->values});
      }
      return channels;
    };
  auto test = language.read_test(root, source);
  root.close();
  return test;
}

Channels run_of(const ComparedModel& model,
                const Document& numbers,
                const experiment::Test& test,
                const std::string& name) {
  auto channels = test.run(*model.kind->build(numbers));
  if (!channels)
    throw std::runtime_error(
        fmt::format("{} in {}: {}", model.title, name, channels.failure().reason));
  return std::move(*channels);
}

/// The samples that count of a channel.
std::vector<double> counted(const ModelComparisonFile& file,
                            const Channels& channels,
                            const std::string& name,
                            const std::string& whose) {
  const Channel* channel = channels.find(name);
  if (!channel)
    throw InputError({file.file.string(), 0}, whose + " does not record " + in_quotes(name));
  if (!file.has_from || channel->values.size() != channels["time"].size()) return channel->values;
  const auto& time = channels["time"];
  const auto first = std::lower_bound(time.begin(), time.end(), file.from - 1e-9) - time.begin();
  return {channel->values.begin() + first, channel->values.end()};
}

std::vector<numerics::Density> densities_of(const ModelComparisonFile& file,
                                            const Channels& channels,
                                            const std::string& whose) {
  std::vector<numerics::Density> all;
  const double rate = rate_of(channels);
  for (const std::string& name : file.channels) {
    const auto values = counted(file, channels, name, whose);
    const auto samples = static_cast<int>(values.size());
    if (samples < 16)
      throw InputError({file.file.string(), 0}, whose + " has fewer than 16 samples that count");
    const auto settings = numerics::welch_settings(
        numerics::Convention::scipy, samples, static_cast<int>(std::lround(file.segment * rate)));
    all.push_back(numerics::power_density(values, rate, settings));
  }
  return all;
}

bool is_in(double frequency, FrequencyBand band) {
  return frequency >= band.lower - 1e-9 && frequency <= band.upper + 1e-9;
}

/// The model with its numbers away by so many spreads; nullopt where it has none of them.
std::optional<Document> moved(const ModelComparisonFile& file,
                              const ComparedModel& model,
                              const std::vector<double>& spreads) {
  Document numbers = model.numbers;
  const auto paths = numbers.paths();
  bool is_moved = false;
  for (std::size_t i = 0; i < spreads.size(); ++i) {
    if (spreads[i] == 0.0) continue;
    const double factor = std::exp(spreads[i] * file.uncertainties[i].spread);
    for (const std::string& path : file.uncertainties[i].paths) {
      if (std::find(paths.begin(), paths.end(), path) == paths.end()) continue;
      numbers.set(path, factor * numbers.get(path));
      is_moved = true;
    }
  }
  if (!is_moved) return std::nullopt;
  return numbers;
}

/// Where models are run for the bands, in spreads of the numbers.
std::vector<std::vector<double>> band_points(const ModelComparisonFile& file) {
  const std::size_t count = file.uncertainties.size();
  std::vector<std::vector<double>> points;
  if (file.samples == 0) {
    for (std::size_t i = 0; i < count; ++i) {
      points.emplace_back(count, 0.0);
      points.back()[i] = 1.0;
    }
    return points;
  }
  for (int k = 0; k < file.samples && count > 0; ++k) {
    RandomStream random(static_cast<std::uint64_t>(file.band_seed), static_cast<std::uint64_t>(k));
    points.emplace_back(count);
    for (double& value : points.back()) value = random.normal();
  }
  return points;
}

/// z such that a normal number lies within ±z with that probability, by bisection.
double normal_bound(double level) {
  double low = 0.0, high = 10.0;
  for (int i = 0; i < 60; ++i) {
    const double z = 0.5 * (low + high);
    (std::erf(z / std::sqrt(2.0)) < level ? low : high) = z;
  }
  return low;
}

double quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), values.size() - 2);
  return values[i] + (at - static_cast<double>(i)) * (values[i + 1] - values[i]);
}

using DensitySet = std::vector<std::vector<numerics::Density>>;  // by point and channel

void add_bands(const ModelComparisonFile& file, const DensitySet& others, ModelRun& run) {
  if (others.size() < (file.samples > 0 ? 2U : 1U)) return;
  const double z = normal_bound(file.level);
  for (std::size_t c = 0; c < run.densities.size(); ++c) {
    const auto& S = run.densities[c].value;
    std::vector<double> lower(S.size()), upper(S.size());
    for (std::size_t k = 0; k < S.size(); ++k) {
      if (file.samples == 0) {
        double sum = 0.0;
        for (const auto& other : others) sum += std::pow(std::log(other[c].value[k] / S[k]), 2);
        const double factor = std::exp(z * std::sqrt(sum));
        lower[k] = S[k] / factor;
        upper[k] = S[k] * factor;
        continue;
      }
      std::vector<double> values;
      for (const auto& other : others) values.push_back(other[c].value[k]);
      lower[k] = quantile(values, 0.5 - 0.5 * file.level);
      upper[k] = quantile(values, 0.5 + 0.5 * file.level);
    }
    run.lower.push_back(std::move(lower));
    run.upper.push_back(std::move(upper));
  }
}

void compare_run(const ModelComparisonFile& file,
                 const std::vector<numerics::Density>& reference,
                 ModelRun& run) {
  for (const NamedBand& band : file.bands) {
    run.distance.emplace_back();
    run.decibels.emplace_back();
    for (std::size_t c = 0; c < reference.size(); ++c) {
      run.distance.back().push_back(psd_distance(run.densities[c], reference[c], band.band));
      run.decibels.back().push_back(
          log_spectral_distance(run.densities[c], reference[c], band.band));
    }
  }
  for (std::size_t c = 0; c < run.lower.size(); ++c) {
    int lines = 0, inside = 0;
    for (std::size_t k = 0; k < reference[c].value.size(); ++k) {
      if (!is_in(reference[c].frequency[k], file.bands[0].band)) continue;
      ++lines;
      inside +=
          reference[c].value[k] >= run.lower[c][k] && reference[c].value[k] <= run.upper[c][k];
    }
    run.coverage.push_back(static_cast<double>(inside) / lines);
  }
}

ModelRun run_model(const ModelComparisonFile& file,
                   const ComparedModel& model,
                   const experiment::Test& test,
                   const ComparedCase& one,
                   const std::vector<numerics::Density>& reference) {
  ModelRun run;
  const double begin = cpu_seconds();
  const Channels channels = run_of(model, model.numbers, test, one.name);
  run.cpu = cpu_seconds() - begin;
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
    run.told.push_back(channels.find(name) ? mean(counted(file, channels, name, model.title))
                                           : std::nan(""));
  DensitySet others;
  for (const auto& point : band_points(file))
    if (const auto numbers = moved(file, model, point))
      others.push_back(densities_of(file, run_of(model, *numbers, test, one.name), model.title));
  add_bands(file, others, run);
  compare_run(file, reference, run);
  return run;
}

/// Calls work(0) ... work(count - 1), each in one of so many threads; the first exception is
/// thrown on.
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

double ModelRun::mean_distance(std::size_t band) const { return mean(distance[band]); }
double ModelRun::mean_decibels(std::size_t band) const { return mean(decibels[band]); }

double psd_distance(const numerics::Density& a, const numerics::Density& b, FrequencyBand band) {
  double difference = 0.0, all = 0.0;
  for (std::size_t k = 0; k < b.value.size(); ++k) {
    if (!is_in(b.frequency[k], band)) continue;
    difference += std::pow(a.value[k] - b.value[k], 2);
    all += std::pow(b.value[k], 2);
  }
  return std::sqrt(difference / all);
}

Channels record_reference(const ModelComparisonFile& file,
                          std::size_t index,
                          const experiment::Language& language) {
  const ComparedCase& one = file.cases[index];
  const auto test =
      read_case(one.reference_test, file.tests[one.test].reference_folder, language, nullptr);
  const Channels clean = run_of(file.reference, file.reference.numbers, *test, one.name);
  Channels noisy;
  std::uint64_t number = 64 * index;  // a stream for each channel of each case
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
                      const experiment::Language& language) {
  const std::size_t source = file.find_case(file.cases[index].recording);
  if (file.recordings.empty()) return kept_of(file, record_reference(file, source, language));
  const auto table = formats::CsvTable::read(file.recordings / (file.cases[source].name + ".csv"));
  return table.channels();
}

ModelComparison compare_models(const ModelComparisonFile& file,
                               const experiment::Language& language,
                               int threads,
                               const std::function<void(long, long)>& tell) {
  const std::size_t count = file.cases.size();
  ModelComparison all;
  all.cases.resize(count);
  std::vector<std::unique_ptr<experiment::Test>> tests(count);
  share_out(count, threads, [&](std::size_t i) {
    const Channels recording = reference_of(file, i, language);
    all.cases[i].reference = densities_of(file, recording, file.reference.title);
    all.cases[i].models.resize(file.models.size());
    const Channels conditions = low_passed(recording, file.low_pass);
    tests[i] = read_case(
        file.cases[i].model_test, file.tests[file.cases[i].test].folder, language, &conditions);
  });
  std::mutex guard;
  long done = 0;
  const std::size_t runs = count * file.models.size();
  share_out(runs, threads, [&](std::size_t k) {
    const std::size_t i = k / file.models.size(), m = k % file.models.size();
    all.cases[i].models[m] =
        run_model(file, file.models[m], *tests[i], file.cases[i], all.cases[i].reference);
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
