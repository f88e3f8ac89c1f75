// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/car/post_notes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiment/rigs/car/car_record.h"
#include "experiment/rigs/car/post_spectra.h"
#include "experiment/rigs/slip/lift_watch.h"

namespace latsch::experiment {

std::vector<std::string> notes_of_lift(const Channels& record,
                                       const std::function<std::string(double)>& at_time) {
  const std::vector<double>& time = record["time"];
  std::vector<std::string> tires;
  double first = time.back(), last = time.front();
  const auto loads = of_corners("Fz");
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const std::vector<double>& load = record[loads[i]];
    bool left = false;
    for (std::size_t k = 0; k < load.size(); ++k) {
      if (load[k] > 0.0) continue;
      left = true;
      first = std::min(first, time[k]);
      last = std::max(last, time[k]);
    }
    if (left) tires.push_back(car::kCornerNames[i]);
  }
  if (tires.empty()) return {};
  return {fmt::format(
      "tires {} left their posts, first after {}, last after {}: the record there has no linear "
      "relation to the posts; a smaller amplitude or velocity keeps the tires down",
      fmt::join(tires, ", "),
      at_time(first),
      at_time(last))};
}

std::vector<std::string> lifts_of(const Channels& record, double sample_step) {
  const std::vector<double>& time = record["time"];
  std::vector<std::string> all;
  for (const char* corner : car::kCornerNames) {
    const std::vector<double>& load = record[std::string("Fz_") + corner];
    LiftLog lifts;
    for (std::size_t k = 0; k < load.size(); ++k) lifts.see(time[k], sample_step, load[k], 0.0);
    if (std::string said = lifts.sentence(); !said.empty())
      all.push_back(std::string(corner) + ": " + said);
  }
  return all;
}

std::vector<std::string> notes_of_coherence(const Channels& over_frequency) {
  constexpr double kLow = 0.9;
  const std::vector<double>& f = over_frequency["frequency"];
  std::vector<std::string> sensors;
  for (const std::string& sensor : spectra_sensors()) {
    const std::vector<double>& coherence = over_frequency["coherence_" + sensor];
    const auto low =
        std::count_if(coherence.begin(), coherence.end(), [](double one) { return one < kLow; });
    if (low == 0) continue;
    const auto least = std::min_element(coherence.begin(), coherence.end());
    sensors.push_back(fmt::format("{} at {} of {} lines (least {:.2f} at {:.4g} Hz)",
                                  sensor,
                                  low,
                                  coherence.size(),
                                  *least,
                                  f[static_cast<std::size_t>(least - coherence.begin())]));
  }
  if (sensors.empty()) return {};
  return {
      fmt::format("the coherence is below {:.1f}: {}: there the sensor's signal is no linear "
                  "response to the posts' mode, and the transfer function is not reliable",
                  kLow,
                  fmt::join(sensors, "; "))};
}

}  // namespace latsch::experiment
