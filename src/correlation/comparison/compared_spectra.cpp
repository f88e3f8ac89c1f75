// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/compared_spectra.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/text.h"
#include "numerics/chi_square.h"
#include "numerics/signals/butterworth.h"
#include "numerics/signals/sample_count.h"

namespace latsch::correlation {
namespace {

double rate_of(const Channels& channels) {
  const auto& time = channels["time"];
  return static_cast<double>(time.size() - 1) / (time.back() - time.front());
}

/// Throws InputError if the samples of a recording are not equidistant in time, because spectra
/// would ignore a gap.
void check_even(const ModelComparisonFile& file,
                const Channels& channels,
                const std::string& whose) {
  constexpr double kOff = 0.5;  // share of a step; less may be the rounding of a table
  const auto& time = channels["time"];
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t i = 1; i < time.size(); ++i)
    if (!(std::abs(time[i] - time[i - 1] - step) <= kOff * step))
      throw InputError(
          {file.file.string(), 0},
          fmt::format("{} is not even in time: sample {} follows at {:.6g} s the one at {:.6g} s, "
                      "where {:.4g} s are usual",
                      whose,
                      i + 1,
                      time[i],
                      time[i - 1],
                      step));
}

numerics::WelchSettings welch_of(const ModelComparisonFile& file,
                                 std::size_t samples,
                                 double rate) {
  return numerics::welch_settings(numerics::Convention::scipy,
                                  static_cast<int>(samples),
                                  numerics::sample_count(file.segment, rate));
}

/// Throws InputError if a band or the segment needs a longer or faster recording.
void check_spectrum(const ModelComparisonFile& file,
                    std::size_t samples,
                    double rate,
                    const std::string& whose) {
  constexpr double kFewest = 16.0;  // samples of a segment
  const auto reject = [&](const std::string& why) {
    throw InputError({file.file.string(), 0}, why);
  };
  const double length = static_cast<double>(samples) / rate;
  if (file.segment * rate < kFewest)
    reject(fmt::format("segment is {:g} s, {:.3g} samples of {}; expected {:.0f} samples at least",
                       file.segment,
                       file.segment * rate,
                       whose,
                       kFewest));
  if (file.segment * rate > static_cast<double>(samples) + 1.0)
    reject(
        fmt::format("segment is {:g} s, but {} has {:.4g} s to select it from; expected a "
                    "shorter segment or a longer test",
                    file.segment,
                    whose,
                    length));
  const double spacing = rate / welch_of(file, samples, rate).length;
  for (const auto& [name, band] : file.bands) {
    if (band.upper > 0.5 * rate * (1.0 + 1e-6))
      reject(
          fmt::format("band.{}.edges ends at {:g} Hz, but the {:g} samples a second of {} hold "
                      "nothing above {:g} Hz",
                      name,
                      band.upper,
                      rate,
                      whose,
                      0.5 * rate));
    if (std::floor(band.upper / spacing + 1e-9) * spacing < band.lower - 1e-9)
      reject(
          fmt::format("band.{}.edges from {:g} to {:g} Hz has no line of the spectra, which are "
                      "{:.3g} Hz apart; expected a wider band or a longer segment",
                      name,
                      band.lower,
                      band.upper,
                      spacing));
  }
}

}  // namespace

Channels low_passed(const ModelComparisonFile& file, const Channels& recording) {
  const double edge = file.low_pass;
  if (edge == 0.0) return recording;
  constexpr double kFirst = 0.02;  // s
  const double rate = rate_of(recording);
  if (edge >= 0.5 * rate)
    throw InputError(
        {file.file.string(), 0},
        fmt::format("reference.low_pass is {:g} Hz, but {:g} samples a second hold nothing above "
                    "{:g} Hz; expected a lower edge, or none",
                    edge,
                    rate,
                    0.5 * rate));
  const auto filter = numerics::polynomials_of(
      numerics::butterworth(2, numerics::FilterBand::low_pass, {edge}, rate));
  const auto rest = numerics::steady_state(filter);
  Channels channels;
  for (Channel channel : recording.all()) {
    if (channel.name != "time") {
      const auto first = std::clamp<std::size_t>(
          static_cast<std::size_t>(kFirst * rate), 1, channel.values.size());
      const auto end = channel.values.begin() + static_cast<std::ptrdiff_t>(first);
      const double level =
          std::accumulate(channel.values.begin(), end, 0.0) / static_cast<double>(first);
      std::vector<double> state = rest;
      for (double& value : state) value *= level;
      channel.values = numerics::filter(filter, channel.values, state);
    }
    channels.add(std::move(channel));
  }
  return channels;
}

std::vector<double> selected_samples(const ModelComparisonFile& file,
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
  check_even(file, channels, whose);
  const double rate = rate_of(channels), first = channels["time"].front();
  constexpr double kRounding = 1e-9;  // s
  if (file.has_from && file.from < first - kRounding)
    throw InputError(
        {file.file.string(), 0},
        fmt::format("from is {:g} s, but {} begins at {:.4g} s; expected a later time, "
                    "or no from for the whole record",
                    file.from,
                    whose,
                    first));
  for (const std::string& name : file.channels) {
    const auto values = selected_samples(file, channels, name, whose);
    if (values.size() < 16)
      throw InputError({file.file.string(), 0}, whose + " has fewer than 16 selected samples");
    check_spectrum(file, values.size(), rate, whose);
    all.push_back(numerics::power_density(values, rate, welch_of(file, values.size(), rate)));
  }
  return all;
}

bool is_in(double frequency, FrequencyBand band) {
  return frequency >= band.lower - 1e-9 && frequency <= band.upper + 1e-9;
}

void check_power(const ModelComparisonFile& file, const std::vector<numerics::Density>& reference) {
  for (std::size_t c = 0; c < reference.size(); ++c)
    for (const auto& [name, band] : file.bands) {
      double most = 0.0;
      for (std::size_t k = 0; k < reference[c].value.size(); ++k)
        if (is_in(reference[c].frequency[k], band)) most = std::max(most, reference[c].value[k]);
      if (most > 0.0) continue;
      throw InputError({file.file.string(), 0},
                       fmt::format("{} of {} does not move in band.{}, so there is nothing to "
                                   "compare with; expected another channel or band",
                                   in_quotes(file.channels[c]),
                                   file.reference.title,
                                   name));
    }
}

std::vector<LineNoise> noise_of(const ModelComparisonFile& file, const Channels& recording) {
  std::vector<LineNoise> all;
  const double rate = rate_of(recording);
  for (const std::string& name : file.channels) {
    const auto samples = selected_samples(file, recording, name, file.reference.title).size();
    const auto stated = file.noise.find(name);
    const double deviation = stated == file.noise.end() ? 0.0 : stated->second;
    all.push_back({2.0 * deviation * deviation / rate,
                   independent_segments(static_cast<int>(samples), welch_of(file, samples, rate))});
  }
  return all;
}

double LineNoise::log_quantile(double S, double z) const {
  if (density == 0.0) return 0.0;
  const double M = S + density;
  const double h = 2.0 * segments * M * M / (2.0 * S * density + density * density);
  return std::log(numerics::chi_square_at(z, h) / h);
}

double psd_distance(const numerics::Density& a, const numerics::Density& b, FrequencyBand band) {
  double difference = 0.0, all = 0.0;
  for (std::size_t k = 0; k < b.value.size(); ++k) {
    if (!is_in(b.frequency[k], band)) continue;
    difference += std::pow(a.value[k] - b.value[k], 2);
    all += std::pow(b.value[k], 2);
  }
  return std::sqrt(difference / all);
}

}  // namespace latsch::correlation
