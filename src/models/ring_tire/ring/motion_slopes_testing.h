// SPDX-License-Identifier: Apache-2.0
// Finite differences of trial steps, for tests and benchmarks of motion_slopes.h.
#pragma once

#include <algorithm>
#include <limits>

#include "models/ring_tire/ring/ring_tire.h"

namespace latsch::ring_tire {

/// Settings with which steps are solved down to rounding. Positions of about a meter are rounded to
/// 1e-16 m, and the springs of the belt have 1e8 N/m.
inline const RingSettings kUntilRounding = {.tolerance = 2e-8, .most_iterations = 100};

/// Compares the derivatives of hub forces and moments with central differences. Returns the largest
/// deviation over all columns, relative to the largest value in the column, or infinity if a trial
/// step fails.
inline double slopes_off_differences(const RingParameters& ring,
                                     const RingSettings& settings,
                                     const RingState& from,
                                     const WheelMotion& motion,
                                     const road::Road& road,
                                     double time,
                                     double step) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  RingTire tire(ring, settings);
  const auto middle = tire.trial(from, motion, road, time, step, true);
  if (!middle || !middle->slopes) return kNone;
  double worst = 0.0;
  for (int column = 0; column < kMotionColumns; ++column) {
    const double by = difference_step(column, step);
    const auto more = tire.trial(from, moved(motion, column, by), road, time, step),
               less = tire.trial(from, moved(motion, column, -by), road, time, step);
    if (!more || !less) return kNone;
    Eigen::Matrix<double, 6, 1> expected;
    expected << (more->hub.force - less->hub.force) / (2.0 * by),
        (more->hub.moment - less->hub.moment) / (2.0 * by);
    const double off = (middle->slopes->col(column) - expected).cwiseAbs().maxCoeff();
    worst = std::max(worst, off / expected.cwiseAbs().maxCoeff());
  }
  return worst;
}

}  // namespace latsch::ring_tire
