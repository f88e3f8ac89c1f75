// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/loading.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace latsch::fe_tire {
namespace {

/// Length of a step with friction, and of the parts of a step, relative to the height of the wheel
/// center. A step is computed part by part on the tire linearized at its start. A point that sticks
/// during a part stays near its position at the beginning of this part. Longer steps or parts lose
/// accuracy. Forces differ by less than 0.1 % from those of steps ten times as short (./bench.sh
/// footprint friction); steps of 1/60 gave 0.3 %, parts of 1/300 0.4 %.
constexpr double kFrictionStep = 1.0 / 100.0, kPart = 1.0 / 1000.0;
constexpr double kRounding = 1e-9;
constexpr double kShortest = 1.0 / 64.0;  // shortest step, as a share of the intended one

/// Returns the length of the ground's motion between two poses, m.
double way(const GroundPose& a, const GroundPose& b) {
  const double turn = std::max(std::abs(b.camber - a.camber), std::abs(b.yaw - a.yaw));
  return std::max({std::abs(b.height - a.height),
                   std::abs(b.x - a.x),
                   std::abs(b.y - a.y),
                   turn * std::max(a.height, b.height)});
}

/// Returns intermediate poses of the ground on its path from a to b, and b.
std::vector<GroundPose> poses_between(const GroundPose& a, const GroundPose& b) {
  const int parts = static_cast<int>(std::ceil(way(a, b) / (kPart * a.height) - kRounding));
  std::vector<GroundPose> poses;
  for (int i = 1; i < parts; ++i) poses.push_back(between(a, b, static_cast<double>(i) / parts));
  return poses;
}

}  // namespace

Status move_ground(EquilibriumSolver& solver,
                   const RingElements& elements,
                   double pressure,
                   TreadContact& contact,
                   const GroundPose& pose,
                   const std::string& name,
                   Placed& placed) {
  const GroundPose first = placed.pose;
  Placed now = placed;
  double share = 0.0;
  const double longest =
      contact.has_friction() ? std::min(1.0, kFrictionStep * first.height / way(first, pose)) : 1.0;
  double step = longest;
  while (share < 1.0) {
    const double next = share + 1.001 * step >= 1.0 ? 1.0 : share + step;
    const GroundPose there = next == 1.0 ? pose : between(first, pose, next);
    contact.start(now.pose, now.state.x, now.anchors);
    if (contact.has_friction()) {
      const std::vector<GroundPose> on_way = poses_between(now.pose, there);
      contact.move(there);
      // If the path cannot be computed in parts, the step is done at once.
      if (!on_way.empty() && !solver.follow(elements, now.state, pressure, contact, on_way))
        contact.start(now.pose, now.state.x, now.anchors);
    }
    contact.move(there);
    AssembledState trial = now.state;
    const Status solved = solver.solve(elements, trial, pressure, &contact, name);
    if (solved.ok()) {
      now.anchors = contact.anchors(trial.x);
      now.state = std::move(trial);
      now.pose = contact.pose();
      share = next;
      step = std::min(2.0 * step, longest);
    } else if (step <= kShortest * longest) {
      return solved;
    } else {
      solver.forget_factor();  // the factorization belongs to a state of the failed step
      step *= 0.5;
    }
  }
  placed = std::move(now);
  return {};
}

}  // namespace latsch::fe_tire
