// SPDX-License-Identifier: Apache-2.0
// Derivatives of steady states by numbers of the tire (rolling_tire_impl.h).
//
// The residual of (R.3) changes by the elements' forces with the number decreased and increased, at
// unknowns that stay. A spin that follows from a drive turns inertia along, which the Jacobian of
// the patch does not contain: the answer to a unit of it is found once and added by its share. The
// forces are then differences between two patches that are moved by a step to either side.
#include "models/fe_tire/motion/spin.h"
#include "models/fe_tire/rolling/rolling_tangent.h"
#include "models/fe_tire/rolling/rolling_tire_impl.h"

namespace latsch::fe_tire {
namespace {

/// Returns (above - below) times a factor.
RollingForces difference(const RollingForces& below, const RollingForces& above, double factor) {
  RollingForces found;
  found.force = factor * (above.force - below.force);
  found.moment = factor * (above.moment - below.moment);
  found.traction = factor * (above.traction - below.traction);
  found.drive = factor * (above.drive - below.drive);
  found.friction_power = factor * (above.friction_power - below.friction_power);
  return found;
}

}  // namespace

/// Returns the forces g of (R.1) with other elements, without the ground.
Result<Eigen::VectorXd> RollingTire::Impl::forces(const RollingState& state,
                                                  const RingElements& with,
                                                  double pressure) const {
  AssembledState at{unknowns.compress(state.u), state.alpha};
  Eigen::VectorXd g;
  int worst = 0;
  if (!assembly.assemble(with, at, pressure, g, nullptr, &worst))
    return Failure{"slopes: an element is inverted beside the state, " +
                   unknowns.ring().place(worst)};
  g -= state.of.spin * state.of.spin * flow_forces(unknowns, with, state.u);
  return g;
}

Result<std::vector<RollingRates>> RollingTire::rates(const RollingState& of,
                                                     const std::vector<RollingCause>& causes) {
  Impl& impl = *impl_;
  if (impl.history)
    return Failure{
        "slopes: rubber or cords of the tire relax, and derivatives of a rolling tire are known "
        "for elastic ones: expected differences of trials"};
  const double spin = of.of.spin;
  Impl::Iterate now{{impl.unknowns.compress(of.u), of.alpha}, {}};
  if (const Status done = impl.evaluate(now, of.pressure, spin, true); !done) return done.failure();
  RollingTangent tangent(impl.linear, impl.K, of.of, now.state.x, of.grip);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(tangent.size());
  const Eigen::VectorXd by_spin = tangent.motion(
      -2.0 * spin * spin * flow_forces(impl.unknowns, impl.elements, of.u), none, 0.0);
  std::vector<RollingRates> rates;
  for (const RollingCause& cause : causes) {
    const auto below = impl.forces(of, *cause.below, cause.pressure_below);
    const auto above = impl.forces(of, *cause.above, cause.pressure_above);
    if (!below || !above) return (below ? above : below).failure();
    const double factor = 0.5 / cause.step;
    const auto friction = cause.friction.value_or(std::pair(of.of.friction, of.of.friction));
    Eigen::VectorXd of_ground = none;
    if (cause.friction)
      of_ground =
          factor * (tangent.residual_with(friction.second) - tangent.residual_with(friction.first));
    Eigen::VectorXd q = tangent.motion(factor * (*above - *below), of_ground, cause.spin);
    const double share =
        of.of.drive ? tangent.spin_change(q) / (1.0 - tangent.spin_change(by_spin)) : cause.spin;
    q += share * by_spin;
    RollingRates found;
    found.forces = difference(tangent.forces(-cause.step * q, friction.first),
                              tangent.forces(cause.step * q, friction.second),
                              factor);
    found.height = tangent.rise(q);
    found.spin = spin * tangent.spin_change(q);
    rates.push_back(std::move(found));
  }
  return rates;
}

}  // namespace latsch::fe_tire
