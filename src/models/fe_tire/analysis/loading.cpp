// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/loading.h"

#include <algorithm>
#include <cmath>

namespace latsch::fe_tire {
namespace {

/// Of the wheel center's height. What sticks in a step counts as touched at its end: over steps of
/// 1/300 a patch, as long as the roots of height and depth, grows so little that forces err by some
/// 0.2 % against steps of a tenth (./bench.sh footprint friction); 2.5 mm gave up to 2 %.
constexpr double kFrictionStep = 1.0 / 300.0;
constexpr int kMaxHalvings = 6;

/// How far the ground goes, m.
double way(const GroundPose& a, const GroundPose& b) {
  const double turn = std::max(std::abs(b.camber - a.camber), std::abs(b.yaw - a.yaw));
  return std::max({std::abs(b.height - a.height),
                   std::abs(b.x - a.x),
                   std::abs(b.y - a.y),
                   turn * std::max(a.height, b.height)});
}

}  // namespace

std::optional<Failure> move_ground(EquilibriumSolver& solver,
                                   const RingElements& elements,
                                   double pressure,
                                   TreadContact& contact,
                                   const GroundPose& pose,
                                   const std::string& name,
                                   Placed& placed) {
  const GroundPose first = placed.pose;
  Placed now = placed;
  double share = 0.0;
  double step =
      contact.has_friction() ? std::min(1.0, kFrictionStep * first.height / way(first, pose)) : 1.0;
  for (int halvings = 0; share < 1.0;) {
    const double next = share + 1.001 * step >= 1.0 ? 1.0 : share + step;
    contact.start(now.pose, now.state.x, now.anchors);
    contact.move(next == 1.0 ? pose : between(first, pose, next));
    RingState trial = now.state;
    std::optional<Failure> failure = solver.solve(elements, trial, pressure, &contact, name);
    if (!failure) {
      now.anchors = contact.anchors(trial.x);
      now.state = std::move(trial);
      now.pose = contact.pose();
      share = next;
    } else if (++halvings > kMaxHalvings) {
      return failure;
    } else {
      step *= 0.5;
    }
  }
  placed = std::move(now);
  return std::nullopt;
}

}  // namespace latsch::fe_tire
