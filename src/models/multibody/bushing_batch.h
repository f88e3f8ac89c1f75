// SPDX-License-Identifier: Apache-2.0
// Many bushings at once, four side by side by the kernel sets: springs and dampers as bushing.h has
// them, which is the reference, to rounding. What parts add (BushingParameters::parts) is not here.
#pragma once

#include <span>

#include "models/multibody/bushing.h"

namespace latsch::multibody {

/// What a bushing is asked with, and where its answer is added to. No pointer is null: what belongs
/// to the ground has a place that nobody reads.
struct BushingTask {
  const double* place;              // of a BushingPlace
  const double* parameters;         // of BushingParameters
  const double *pose_a, *pose_b;    // of Poses
  const double *rates_a, *rates_b;  // six each
  double *on_a, *on_b;              // wrenches
  double *aa, *ab, *ba, *bb;        // blocks of the tangent, column by column
};

/// The numbers of these values one after the other.
inline const double* numbers_of(const BushingPlace& place) { return place.in_a.data(); }
inline const double* numbers_of(const BushingParameters& bushing) {
  return bushing.stiffness.data();
}
inline const double* numbers_of(const Pose& pose) { return pose.place.data(); }

/// A multiple of four tasks. `rate_share` as in forces_in_motion(); nothing moves: rates are not
/// read. The largest angle of all, rad.
double add_bushings(std::span<const BushingTask> tasks, bool moving, double rate_share);

}  // namespace latsch::multibody
