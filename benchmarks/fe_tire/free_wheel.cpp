// SPDX-License-Identifier: Apache-2.0
#include "free_wheel.h"

#include <cmath>

#include "shipped_tires.h"

namespace latsch::benchmarks {

using namespace fe_tire;

namespace {

/// Deflection of the first equilibrium on the ground, relative to the radius.
constexpr double kFirst = 0.03;

RollingState standing(FeTire& tire, const Inflated& inflated, RollingTire& rolling) {
  return rolling.start(value_of(tire.advance(tire.over(inflated, {}, FeTire::Poses::any),
                                             {FeTire::below(inflated, kFirst * inflated.radius)}))
                           .back());
}

RollingState free_wheel(RollingTire& rolling,
                        const RollingState& start,
                        double radius,
                        double load,
                        double speed,
                        double friction) {
  RollingCase of;
  of.speed = speed;
  of.height = start.of.height;
  of.spin = speed / (radius - (radius - start.of.height) / 3.0);
  of.load = load;
  of.friction.at_rest = friction;
  if (friction > 0.0) of.drive = 0.0;
  return value_of(rolling.roll(start, of));
}

}  // namespace

FreeWheel::FreeWheel(const TireDescription& of,
                     const MeshRefinement& mesh,
                     double load,
                     double speed,
                     double friction)
    : tire(build_mesh(of, mesh), build_materials(of, mesh), {.element = of.element}),
      inflated(value_of(tire.inflate(of.pressure))),
      rolling(tire) {
  rolling.set_history(build_losses(of, mesh), inflated);
  state = free_wheel(
      rolling, standing(tire, inflated, rolling), inflated.radius, load, speed, friction);
}

RollingCase FreeWheel::at(double kappa, double alpha, double camber, double turn_slip) const {
  RollingCase of = state.of;
  of.drive.reset();
  of.slip_angle = alpha;
  of.speed = state.of.speed / std::cos(alpha);
  of.spin = (1.0 + kappa) * state.of.spin;
  of.camber = camber;
  of.turn_slip = turn_slip;
  return of;
}

}  // namespace latsch::benchmarks
