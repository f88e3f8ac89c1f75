// SPDX-License-Identifier: Apache-2.0
// Trials at the end of a search that show what may be said of single variables there.
//
//   at a bound  Over a move from the bound into the range the slope of the sum of squares S is
//               positive by more than its error, and one trial, in which all such variables are
//               moved in by the tolerance, has a larger S.
//   flat        Moves of the variable alone by 0.3 of its range to one side, and of all such
//               variables by 0.1 and 0.3 to both sides as far as bounds allow, change the residuals
//               by no more than 1e-6 of their norm.
//
// A variable is tried for flatness only if the slopes let expect little effect. So a search whose
// variables all have an effect, and none of which lies at a bound, spends no trial here.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimization/least_squares/open_variables.h"
#include "optimization/trust_region/search_ending.h"
#include "optimization/trust_region/trust_box.h"

namespace latsch {

class EndingTrials {
 public:
  /// The trials are made around a sample of the box, at which the slopes are known. `tolerance` is
  /// that of the search, in widths. If the residuals have vanished, the fit cannot improve beyond a
  /// bound, so bounds are not tried.
  EndingTrials(const TrustBox& box,
               int center,
               const PointSlopes& slopes,
               double tolerance,
               bool r_has_vanished);

  /// Returns the next trial; nullopt if outcomes must arrive first or if none is left.
  std::optional<Wanted> next(const TrustBox& box);
  /// Receives the residuals of a trial; nullopt for a failure. Other points have no effect.
  void observe(const Eigen::VectorXd& u, const std::optional<Eigen::VectorXd>& r);

  /// Adds what the trials have shown.
  void report(const TrustBox& box, EndingEvidence& evidence) const;

 private:
  static constexpr int kBounds = -1, kAllFlat = -2;
  struct Planned {
    Eigen::VectorXd u;
    int of;  // index of the variable that is moved alone, kBounds or kAllFlat
  };

  void plan_bounds(const TrustBox& box, const PointSlopes& slopes);
  void plan_flat(const TrustBox& box, const PointSlopes& slopes);
  void plan_all_flat(const TrustBox& box);
  void plan(const TrustBox& box, const Eigen::VectorXd& u, int of);

  double tolerance_;
  bool r_has_vanished_;
  Eigen::VectorXd u_, r_;
  std::vector<Planned> left_, awaited_;
  std::vector<int> at_bounds_;
  double slope_ = 0.0;  // least ratio of a slope of S at a bound to its error
  std::optional<double> rise_;
  std::vector<int> flat_;
  bool is_flat_confirmed_ = false;
  double change_ = 0.0, farthest_ = 0.0;
};

}  // namespace latsch
