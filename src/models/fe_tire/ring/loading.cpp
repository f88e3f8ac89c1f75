// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/ring/loading.h"

#include <fmt/format.h>

#include <cmath>

namespace latsch::fe_tire {
namespace {

constexpr double kFrictionStep =
    2.5e-3;  // m: a point slides freely until the end of the step in which it touches
constexpr int kMaxHalvings = 6;

/// Where the tire is and where it was one step before: what a prediction needs.
struct Path {
  double deflection = 0.0, before = 0.0;
  Eigen::VectorXd x, x_before;

  /// The state extrapolated along the last step, or as it is where there was none yet in contact.
  Eigen::VectorXd predict(double target) const {
    if (deflection == before) return x;
    return x + (target - deflection) / (deflection - before) * (x - x_before);
  }
  void advance(double target, const Eigen::VectorXd& solved) {
    before = deflection;
    x_before = std::move(x);
    deflection = target;
    x = solved;
  }
};

std::optional<Failure> go_to(double target,
                             double max_step,
                             EquilibriumSolver& solver,
                             const RingElements& elements,
                             const Inflated& inflated,
                             const std::string& name,
                             GroundContact& contact,
                             RingState& state,
                             Path& path) {
  int halvings = 0;
  double step = std::min(max_step, std::abs(target - path.deflection));
  while (path.deflection != target) {
    const double left = target - path.deflection;
    const double next =
        std::abs(left) <= 1.001 * step ? target : path.deflection + std::copysign(step, left);
    contact.set_height(-(inflated.radius - next));
    RingState trial{solver.solves_contact(&contact) ? path.x : path.predict(next), state.alpha};
    std::optional<Failure> failure =
        solver.solve(elements, trial, inflated.pressure, &contact, name);
    if (!failure) {
      state = std::move(trial);
      contact.settle(state.x);
      path.advance(next, state.x);
    } else if (++halvings > kMaxHalvings) {
      return failure;
    } else {
      step *= 0.5;
      path.before =
          path.deflection;  // a prediction may have been what failed: start from the state itself
    }
  }
  return std::nullopt;
}

}  // namespace

Result<std::vector<LoadPoint>> load_steps(EquilibriumSolver& solver,
                                          const RingElements& elements,
                                          const Inflated& inflated,
                                          const std::vector<double>& deflections,
                                          bool friction,
                                          GroundContact& contact,
                                          RingState& state) {
  std::vector<LoadPoint> curve;
  Path path;
  path.x = state.x;
  const double max_step = friction ? kFrictionStep : std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < deflections.size(); ++k) {
    const std::string name = fmt::format("load step {} of {} (deflection {:.4g} mm at {:.4g} bar)",
                                         k + 1,
                                         deflections.size(),
                                         deflections[k] * 1e3,
                                         inflated.pressure / 1e5);
    if (auto failure = go_to(
            deflections[k], max_step, solver, elements, inflated, name, contact, state, path)) {
      return *failure;
    }
    LoadPoint point;
    point.deflection = deflections[k];
    point.loaded_radius = inflated.radius - deflections[k];
    contact.set_height(-point.loaded_radius);
    point.patch = contact.patch(state.x, &point.Fz);
    curve.push_back(std::move(point));
  }
  return curve;
}

}  // namespace latsch::fe_tire
