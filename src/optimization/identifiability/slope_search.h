// SPDX-License-Identifier: Apache-2.0
// Computes the derivative of residuals with respect to one variable by differences whose length is
// chosen for the use of the derivative.
//
// Three points have a spacing h, with the center in their middle if there is room on both sides:
//   J = (r+ - r-) / 2h      change = |r+ - r-| / 2      bend = |r+ - 2 r0 + r-| / 2 change
// (one-sided: J = (4 r1 - r2 - 3 r0) / 2h). Measurement noise is the same at all three points and
// cancels. J has errors by roughness of the model (solver tolerance, ripple from meshes and steps),
// proportional to 1 / h, and by curvature, proportional to h^2. A slope over much less than the
// confidence interval it will be used for is also a poor guide. Therefore
//   - if the residuals change by less than `felt`, the change at the ends of a confidence interval,
//     the step is lengthened to reach that change;
//   - if the three points do not lie on a line (bend > kStraight), a quarter of the length is
//     tried: if the second difference falls sixteenfold, it is due to curvature, and the shorter
//     step is better; otherwise it is due to roughness, and a longer step is better;
//   - of all lengths tried, at most kMostLengths, the straightest is used, and reported as rough if
//     even that is not straight.
// If one side has no room or fails, the other one is used. Usually two points are needed for each
// variable.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace latsch {

enum class SlopeQuality {
  straight,  // the three points lie on a line
  /// No length is straight: the slope is that of a rough or strongly curved model.
  rough,
  one_sided,  // only one point beside the center was available, so straightness was not checked
  unknown,    // every evaluation beside the center failed
};

class SlopeSearch {
 public:
  /// `has_room` returns true if the center may be moved by that offset. `first_length` is a share
  /// of the range.
  SlopeSearch(std::function<bool(double)> has_room, double first_length);

  /// Returns the offsets from the center to evaluate next; empty if the search has ended.
  const std::vector<double>& wanted() const { return wanted_; }
  /// Receives the residuals at the center and at wanted(), in units of their standard deviations;
  /// nullopt if an evaluation failed. `felt` is the change of the residuals at the ends of the
  /// confidence interval, 0 if it is not known.
  void observe(const Eigen::VectorXd& center,
               double felt,
               const std::vector<std::optional<Eigen::VectorXd>>& residuals);

  SlopeQuality quality() const { return quality_; }
  const Eigen::VectorXd& slope() const { return slope_; }
  double length() const { return length_; }
  /// The ratio of the second difference to twice the change, for the length used; 0 if it is not
  /// known.
  double bend() const { return bend_; }
  /// One term of the slope, which is the sum of weight * value over the points, including the
  /// center with offset 0. The same sum gives the slope of any other quantity.
  struct Term {
    double offset, weight;
  };
  const std::vector<Term>& terms() const { return terms_; }

 private:
  struct Tried {
    double length, change, bend;
    Eigen::VectorXd slope, second;  // first derivative, second difference
    std::vector<Term> terms;
  };
  struct Point {
    double offset;
    std::optional<Eigen::VectorXd> r;
  };

  bool plan(double length);
  bool is_open(double offset) const;
  const Eigen::VectorXd* known(double offset) const;
  std::optional<Tried> stencil(const Eigen::VectorXd& center, double length) const;
  std::optional<double> next_length(double felt) const;
  const Tried* at_length(double length) const;
  void finish(const Eigen::VectorXd& center);

  std::function<bool(double)> has_room_;
  std::vector<double> wanted_;
  std::vector<Point> points_;
  std::vector<Tried> tried_;
  double planned_ = 0.0;
  int shortened_ = 0;  // number of times the length was shortened because of failures
  SlopeQuality quality_ = SlopeQuality::unknown;
  Eigen::VectorXd slope_;
  std::vector<Term> terms_;
  double length_ = 0.0, bend_ = 0.0;
};

}  // namespace latsch
