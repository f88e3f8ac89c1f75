// SPDX-License-Identifier: Apache-2.0
#include "measurement/plateaus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/units.h"
#include "numerics/signals/butterworth.h"
#include "numerics/signals/sample_count.h"

namespace latsch {
namespace {

struct Stretch {
  int first = 0, end = 0;
  int samples() const { return end - first; }
};

/// Returns the longest run of samples within the margin of the target speed.
Stretch longest_stretch(const std::vector<double>& speed, double target, double margin) {
  Stretch longest, current;
  for (int i = 0; i < static_cast<int>(speed.size()); ++i) {
    if (std::abs(speed[i] - target) > margin) {
      current = {i + 1, i + 1};
      continue;
    }
    current.end = i + 1;
    if (current.samples() > longest.samples()) longest = current;
  }
  return longest;
}

std::string kph(double speed) { return format_quantity(speed, "km/h", 5); }

[[noreturn]] void no_plateau(const DrumRecord& record,
                             const std::vector<double>& speed,
                             double target,
                             const Stretch& longest,
                             const PlateauSettings& settings) {
  const auto nearest = std::min_element(speed.begin(), speed.end(), [&](double a, double b) {
    return std::abs(a - target) < std::abs(b - target);
  });
  const std::string found =
      longest.samples() == 0
          ? fmt::format("the speed comes nearest with {} at {:.4g} s",
                        kph(*nearest),
                        record.time(static_cast<double>(nearest - speed.begin())))
          : fmt::format("the longest stretch lasts {:.4g} s (from {:.4g} s)",
                        longest.samples() / record.rate,
                        record.time(longest.first));
  throw InputError({record.source, 0},
                   fmt::format("has no plateau at {} +- {}: {}, expected {:g} s and {:g} s more to "
                               "trim at each end; choose another speed, a wider margin or a "
                               "shorter plateau",
                               kph(target),
                               kph(settings.margin),
                               found,
                               settings.shortest,
                               settings.trim));
}

/// Throws InputError if the drum never turns forward, with the reason and a way out.
void require_forward(const DrumRecord& record, const std::vector<double>& smooth) {
  constexpr double kStill = 0.1;  // m/s, below which a drum stands
  const auto [least, most] = std::minmax_element(smooth.begin(), smooth.end());
  if (*most > kStill) return;
  const bool is_backward = *least < -kStill;
  throw InputError(
      {record.source, 0},
      fmt::format("has a speed from {} to {}: the drum {}",
                  kph(*least),
                  kph(*most),
                  is_backward
                      ? "turns backward, or its sensor counts backward. Expected a positive speed: "
                        "if only the sign is wrong, write the speed with the other sign; if the "
                        "drum did turn backward, turn the sign of the longitudinal force, too"
                      : "stands still; expected a drum at constant speed"));
}

}  // namespace

std::vector<double> smooth_speed(const DrumRecord& record,
                                 const std::string& speed_channel,
                                 const PlateauSettings& settings) {
  using namespace numerics;
  const auto speed = record.channel(speed_channel);
  if (settings.low_pass >= record.rate / 2.0) {
    throw InputError({record.source, 0},
                     fmt::format("is sampled at {:g} Hz, too slow for the low-pass of the speed at "
                                 "{:g} Hz: expected more than twice that",
                                 record.rate,
                                 settings.low_pass));
  }
  const auto sections = sections_of(
      butterworth(settings.order, FilterBand::low_pass, {settings.low_pass}, record.rate));
  if (record.samples <= forward_backward_padding(sections)) {
    throw InputError({record.source, 0},
                     fmt::format("has {} samples, too few to low-pass the speed", record.samples));
  }
  std::vector<double> smooth = filter_forward_backward(sections, speed);
  require_forward(record, smooth);
  return smooth;
}

std::vector<Plateau> find_plateaus(const DrumRecord& record,
                                   const std::string& speed_channel,
                                   const std::vector<double>& targets,
                                   const PlateauSettings& settings) {
  const std::vector<double> speed = smooth_speed(record, speed_channel, settings);
  const int trim = numerics::sample_count(settings.trim, record.rate);
  std::vector<Plateau> plateaus;
  for (const double target : targets) {
    const Stretch stretch = longest_stretch(speed, target, settings.margin);
    if (stretch.samples() - 2 * trim < settings.shortest * record.rate) {
      no_plateau(record, speed, target, stretch, settings);
    }
    Plateau plateau{target, stretch.first + trim, stretch.end - trim, 0.0, 0.0};
    const auto first = speed.begin() + plateau.first, end = speed.begin() + plateau.end;
    plateau.mean = std::accumulate(first, end, 0.0) / plateau.samples();
    plateau.range = *std::max_element(first, end) - *std::min_element(first, end);
    plateaus.push_back(plateau);
  }
  return plateaus;
}

std::vector<double> held_speeds(const DrumRecord& record,
                                const std::string& speed_channel,
                                const PlateauSettings& settings) {
  // Hz; twenty times the cutoff frequency of the low-pass filter
  constexpr double kCoarseRate = 20.0;
  constexpr double kStandstill = 1.0;  // m/s
  const std::vector<double> smooth = smooth_speed(record, speed_channel, settings);
  const auto every = static_cast<std::size_t>(std::max(1.0, record.rate / kCoarseRate));
  std::vector<double> speed;
  for (std::size_t i = 0; i < smooth.size(); i += every) speed.push_back(smooth[i]);
  const double enough =
      (settings.shortest + 2.0 * settings.trim) * record.rate / static_cast<double>(every);
  const double gone = -1e9;  // marks samples that already belong to a plateau
  std::vector<double> held;
  while (true) {
    Stretch longest;
    for (const double target : speed) {
      const auto near = [&](double other) {
        return std::abs(other - target) < 2.0 * settings.margin;
      };
      if (target < kStandstill || std::any_of(held.begin(), held.end(), near)) continue;
      const Stretch one = longest_stretch(speed, target, settings.margin);
      if (one.samples() > longest.samples()) longest = one;
    }
    if (longest.samples() < enough) break;
    const auto first = speed.begin() + longest.first, end = speed.begin() + longest.end;
    held.push_back(std::accumulate(first, end, 0.0) / longest.samples());
    std::fill(first, end, gone);
  }
  if (held.empty())
    throw InputError(
        {record.source, 0},
        fmt::format("holds no speed within {} for {:g} s: it goes from {} to {}; expected a drum "
                    "at constant speed",
                    kph(settings.margin),
                    settings.shortest + 2.0 * settings.trim,
                    kph(*std::min_element(smooth.begin(), smooth.end())),
                    kph(*std::max_element(smooth.begin(), smooth.end()))));
  std::sort(held.begin(), held.end());
  return held;
}

}  // namespace latsch
