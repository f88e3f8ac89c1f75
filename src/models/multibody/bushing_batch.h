// SPDX-License-Identifier: Apache-2.0
// Many bushings at once, four side by side, by the kernel sets. Springs and dampers agree to
// rounding with bushing.h, which is the reference. Parts (BushingParameters::parts) are not
// included.
#pragma once

#include <span>

#include "models/multibody/bushing.h"

namespace latsch::multibody {

/// Inputs of a bushing, and pointers to the numbers to which its results are added. No pointer is
/// null: results for the ground are added to numbers that are not read.
struct BushingTask {
  const double* place;              // numbers of a BushingPlace
  const double* parameters;         // numbers of BushingParameters
  const double *pose_a, *pose_b;    // numbers of Poses
  const double *rates_a, *rates_b;  // six each
  double *on_a, *on_b;              // wrenches
  double *aa, *ab, *ba, *bb;        // blocks of the tangent, column by column
};

/// Return the numbers of these values as one array.
inline const double* numbers_of(const BushingPlace& place) { return place.in_a.data(); }
inline const double* numbers_of(const BushingParameters& bushing) {
  return bushing.stiffness.data();
}
inline const double* numbers_of(const Pose& pose) { return pose.place.data(); }

/// Evaluates a multiple of four tasks. `rate_share` is that of forces_in_motion(). If nothing
/// moves, rates are not read. Returns the largest angle of all, rad.
double add_bushings(std::span<const BushingTask> tasks, bool moving, double rate_share);

}  // namespace latsch::multibody
