// SPDX-License-Identifier: Apache-2.0
// An identification problem as a solver sees it: smooth, or disturbed as simulations are.
//
//   rough    r_i + 1e-3 s sin(2 pi w_i'u + p_i): a ripple of 20 to 100 waves over every range, as
//            meshes, contact and solver tolerances cause; repeatable for every point
//   noisy    r_i + 1e-3 s N(0, 1), drawn from the bits of the point
//   failing  a corner of 13.5 % of the space has no outcome: a half space, or the region in which
//            two variables both exceed a limit. Its edge is near the true values; in every other
//            problem the true values are inside it, if possible
//
// r_i are the residuals, u the point in the unit cube, and s is the root mean square of the
// residuals at the start. The undisturbed residuals decide whether a problem is solved.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "identification_set/identification_problems.h"

namespace latsch::identification_set {

enum class Variant { smooth, rough, noisy, failing };
inline constexpr Variant kVariants[] = {
    Variant::smooth, Variant::rough, Variant::noisy, Variant::failing};
const char* name(Variant variant);

inline constexpr double kCorner = 0.135;  // share of the design space that fails

/// The half space a'u > b of points u in the unit cube.
struct HalfSpace {
  Eigen::VectorXd a;
  double b;
};

class DisturbedProblem {
 public:
  /// `number` is the problem's position among all problems; for every other one the true values lie
  /// in the failing corner.
  DisturbedProblem(const Problem& problem, Variant variant, int number);

  const Problem& problem() const { return problem_; }
  Variant variant() const { return variant_; }

  /// Returns the disturbed residuals that the solver sees; nullopt if the point fails.
  std::optional<Vector> shown(const Vector& x) const;
  /// Returns the undisturbed sum of squares; infinite if the point fails.
  double exact(const Vector& x) const;

  /// Returns the half spaces whose intersection is the failing corner; empty: no point fails.
  const std::vector<HalfSpace>& corner() const { return corner_; }
  bool fails(const Vector& x) const;

 private:
  Problem problem_;
  Variant variant_;
  double s_;
  std::vector<HalfSpace> corner_;
};

}  // namespace latsch::identification_set
