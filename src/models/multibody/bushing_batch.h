// SPDX-License-Identifier: Apache-2.0
// Evaluates many bushings at once, four per vector register, with the kernels for the processor's
// instruction set. Results for springs and dampers agree with bushing.h, which is the reference, to
// rounding. Force parts (BushingParameters::parts) are not included.
#pragma once

#include <span>

#include "models/multibody/bushing.h"

namespace latsch::multibody {

/// Inputs of one bushing as pointers to arrays, and pointers to the arrays to which its results are
/// added. No pointer is null: results for the ground are added to an array that is never read.
struct BushingTask {
  const double* place;              // members of a BushingPlace as one array
  const double* parameters;         // members of BushingParameters as one array
  const double *pose_a, *pose_b;    // members of both bodies' Poses as arrays
  const double *rates_a, *rates_b;  // rates of bodies a and b, six numbers each
  double *on_a, *on_b;              // wrenches
  double *aa, *ab, *ba, *bb;        // blocks of the tangent, column by column
};

/// Return the members of these structures as one array of doubles.
inline const double* numbers_of(const BushingPlace& place) { return place.in_a.data(); }
inline const double* numbers_of(const BushingParameters& bushing) {
  return bushing.stiffness.data();
}
inline const double* numbers_of(const Pose& pose) { return pose.place.data(); }

/// Evaluates the tasks, whose number must be a multiple of four. `rate_share` has the meaning it
/// has in forces_in_motion(). If `moving` is false, rates are not read. Returns the largest angle
/// of any bushing, rad.
double add_bushings(std::span<const BushingTask> tasks, bool moving, double rate_share);

}  // namespace latsch::multibody
