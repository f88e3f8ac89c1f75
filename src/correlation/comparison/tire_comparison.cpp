// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/tire_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "base/random.h"
#include "formats/tables/csv_table.h"
#include "measurement/band_level.h"

namespace latsch::correlation {
namespace {

constexpr int kTimings = 2;  // number of runs, of which the least CPU time counts

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::vector<double> about_mean(std::vector<double> values) {
  const double middle = mean(values);
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
                ComparedRecord& measured) {
  constexpr double kMostNoise = 0.25;  // share of the power of a band
  double sigma = 0.0;
  if (file.specimen && file.specimen->noise.contains(channel))
    sigma = file.specimen->noise.at(channel);
  for (const FrequencyBand& band : bands) {
    const double noise = 2.0 * sigma * sigma * test.drum.sample_step * (band.upper - band.lower);
    measured.heard.push_back(noise <= kMostNoise * band_power(measured.density, band));
  }
}

Channels run_of(const ComparedTire& tire, const ComparisonTest& test) {
  auto channels = experiment::DrumCleatTest(test.drum).run(*tire.kind->build(tire.numbers));
  if (!channels) {
    throw std::runtime_error(
        fmt::format("{} in test {}: {}", tire.title, test.name, channels.failure().reason));
  }
  return std::move(*channels);
}

/// Returns the measured channel at the times of the simulated one, linear between its samples.
std::vector<double> at_times(const formats::CsvTable& table,
                             const std::string& channel,
                             const std::vector<double>& times) {
  const auto t = table.numbers("time", "s");
  const auto y = table.numbers(channel, channel[0] == 'F' ? "N" : "N m");
  std::vector<double> values;
  for (const double at : times) {
    const auto right = std::lower_bound(t.begin(), t.end(), at - 1e-9);
    if (right == t.end() || (right == t.begin() && *right > at + 1e-9)) {
      throw InputError(
          table.header_place(),
          fmt::format("reaches from {:g} to {:g} s, but the test is compared at {:g} s; shorten "
                      "lead or duration of the test, or measure longer",
                      t.empty() ? 0.0 : t.front(),
                      t.empty() ? 0.0 : t.back(),
                      at));
    }
    const auto i = right - t.begin();
    if (i == 0 || t[i] <= at) {
      values.push_back(y[i]);
      continue;
    }
    const double share = (at - t[i - 1]) / (t[i] - t[i - 1]);
    values.push_back(y[i - 1] + share * (y[i] - y[i - 1]));
  }
  return values;
}

double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TireRun compared_run(const ComparedTire& tire,
                     const ComparisonFile& file,
                     const ComparisonTest& test,
                     const TestComparison& of,
                     const std::vector<FrequencyBand>& bands) {
  TireRun run;
  Channels channels;
  double least = 0.0;
  for (int i = 0; i < kTimings; ++i) {
    const double begin = cpu_seconds();
    channels = run_of(tire, test);
    const double spent = cpu_seconds() - begin;
    least = i == 0 ? spent : std::min(least, spent);
  }
  run.cpu_over_time = least / (test.drum.passages * (test.drum.run_in + test.drum.duration));
  for (std::size_t c = 0; c < file.channels.size(); ++c) {
    run.channels.push_back(
        record_of(channels[file.channels[c]], 1.0 / test.drum.sample_step, bands));
    const ComparedRecord& simulated = run.channels.back();
    const ComparedRecord& measured = of.measured[c];
    run.time_error.push_back(
        relative_error(about_mean(simulated.force), about_mean(measured.force)));
    run.psd_error.push_back(relative_error(in_band(simulated.density, file.band),
                                           in_band(measured.density, file.band)));
  }
  return run;
}

/// Returns the root mean square over the tests for each band.
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

/// Returns the longest sequence of adjacent bands within the agreement.
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
  return sum;
}

}  // namespace

Channels measure(const Specimen& specimen, const ComparisonTest& test, std::size_t index) {
  ComparisonTest own = test;
  if (specimen.step > 0.0) own.drum.step = specimen.step;
  const Channels clean = run_of(specimen.tire, own);
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
  for (std::size_t t = 0; t < file.tests.size(); ++t) {
    const ComparisonTest& test = file.tests[t];
    if (tell) tell(test.name);
    TestComparison compared;
    const long count = std::lround((test.drum.duration) / test.drum.sample_step);
    for (long i = 1; i <= count; ++i)
      compared.time.push_back(static_cast<double>(i) * test.drum.sample_step - test.drum.lead);
    Channels measured;
    std::optional<formats::CsvTable> table;
    if (file.specimen) {
      measured = measure(*file.specimen, test, t);
      compared.time = measured["time"];
    } else {
      table = formats::CsvTable::read(test.measurement);
    }
    for (const std::string& channel : file.channels) {
      auto force = table ? at_times(*table, channel, compared.time) : measured[channel];
      compared.measured.push_back(
          record_of(std::move(force), 1.0 / test.drum.sample_step, all.bands));
      find_heard(file, channel, test, all.bands, compared.measured.back());
    }
    for (const ComparedTire& tire : file.tires)
      compared.tires.push_back(compared_run(tire, file, test, compared, all.bands));
    all.tests.push_back(std::move(compared));
  }
  for (std::size_t i = 0; i < file.tires.size(); ++i) all.tires.push_back(summary(file, all, i));
  return all;
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
    sentences.push_back(std::move(text));
  }
  return sentences;
}

}  // namespace latsch::correlation
