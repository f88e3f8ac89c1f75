// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/noise_check.h"

#include <cmath>

namespace latsch {
namespace {

// Length of a trial's move, in moves over which the slopes were found.
constexpr double kLength = 0.1;
// Error of a trial, as a share of the claimed noise, from which on it counts as noise: as much as
// wrong slopes leave of their error over a move as short. A smaller share calls curvature noise, a
// larger one calls a ripple of long waves curvature.
constexpr double kNoisy = 0.1;

}  // namespace

NoiseCheck::NoiseCheck(const TrustBox& box, const ClaimedNoise& claimed)
    : claimed_(claimed), u_(box.c()), r_(box.memory[box.center()].r) {}

std::optional<Wanted> NoiseCheck::next(TrustBox& box) {
  const int axes = claimed_.frame.axes();
  while (!awaited_ && !is_confirmed_ && tried_ < kMost) {
    ++tried_;
    const Eigen::VectorXd drawn = box.draw();
    Eigen::VectorXd y(axes);
    for (int k = 0; k < axes; ++k) y[k] = drawn[k] < 0.0 ? -1.0 : 1.0;
    const auto point = box.probe_by(kLength / std::sqrt(axes) * (claimed_.frame.T * y), {});
    if (!point) continue;
    awaited_ = point->u;
    return point;
  }
  return std::nullopt;
}

void NoiseCheck::observe(const Eigen::VectorXd& u, const std::optional<Eigen::VectorXd>& r) {
  if (!awaited_ || *awaited_ != u) return;
  awaited_.reset();
  if (!r) return;
  const double error = (*r - r_ - claimed_.slopes.J * (u - u_)).norm();
  is_confirmed_ |= error >= kNoisy * claimed_.norm;
  near_ += error < kNoisy * claimed_.norm;
}

}  // namespace latsch
