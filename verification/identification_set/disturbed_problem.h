// SPDX-License-Identifier: Apache-2.0
// A problem as a solver sees it: smooth, or disturbed as simulations are.
//
//   rough    r_i + 1e-3 s sin(2 pi w_i'u + p_i): ripple of 20 to 100 waves over every range, as by
//            meshes, contact and solvers' tolerances; the same for every evaluation of a point
//   noisy    r_i + 1e-3 s N(0, 1), drawn from the bits of the point
//   failing  a corner of 13.5 % of the space has no outcome: a half space, or the region in which
//            two variables both exceed a limit. Its edge is next to the truth; for every other
//            problem the truth is inside, if possible
//
// s is the root mean square of the residuals at the start. The undisturbed residuals decide whether
// a problem is solved.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "identification_set/identification_problems.h"

namespace latsch::identification_set {

enum class Variant { smooth, rough, noisy, failing };
inline constexpr Variant kVariants[] = {
    Variant::smooth, Variant::rough, Variant::noisy, Variant::failing};
const char* name(Variant variant);

inline constexpr double kCorner = 0.135;  // share of the space that fails

/// The half space a'u > b.
struct HalfSpace {
  Eigen::VectorXd a;
  double b;
};

class DisturbedProblem {
 public:
  /// `number` is the problem's number among all; for every other one the truth fails.
  DisturbedProblem(const Problem& problem, Variant variant, int number);

  const Problem& problem() const { return problem_; }
  Variant variant() const { return variant_; }

  /// Returns what a solver gets; nullopt: a failure.
  std::optional<Vector> shown(const Vector& x) const;
  /// The sum of squares without the disturbance; infinite if the point fails.
  double exact(const Vector& x) const;

  /// A point fails if it is inside all of these; empty: no point fails.
  const std::vector<HalfSpace>& corner() const { return corner_; }
  bool fails(const Vector& x) const;

 private:
  Problem problem_;
  Variant variant_;
  double s_;
  std::vector<HalfSpace> corner_;
};

}  // namespace latsch::identification_set
