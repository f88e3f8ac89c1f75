// SPDX-License-Identifier: Apache-2.0
// Static equilibrium of the ring. From first touch the rim is lowered in equal steps. The
// equilibrium after each step is found by two nested loops:
//   renewal    updates frames of the blocks, road below them and friction limits for the shape
//   relaxing   while these are fixed, every force is the gradient of an energy: Newton's method
//              with a line search minimizes it
// The first is a fixed-point iteration whose convergence factor is the tread's height times the
// contact force divided by the belt's tension. The second always succeeds if the energy is bounded.
// If no equilibrium is found within the largest number of iterations, the step of the rim is
// divided.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/ring_tire/ring/ring_tire.h"

namespace latsch::ring_tire {
namespace {

constexpr double kSmallestShift = 1e4, kLargestShift = 1e12;  // 1/s^2
constexpr double kLargestMove = 5e-3;  // m, largest displacement of a node in one iteration

}  // namespace

/// Line search: moves q_ along a direction in which the energy falls, until the force along this
/// direction nearly vanishes. Returns false if the energy does not fall.
bool RingTire::advance_along(const NodeValues& direction) {
  constexpr double kFlat = 0.5;  // final slope of the energy as a share of the initial one
  constexpr int kMost = 20;
  const Eigen::VectorXd bent = section_.values(), bending = section_.direction();
  const auto slope_now = [&] {
    const double of_belt = (total_.array() * direction.array()).sum();
    return section_.on() ? of_belt + section_.residual().dot(bending) : of_belt;
  };
  const double first = slope_now();
  double low = 0.0, high = 0.0, at_low = first, at_high = 0.0;
  double share = std::min(1.0, kLargestMove / direction.topRows<3>().cwiseAbs().maxCoeff());
  for (int i = 0; i < kMost; ++i) {
    q1_ = q_ + share * direction;
    if (section_.on()) section_.set_values(bent + share * bending);
    evaluate(q1_, v1_);
    const double slope = slope_now();
    const bool falls = slope >= 0.0;
    if (std::abs(slope) <= kFlat * first || (falls && high == 0.0)) {
      q_ = q1_;
      return true;
    }
    // Regula falsi (Illinois variant) for the point where the energy stops falling; bisection if
    // the energy is not finite.
    if (falls) {
      low = share;
      at_low = slope;
      at_high *= 0.5;
    } else {
      high = share;
      at_high = slope;
      if (i > 0) at_low *= 0.5;
    }
    share = std::isfinite(slope) ? low + (high - low) * at_low / (at_low - at_high)
                                 : 0.5 * (low + high);
  }
  return false;
}

/// Minimizes the energy, starting at q_, while frames of the blocks, road and friction limits are
/// fixed.
bool RingTire::relax() {
  constexpr int kMost = 60;
  constexpr double kOfTolerance = 0.3;  // share of the static tolerance at which the iteration ends
  double shift = 0.0;
  for (int i = 0; i < kMost; ++i) {
    evaluate(q_, v1_);
    if (!std::isfinite(total_.norm())) return false;
    if (left_together() <= kOfTolerance * settings_.static_tolerance) return true;
    while (!factorize(q_, shift, 1.0, rule_)) {
      shift = std::max(10.0 * shift, kSmallestShift);
      if (!(shift < kLargestShift)) return false;
    }
    residual_ = total_;
    solve();
    if (!advance_along(residual_)) return false;
    shift = shift > kSmallestShift ? 0.1 * shift : 0.0;
  }
  return false;
}

/// Finds the equilibrium at the present position of the rim, starting at q_.
Status RingTire::equilibrate(const road::Road& road, double time) {
  // Number of renewals after which the search for an equilibrium is given up.
  constexpr int kRenewals = 40;
  // A block on an edge of the road may alternate between the two planes of this edge. After this
  // number of updates it keeps its plane.
  constexpr int kLooksAtRoad = 12;
  rule_ = {};
  v1_.setZero();
  section_.restart();
  tread_.bend(section_);
  double left = 0.0;
  for (int renewal = 0; renewal < kRenewals; ++renewal) {
    if (renewal < kLooksAtRoad) {
      tread_.approach(q_, rim_, road, time, rule_, {&q_, &v_});
      if (section_.on()) section_.touch(tread_.nodes_near_road());
    }
    if (!tread_.knows_road())
      return Failure{fmt::format("no equilibrium of the ring: {}", kNoRoad)};
    evaluate(q_, v1_);
    tread_.hold_friction();
    evaluate(q_, v1_);
    left = left_together();
    if (left <= settings_.static_tolerance) {
      inner_forces_.commit(q_, rim_, rule_);
      tread_.commit();
      if (section_.on()) section_.accept();
      return {};
    }
    if (!relax()) break;
  }
  return Failure{
      fmt::format("no equilibrium of the ring: {:.3g} N are left, axle at height {:.4f} m",
                  left,
                  rim_.center.z())};
}

/// Moves the rim from one height to another. If a step finds no equilibrium, it is divided.
Status RingTire::lower(double from, double to, const road::Road& road, double time, int halvings) {
  const NodeValues before = q_;
  rim_.center.z() = to;
  const Status found = equilibrate(road, time);
  if (found.ok() || halvings == 0) return found;
  q_ = before;
  const double middle = 0.5 * (from + to);
  const Status first = lower(from, middle, road, time, halvings - 1);
  return first.ok() ? lower(middle, to, road, time, halvings - 1) : first;
}

Result<HubForces> RingTire::settle(const WheelMotion& motion, const road::Road& road, double time) {
  if (const Status fit = check_motion(motion); !fit) return fit.failure();
  if (!settled_) return find_rest(motion, road, time);
  const RingState before = state();
  Result<HubForces> hub = find_rest(motion, road, time);
  if (!hub) restore(before);
  return hub;
}

Result<HubForces> RingTire::find_rest(const WheelMotion& motion,
                                      const road::Road& road,
                                      double time) {
  rim_ = RimFrame::of(motion);
  reuse_.forget();
  place_at_rest();
  const double end = rim_.center.z();
  const double depth = std::max(0.0, tread_.deepest(q_, rim_, road, time));
  if (!std::isfinite(depth)) return Failure{fmt::format("no equilibrium of the ring: {}", kNoRoad)};
  q_.row(2).array() += depth;
  double height = end + depth;
  for (int i = settings_.lowerings - 1; i >= 0; --i) {
    const double next = end + depth * i / settings_.lowerings;
    const Status found = lower(height, next, road, time, settings_.halvings);
    if (!found) return found.failure();
    height = next;
  }
  if (const Status there = check_belt(q_, time); !there) return there.failure();
  const HubForces forces = hub_forces(motion.carrier);
  roll_on(motion);
  last_motion_ = motion;
  settled_ = true;
  return forces;
}

}  // namespace latsch::ring_tire
