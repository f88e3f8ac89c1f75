// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/tire_footprint.h"

#include <cmath>

#include "experiment/rigs/fe_tire/deflection_for_load.h"

namespace latsch::experiment {

using fe_tire::TireState;

Footprint footprint_of(const fe_tire::Standing& standing, double friction) {
  const fe_tire::ContactPatch& patch = standing.patch;
  Footprint print{patch.length, patch.width, patch.area, standing.force.z(), {}};
  for (const auto& at : patch.points) {
    print.elements.push_back({.x = at.x,
                              .y = at.y,
                              .length = at.length,
                              .width = at.area / at.length,
                              .pressure = at.pressure,
                              .shear_x = at.shear_x,
                              .shear_y = at.shear_y,
                              .friction = friction,
                              .blur = std::sqrt(0.5)});  // (P.1)
  }
  return print;
}

Result<StandingTire> stand_in_states(fe_tire::FeTire& tire,
                                     double pressure,
                                     const fe_tire::Ground& ground,
                                     const FootprintTest& test) {
  constexpr double kTypicalStiffness = 2.0e5;  // N/m, for a first guess of the deflection
  auto inflated = tire.inflate(pressure);
  if (!inflated) return inflated.failure();
  StandingTire standing{*std::move(inflated), {}};
  StandingPose pose{.camber = test.camber};
  if (test.camber != 0.0) pose.poses = fe_tire::FeTire::Poses::any;
  for (const double load : test.loads) {
    auto state =
        load_to_force(tire, standing.inflated, load, load / kTypicalStiffness, ground, pose);
    if (!state) return state.failure();
    standing.states.push_back(*std::move(state));
  }
  if (test.deflections.empty()) return standing;
  auto pressed = press_down(tire, standing.inflated, ground, pose, test.deflections);
  if (!pressed) return pressed.failure();
  for (TireState& state : *pressed) standing.states.push_back(std::move(state));
  return standing;
}

std::vector<StandingFootprint> footprints(fe_tire::FeTire& tire, const StandingTire& standing) {
  std::vector<StandingFootprint> prints;
  for (const TireState& state : standing.states)
    prints.push_back({state.deflection(), footprint_of(tire.stand(state), state.ground.mu)});
  return prints;
}

Result<ChannelSlopes> footprint_slopes(const FootprintTest& test,
                                       const StandingTire& standing,
                                       const std::vector<StandingFootprint>& of,
                                       fe_tire::TireSlopes& slopes) {
  const auto of_inflated = slopes.of_inflated(standing.inflated);
  if (!of_inflated) return of_inflated.failure();
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(std::ssize(of), slopes.variables());
  Eigen::MatrixXd load = zero, deflection = zero, length = zero, width = zero, area = zero,
                  pressure = zero;
  for (std::size_t i = 0; i < of.size(); ++i) {
    const TireState& state = standing.states[i];
    const auto of_state = slopes.of_state(state);
    if (!of_state) return of_state.failure();
    const bool is_load_held = i < test.loads.size();
    const Eigen::VectorXd height =
        is_load_held ? fe_tire::TireSlopes::height_under_load(*of_state) : of_inflated->radius;
    const auto of_patch = slopes.of_patch(state, height);
    if (!of_patch) return of_patch.failure();
    const auto row = static_cast<Eigen::Index>(i);
    if (is_load_held)
      deflection.row(row) = of_inflated->radius - height;
    else
      load.row(row) = of_state->force + of_state->by_height * height;
    length.row(row) = of_patch->length;
    width.row(row) = of_patch->width;
    area.row(row) = of_patch->area;
    const Footprint& print = of[i].footprint;
    if (print.area > 0.0)
      pressure.row(row) = (load.row(row) - print.mean_pressure() * area.row(row)) / print.area;
  }
  return ChannelSlopes{{"load", load},
                       {"deflection", deflection},
                       {"length", length},
                       {"width", width},
                       {"area", area},
                       {"mean_pressure", pressure},
                       {"grip_level", zero}};
}

}  // namespace latsch::experiment
