// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/fe_tire_specimen.h"

#include <fmt/format.h>

#include "experiment/tests/modes.h"

namespace latsch::experiment {

FeTireSpecimen::FeTireSpecimen(fe_tire::FeTire tire, double pressure)
    : tire_(std::move(tire)),
      pressure_(pressure),
      rig_(std::make_unique<TireRig>(tire_, pressure)) {}

void FeTireSpecimen::set(fe_tire::Materials materials, double pressure) {
  tire_.set(std::move(materials));
  pressure_ = pressure;
  rig_ = std::make_unique<TireRig>(tire_, pressure);
}

Result<std::vector<StandingFootprint>> FeTireSpecimen::footprints(const FootprintTest& test) {
  fe_tire::Ground ground;
  ground.mu = test.friction.value_or(0.0);
  return experiment::footprints(tire_, test.pressure.value_or(pressure_), ground, test);
}

std::string far_points(const fe_tire::Mesh& mesh, const Test& test) {
  constexpr double kFar = 0.02;  // m between a measured point and the nearest of the model
  const auto* modes = dynamic_cast<const ModesTest*>(&test);
  if (!modes || modes->settings().points.cols() == 0) return "";
  const double distance = nearest_sensors(mesh, modes->settings().points).largest_distance;
  if (distance <= kFar) return "";
  return fmt::format("a measured point lies {:.0f} mm from the outer surface of the model",
                     distance * 1e3);
}

}  // namespace latsch::experiment
