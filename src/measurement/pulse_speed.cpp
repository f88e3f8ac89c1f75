// SPDX-License-Identifier: Apache-2.0
#include "measurement/pulse_speed.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/text.h"

namespace latsch {
namespace {

constexpr double kHysteresis = 0.25;  // share of the signal's range
constexpr std::size_t kFewestPulses = 3;
// least number of samples between two pulses; with fewer samples a pulse may be missed
constexpr double kFewestSamples = 4.0;

/// Distance, in pitches, that the surface has traveled since the first pulse.
class WayOfPulses {
 public:
  WayOfPulses(const std::vector<double>& pulses, double last_sample)
      : pulses_(pulses),
        before_(std::max(pulses[1] - pulses[0], pulses[0])),
        after_(std::max(pulses.back() - pulses[pulses.size() - 2], last_sample - pulses.back())) {}

  double operator()(double sample) const {
    if (sample <= pulses_.front()) return (sample - pulses_.front()) / before_;
    const auto count = static_cast<double>(pulses_.size() - 1);
    if (sample >= pulses_.back()) return count + (sample - pulses_.back()) / after_;
    const auto next = std::upper_bound(pulses_.begin(), pulses_.end(), sample);
    const double share = (sample - *(next - 1)) / (*next - *(next - 1));
    return static_cast<double>(next - pulses_.begin() - 1) + share;
  }

 private:
  const std::vector<double>& pulses_;
  double before_, after_;  // samples per pitch before the first and after the last pulse
};

}  // namespace

std::vector<double> pulses_of(std::span<const double> signal) {
  if (signal.empty()) return {};
  const auto [least, greatest] = std::minmax_element(signal.begin(), signal.end());
  const double middle = 0.5 * (*least + *greatest);
  const double low = middle - kHysteresis * (*greatest - *least);
  std::vector<double> pulses;
  bool has_fallen = false;
  for (std::size_t i = 1; i < signal.size(); ++i) {
    has_fallen = has_fallen || signal[i - 1] < low;
    if (!has_fallen || signal[i] <= middle) continue;
    pulses.push_back(static_cast<double>(i - 1) +
                     (middle - signal[i - 1]) / (signal[i] - signal[i - 1]));
    has_fallen = false;
  }
  return pulses;
}

std::vector<double> speed_of_pulses(std::span<const double> signal,
                                    double rate,
                                    double pitch,
                                    const std::string& channel,
                                    const std::string& source) {
  const std::vector<double> pulses = pulses_of(signal);
  if (pulses.size() < kFewestPulses) {
    throw InputError({source, 0},
                     fmt::format("channel {} has {} pulses, expected {} at least: is it that of "
                                 "the toothed wheel, and did the drum turn?",
                                 in_quotes(channel),
                                 pulses.size(),
                                 kFewestPulses));
  }
  for (std::size_t k = 0; k + 1 < pulses.size(); ++k) {
    if (pulses[k + 1] - pulses[k] >= kFewestSamples) continue;
    throw InputError(
        {source, 0},
        fmt::format("channel {} has pulses {:.1f} samples apart at sample {:.0f}, expected {:.0f} "
                    "at least: record it faster, or use a wheel of fewer teeth",
                    in_quotes(channel),
                    pulses[k + 1] - pulses[k],
                    pulses[k],
                    kFewestSamples));
  }
  const WayOfPulses way(pulses, static_cast<double>(signal.size() - 1));
  std::vector<double> speed(signal.size());
  for (std::size_t i = 0; i < speed.size(); ++i) {
    const double sample = static_cast<double>(i);
    speed[i] = pitch * rate * (way(sample + 0.5) - way(sample - 0.5));
  }
  return speed;
}

}  // namespace latsch
