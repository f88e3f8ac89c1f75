// SPDX-License-Identifier: Apache-2.0
#include "models/car/air_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace latsch::car {

namespace {

// m/s; a slower car stands, and its air forces are below a millionth of those at 1 m/s
constexpr double kSlowest = 1e-3;

constexpr const char* kFloorAxles[] = {"front", "rear"};

}  // namespace

void AirWatch::see(const Car& car, const CarState& state, double time) {
  const auto heights = car.floor_heights(state);
  if (!heights || std::abs(state.bodies.rates[6 * car.parts().chassis]) < kSlowest) return;
  const auto map = car.parameters().aero->heights();
  bool is_outside = false;
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    AtAxle& axle = axles_[i];
    const double height = (*heights)[i];
    axle.map = map[i];
    axle.least = samples_ == 0 ? height : std::min(axle.least, height);
    axle.most = samples_ == 0 ? height : std::max(axle.most, height);
    if (height >= map[i].from && height <= map[i].to) continue;
    ++axle.outside;
    if (first_.empty())
      first_ = fmt::format(
          "at {:.4g} s the car's floor is {:.4g} mm high at the {} axle, outside of the heights of "
          "aero.map, {:.4g} to {:.4g} mm: the coefficients of the map's edge are taken there, "
          "constant beyond it",
          time,
          1e3 * height,
          kFloorAxles[i],
          1e3 * map[i].from,
          1e3 * map[i].to);
    is_outside = true;
  }
  ++samples_;
  outside_ += is_outside ? 1 : 0;
}

std::string AirWatch::sentence() const {
  if (outside_ == 0) return "";
  std::string where;
  for (std::size_t i = 0; i < axles_.size(); ++i) {
    const AtAxle& axle = axles_[i];
    if (axle.outside == 0) continue;
    where += fmt::format(
        "{}at the {} axle it is {:.4g} to {:.4g} mm high, the map has {:.4g} to "
        "{:.4g} mm",
        where.empty() ? "" : "; ",
        kFloorAxles[i],
        1e3 * axle.least,
        1e3 * axle.most,
        1e3 * axle.map.from,
        1e3 * axle.map.to);
  }
  return fmt::format(
      "the car's floor is outside of the heights of aero.map in {} of {} samples ({:.3g} % of the "
      "time), where the coefficients of the map's edge are taken: {}",
      outside_,
      samples_,
      100.0 * static_cast<double>(outside_) / static_cast<double>(samples_),
      where);
}

}  // namespace latsch::car
