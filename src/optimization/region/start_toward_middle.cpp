// SPDX-License-Identifier: Apache-2.0
#include "optimization/region/start_toward_middle.h"

#include <array>
#include <iterator>

#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

constexpr std::array kTowardMiddle{0.25, 0.5, 0.75, 1.0};

}  // namespace

std::optional<StartAttempt> start_toward_middle(const DesignSpace& space,
                                                const FeasibleRegion& region,
                                                const StartAttempt& failed,
                                                double distance) {
  const Eigen::VectorXd start = to_vector(space.to_unit(space.initial()));
  const Eigen::VectorXd middle = region.nearest(Eigen::VectorXd::Constant(start.size(), 0.5));
  for (int k = failed.attempts; k < std::ssize(kTowardMiddle); ++k) {
    const Eigen::VectorXd u = start + kTowardMiddle[k] * (middle - start);
    if ((u - failed.u).norm() < distance) continue;
    return StartAttempt{u, k + 1};
  }
  return std::nullopt;
}

}  // namespace latsch
