// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/tire_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "base/clock.h"
#include "base/random.h"
#include "correlation/comparison/measured_drum.h"
#include "correlation/target/limits_by_name.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/fe_rolling/cleat_rig.h"
#include "experiment/rigs/sampling.h"
#include "experiment/rigs/slip/lift_watch.h"
#include "formats/tables/csv_table.h"
#include "measurement/band_level.h"
#include "numerics/signals/mean.h"

namespace latsch::correlation {
namespace {

/// Number of repeated runs, of which the least CPU time counts; a finite-element tire runs once,
/// because minutes are timed well enough.
constexpr int kTimings = 2;

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::vector<double> about_mean(std::vector<double> values) {
  const double middle = numerics::mean(values);
  for (double& value : values) value -= middle;
  return values;
}

double relative_error(const std::vector<double>& simulated, const std::vector<double>& measured) {
  std::vector<double> difference(measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i) difference[i] = simulated[i] - measured[i];
  return rms(difference) / rms(measured);
}

std::vector<double> in_band(const numerics::Density& density, FrequencyBand band) {
  std::vector<double> values;
  for (std::size_t k = 0; k < density.value.size(); ++k) {
    if (density.frequency[k] >= band.lower && density.frequency[k] <= band.upper)
      values.push_back(density.value[k]);
  }
  return values;
}

ComparedRecord record_of(std::vector<double> force,
                         double rate,
                         const std::vector<FrequencyBand>& bands) {
  ComparedRecord record;
  const int count = static_cast<int>(force.size());
  record.density = numerics::power_density(
      force, rate, numerics::welch_settings(numerics::Convention::scipy, count, count));
  for (const FrequencyBand& band : bands) record.level.push_back(band_level(record.density, band));
  record.force = std::move(force);
  return record;
}

void find_heard(const ComparisonFile& file,
                const std::string& channel,
                const ComparisonTest& test,
                const std::vector<FrequencyBand>& bands,
                double highest,
                ComparedRecord& measured) {
  // A band is not compared if noise makes up more than this share of its measured power.
  constexpr double kMostNoise = 0.25;
  double sigma = 0.0;
  if (file.specimen && file.specimen->noise.contains(channel))
    sigma = file.specimen->noise.at(channel);
  for (const FrequencyBand& band : bands) {
    const double noise = 2.0 * sigma * sigma * test.drum.sample_step * (band.upper - band.lower);
    measured.heard.push_back(band.upper <= highest &&
                             noise <= kMostNoise * band_power(measured.density, band));
  }
}

/// Rolls a tire over the cleat of a drum, as the test drum_cleat does. Adds what a finite-element
/// tire assumes to `remarks`, and what other tires meet to `lifts`.
Result<Channels> run_on_drum(experiment::Specimen& specimen,
                             const experiment::DrumTest& drum,
                             LiftLog& lifts,
                             std::vector<std::string>& remarks) {
  if (auto* elements = specimen.find<experiment::IsFeTire>())
    return elements->drive(
        [&](experiment::TireRig& rig, fe_tire::TireSlopes*) {
          remarks = experiment::remarks_on_cleat(rig, drum);
          return experiment::cross_cleat(rig, drum, remarks);
        },
        drum.pressure.has_value(),
        {});
  experiment::refuse_high_cleat(specimen, drum.cleat);
  return experiment::run(*watched(specimen.find<Rolls>()->tire(drum.pressure), lifts), drum);
}

/// Runs a tire through a test; returns the recorded channels. Sets `limits`, unless it is null, to
/// the limits that the tire met.
Channels run_of(const ComparedTire& tire,
                const ComparisonTest& test,
                std::vector<std::string>* limits) {
  const auto specimen = tire.kind->build(tire.numbers);
  const experiment::DrumTest& drum = test.drum;
  LiftLog lifts;
  std::vector<std::string> remarks;
  auto channels = run_on_drum(*specimen, drum, lifts, remarks);
  if (!channels) {
    throw std::runtime_error(
        fmt::format("{} in test {}: {}", tire.title, test.name, channels.failure().reason));
  }
  if (limits) {
    *limits = limits_of(*specimen, drum.cleat);
    limits->insert(limits->end(), remarks.begin(), remarks.end());
    record_limit(*specimen, lifts.sentence());
    if (drum.cleat)
      record_limit(*specimen, experiment::note_on_samples(drum.sample_step, drum.speed));
    for (std::string& limit : experiment::limits_met(*specimen))
      limits->push_back(std::move(limit));
  }
  return std::move(*channels);
}

/// Throws InputError if the record has no line in the band; adds a remark if a part of the band is
/// beyond the record.
void judge_band(const ComparisonFile& file,
                const ComparisonTest& test,
                const TestComparison& compared,
                std::vector<std::string>& remarks) {
  const double spacing = 1.0 / (static_cast<double>(compared.time.size()) * test.drum.sample_step);
  const FrequencyBand band{file.band.lower, std::min(file.band.upper, compared.highest)};
  if (std::floor(band.upper / spacing) * spacing < band.lower)
    throw InputError(
        {file.file.string(), 0},
        fmt::format("band from {:g} to {:g} Hz has no line of the record of test {}, whose lines "
                    "are {:.3g} Hz apart and end at {:g} Hz; expected a wider band, or a longer or "
                    "faster record",
                    file.band.lower,
                    file.band.upper,
                    test.name,
                    spacing,
                    compared.highest));
  if (file.band.upper > compared.highest)
    remarks.push_back(fmt::format(
        "test {}: nothing above {:g} Hz was recorded, half the rate of the samples; spectra are "
        "compared up to there, not to {:g} Hz",
        test.name,
        compared.highest,
        file.band.upper));
  if (file.band.lower < spacing)
    remarks.push_back(
        fmt::format("test {}: the record of {:.3g} s shows nothing below {:.3g} Hz; spectra are "
                    "compared from there, not from {:g} Hz",
                    test.name,
                    1.0 / spacing,
                    spacing,
                    file.band.lower));
}

/// Returns the time, s, that a tire simulates in a test. A finite-element tire begins with its
/// steady state, without a run-in, and one of its passages stands for all.
double simulated_time(const ComparedTire& tire, const experiment::DrumTest& drum) {
  if (tire.kind->has(experiment::IsFeTire::kName)) return drum.duration;
  return drum.passages * (drum.run_in + drum.duration);
}

TireRun compared_run(const ComparedTire& tire,
                     const ComparisonFile& file,
                     const ComparisonTest& test,
                     const TestComparison& of,
                     const std::vector<FrequencyBand>& bands) {
  TireRun run;
  Channels channels;
  double least = 0.0;
  const int timings = tire.kind->has(experiment::IsFeTire::kName) ? 1 : kTimings;
  for (int i = 0; i < timings; ++i) {
    const double begin = thread_cpu_seconds();
    channels = run_of(tire, test, i == 0 ? &run.limits : nullptr);
    const double spent = thread_cpu_seconds() - begin;
    least = i == 0 ? spent : std::min(least, spent);
  }
  run.cpu_over_time = least / simulated_time(tire, test.drum);
  for (std::size_t c = 0; c < file.channels.size(); ++c) {
    run.channels.push_back(
        record_of(channels[file.channels[c]], 1.0 / test.drum.sample_step, bands));
    const ComparedRecord& simulated = run.channels.back();
    const ComparedRecord& measured = of.measured[c];
    run.time_error.push_back(
        relative_error(about_mean(simulated.force), about_mean(measured.force)));
    const FrequencyBand band{file.band.lower, std::min(file.band.upper, of.highest)};
    run.psd_error.push_back(
        relative_error(in_band(simulated.density, band), in_band(measured.density, band)));
  }
  return run;
}

/// Returns the root mean square of the level errors over the tests, for each frequency band.
std::vector<double> level_errors(const TireComparison& all, std::size_t tire, std::size_t channel) {
  std::vector<double> errors;
  for (std::size_t b = 0; b < all.bands.size(); ++b) {
    std::vector<double> differences;
    for (const TestComparison& test : all.tests) {
      if (!test.measured[channel].heard[b]) continue;
      differences.push_back(test.tires[tire].channels[channel].level[b] -
                            test.measured[channel].level[b]);
    }
    errors.push_back(rms(differences));  // NaN if there are none
  }
  return errors;
}

/// Returns the frequency range of the longest sequence of adjacent bands whose errors are at most
/// `agreement`, dB.
FrequencyBand followed(const std::vector<double>& errors,
                       const std::vector<FrequencyBand>& bands,
                       double agreement) {
  std::size_t first = 0, longest = 0;
  for (std::size_t begin = 0; begin < errors.size(); ++begin) {
    std::size_t end = begin;
    while (end < errors.size() && errors[end] <= agreement) ++end;
    if (end - begin <= longest) continue;
    longest = end - begin;
    first = begin;
  }
  if (longest == 0) return {0.0, 0.0};
  return {bands[first].lower, bands[first + longest - 1].upper};
}

/// Adds the mean errors over the tests that were held out, if the file says which were.
void add_held_out(const ComparisonFile& file,
                  const TireComparison& all,
                  std::size_t tire,
                  TireSummary& sum) {
  const auto count = static_cast<double>(held_out_tests(file));
  if (count == 0.0) return;
  sum.held_out_time_error.assign(file.channels.size(), 0.0);
  sum.held_out_psd_error.assign(file.channels.size(), 0.0);
  for (std::size_t t = 0; t < file.tests.size(); ++t) {
    if (file.tests[t].fitted) continue;
    const TireRun& run = all.tests[t].tires[tire];
    for (std::size_t c = 0; c < file.channels.size(); ++c) {
      sum.held_out_time_error[c] += run.time_error[c] / count;
      sum.held_out_psd_error[c] += run.psd_error[c] / count;
    }
  }
}

TireSummary summary(const ComparisonFile& file, const TireComparison& all, std::size_t tire) {
  TireSummary sum;
  const auto tests = static_cast<double>(all.tests.size());
  for (std::size_t c = 0; c < file.channels.size(); ++c) {
    double time = 0.0, psd = 0.0;
    for (const TestComparison& test : all.tests) {
      time += test.tires[tire].time_error[c] / tests;
      psd += test.tires[tire].psd_error[c] / tests;
    }
    sum.time_error.push_back(time);
    sum.psd_error.push_back(psd);
    sum.level_error.push_back(level_errors(all, tire, c));
    sum.follows.push_back(followed(sum.level_error.back(), all.bands, file.agreement));
  }
  for (const TestComparison& test : all.tests)
    sum.cpu_over_time += test.tires[tire].cpu_over_time / tests;
  add_held_out(file, all, tire, sum);
  return sum;
}

}  // namespace

Channels measure(const ComparedSpecimen& specimen,
                 const ComparisonTest& test,
                 std::size_t index,
                 std::vector<std::string>* limits) {
  ComparisonTest own = test;
  if (specimen.step > 0.0) own.drum.step = specimen.step;
  const Channels clean = run_of(specimen.tire, own, limits);
  Channels noisy;
  std::uint64_t number = 16 * index;  // random stream, different for each channel of each test
  for (Channel channel : clean.all()) {
    RandomStream random(static_cast<std::uint64_t>(specimen.seed), number++);
    const auto noise = specimen.noise.find(channel.name);
    if (noise != specimen.noise.end()) {
      for (double& value : channel.values) value += noise->second * random.normal();
    }
    noisy.add(std::move(channel));
  }
  return noisy;
}

TireComparison compare_tires(const ComparisonFile& file,
                             const std::function<void(const std::string&)>& tell) {
  TireComparison all;
  all.bands = third_octave_bands(file.band);
  LimitsByName of_specimen;
  for (std::size_t t = 0; t < file.tests.size(); ++t) {
    const ComparisonTest& test = file.tests[t];
    if (tell) tell(test.name);
    TestComparison compared;
    const long count = std::lround((test.drum.duration) / test.drum.sample_step);
    for (long i = 1; i <= count; ++i)
      compared.time.push_back(static_cast<double>(i) * test.drum.sample_step - test.drum.lead);
    compared.highest = 0.5 / test.drum.sample_step;
    std::vector<std::vector<double>> forces;
    if (file.specimen) {
      std::vector<std::string> limits;
      const double begin = thread_cpu_seconds();
      const Channels measured = measure(*file.specimen, test, t, &limits);
      compared.specimen_cpu_over_time =
          (thread_cpu_seconds() - begin) / simulated_time(file.specimen->tire, test.drum);
      all.specimen_cpu_over_time +=
          compared.specimen_cpu_over_time / static_cast<double>(file.tests.size());
      for (const std::string& limit : limits) of_specimen.add(limit, test.name);
      compared.time = measured["time"];
      for (const std::string& channel : file.channels) forces.push_back(measured[channel]);
    } else {
      MeasuredDrum measured = measured_drum(*test.measurement,
                                            file.channels,
                                            compared.time,
                                            test.drum.frames.front(),
                                            test.drum.load);
      forces = std::move(measured.forces);
      compared.highest = std::min(compared.highest, measured.highest);
    }
    for (std::size_t c = 0; c < forces.size(); ++c) {
      compared.measured.push_back(
          record_of(std::move(forces[c]), 1.0 / test.drum.sample_step, all.bands));
      find_heard(
          file, file.channels[c], test, all.bands, compared.highest, compared.measured.back());
    }
    judge_band(file, test, compared, all.remarks);
    for (const ComparedTire& tire : file.tires)
      compared.tires.push_back(compared_run(tire, file, test, compared, all.bands));
    all.tests.push_back(std::move(compared));
  }
  for (std::size_t i = 0; i < file.tires.size(); ++i) all.tires.push_back(summary(file, all, i));
  all.limits_of_specimen = of_specimen.before_names();
  return all;
}

std::vector<std::string> limits_of_tire(const ComparisonFile& file,
                                        const TireComparison& comparison,
                                        std::size_t tire) {
  LimitsByName limits;
  for (std::size_t t = 0; t < file.tests.size(); ++t)
    for (const std::string& limit : comparison.tests[t].tires[tire].limits)
      limits.add(limit, file.tests[t].name);
  return limits.before_names();
}

std::size_t held_out_tests(const ComparisonFile& file) {
  const auto count = static_cast<std::size_t>(
      std::count_if(file.tests.begin(), file.tests.end(), [](const ComparisonTest& test) {
        return !test.fitted;
      }));
  return count == file.tests.size() ? 0 : count;
}

std::vector<std::string> verdicts(const ComparisonFile& file, const TireComparison& comparison) {
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < file.tires.size(); ++i) {
    const TireSummary& sum = comparison.tires[i];
    std::string text = file.tires[i].title + ":";
    for (std::size_t c = 0; c < file.channels.size(); ++c) {
      const FrequencyBand follows = sum.follows[c];
      text +=
          fmt::format("{} {} {}; off by {:.0f} % in time, {:.0f} % in its PSD",
                      c == 0 ? "" : ".",
                      file.channels[c],
                      follows.upper > 0.0 ? fmt::format("within {:g} dB from {:.0f} to {:.0f} Hz",
                                                        file.agreement,
                                                        follows.lower,
                                                        follows.upper)
                                          : fmt::format("nowhere within {:g} dB", file.agreement),
                      100.0 * sum.time_error[c],
                      100.0 * sum.psd_error[c]);
    }
    text += fmt::format(". CPU time {:.2g} x real time.", sum.cpu_over_time);
    if (!sum.held_out_psd_error.empty()) {
      const std::size_t held_out = held_out_tests(file);
      text += fmt::format(" In {} held-out {}", held_out, held_out == 1 ? "test" : "tests");
      for (std::size_t c = 0; c < file.channels.size(); ++c)
        text += fmt::format("{} {} is off by {:.0f} % in time, {:.0f} % in its PSD",
                            c == 0 ? "" : ",",
                            file.channels[c],
                            100.0 * sum.held_out_time_error[c],
                            100.0 * sum.held_out_psd_error[c]);
      text += ".";
    }
    sentences.push_back(std::move(text));
  }
  return sentences;
}

}  // namespace latsch::correlation
