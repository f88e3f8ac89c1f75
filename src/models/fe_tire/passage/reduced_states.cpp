// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/reduced_states.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "models/fe_tire/rolling/tread_roller.h"

namespace latsch::fe_tire {
namespace {

constexpr int kMostStates = 20;
constexpr double kEnoughOfState = 1e-5;  // residual relative to the load
/// Largest change of the height at once, m: points that come into reach are found in a band of
/// kNearPatch over the ground.
constexpr double kHeightAtOnce = 1e-3;

}  // namespace

Eigen::MatrixXd steady_stiffness(const ReducedTire& tire) {
  Eigen::MatrixXd K = tire.K;
  const Eigen::MatrixXd flow = tire.of.spin * tire.D;
  for (const RelaxingStiffness& part : tire.parts)
    for (const PronyTerm& term : part.terms) {
      Eigen::MatrixXd rate = flow;
      rate.diagonal().array() += 1.0 / term.tau;
      K += term.beta * part.K * rate.partialPivLu().solve(flow);
    }
  return K;
}

Result<RollingForces> steady_forces(const ReducedTire& tire,
                                    const GripState& from,
                                    const RollingCase& of) {
  const Eigen::MatrixXd F = tire.rest + tire.at_tread * steady_stiffness(tire).partialPivLu().solve(
                                                            tire.at_tread.transpose());
  Eigen::MatrixXd S = (0.5 * (F + F.transpose())).inverse();
  S = (0.5 * (S + S.transpose())).eval();
  TreadRoller roller(*tire.tread, *tire.lines);
  roller.set(S);
  const double load = std::max(1.0, tire.c.norm());
  GripState states = from;
  Eigen::VectorXd c = tire.c;
  int passes = 0;
  const auto settle = [&](const RollingCase& at) -> Result<RollingForces> {
    for (int k = 0; k < kMostStates; ++k) {
      const Eigen::VectorXd w = F * (c - tire.c);
      const Eigen::Matrix3Xd u = tire.u + w.reshaped(3, tire.u.cols());
      auto found = roller.solve(at, u, c, load, kEnoughOfState, states, passes);
      if (!found) return found.failure();
      const double residual = (S * (F * (found->c - tire.c) - w + found->d)).norm();
      c = std::move(found->c);
      if (residual <= kEnoughOfState * load) return found->forces;
    }
    return Failure{"the steady state of the reduced tire does not settle"};
  };
  const double way = std::abs(of.height - tire.of.height);
  const int parts = std::max(1, static_cast<int>(std::ceil(way / kHeightAtOnce)));
  Result<RollingForces> forces = Failure{""};
  for (int part = 1; part <= parts; ++part) {
    RollingCase at = between(tire.of, of, static_cast<double>(part) / parts);
    at.load.reset();
    at.drive.reset();
    roller.begin();
    forces = settle(at);
    if (!forces) return forces;
  }
  return forces;
}

Result<std::vector<ReducedError>> reduced_errors(RollingTire& full,
                                                 const RollingState& steady,
                                                 const ReducedTire& tire,
                                                 const std::vector<double>& lower) {
  std::vector<ReducedError> errors;
  for (const double by : lower) {
    RollingCase of = tire.of;
    of.load.reset();
    of.drive.reset();
    of.height -= by;
    const auto there = full.roll(steady, of);
    if (!there) return there.failure();
    const auto reduced = steady_forces(tire, steady.grip, of);
    if (!reduced) return reduced.failure();
    const double Fz = steady.forces.force.z();
    errors.push_back({by, there->forces.force.z() - Fz, reduced->force.z() - Fz});
  }
  return errors;
}

}  // namespace latsch::fe_tire
