// SPDX-License-Identifier: Apache-2.0
// A problem as a solver sees it: smooth, or disturbed as simulations are.
//
//   rough    r_i + 1e-3 s sin(2 pi w_i'u + p_i): ripple of 20 to 100 waves over every range, as of
//            meshes, contact and solvers' tolerances; the same whenever a point is asked again
//   noisy    r_i + 1e-3 s N(0, 1), drawn from the bits of the point
//   failing  a corner of 13.5 % of the space has no outcome: a half space, or where two variables
//            both pass a limit; its edge next to the truth, and the truth inside for every other
//            problem, if that can be
//
// s: root mean square of the residuals at the start. Solved is what the undisturbed residuals say.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "identification_set/identification_problems.h"

namespace latsch::identification_set {

enum class Variant { smooth, rough, noisy, failing };
inline constexpr Variant kVariants[] = {
    Variant::smooth, Variant::rough, Variant::noisy, Variant::failing};
const char* name(Variant variant);

inline constexpr double kCorner = 0.135;  // share of the space

/// a'u > b
struct HalfSpace {
  Eigen::VectorXd a;
  double b;
};

class DisturbedProblem {
 public:
  /// `number` of the problem among all: for every other one the truth fails.
  DisturbedProblem(const Problem& problem, Variant variant, int number);

  const Problem& problem() const { return problem_; }
  Variant variant() const { return variant_; }

  /// What a solver is shown; nullopt: a failure.
  std::optional<Vector> shown(const Vector& x) const;
  /// The sum of squares without the disturbance; infinite where the point fails.
  double exact(const Vector& x) const;

  /// Where all of these hold a point fails; none: nowhere.
  const std::vector<HalfSpace>& corner() const { return corner_; }
  bool fails(const Vector& x) const;

 private:
  Problem problem_;
  Variant variant_;
  double s_;
  std::vector<HalfSpace> corner_;
};

}  // namespace latsch::identification_set
