// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/observable.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace latsch::correlation {

std::vector<double> Observable::deviations(const MeasurementNoise& noise,
                                           const ObjectiveSettings&) const {
  std::vector<double> deviations;
  for (const double scale : scales())
    deviations.push_back(std::hypot(noise.relative, noise.absolute / scale));
  return deviations;
}

Result<Comparison> Observable::compare_shifted(const Channels& trial,
                                               const ObjectiveSettings& settings,
                                               double) const {
  return compare(trial, settings);
}

Result<DelayRange> Observable::shift_range(const Channels&) const { return DelayRange{}; }

Channels recording_of(const std::string& test, const Channels& trial) {
  const std::string prefix = test + "/";
  Channels own;
  for (Channel channel : trial.all()) {
    if (!channel.name.starts_with(prefix)) continue;
    channel.name.erase(0, prefix.size());
    own.add(std::move(channel));
  }
  return own;
}

nlohmann::ordered_json json_of(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json json_of(const std::vector<double>& values) {
  auto list = nlohmann::ordered_json::array();
  for (const double value : values) list.push_back(json_of(value));
  return list;
}

}  // namespace latsch::correlation
