// SPDX-License-Identifier: Apache-2.0
// The derivative of residuals in one variable by differences whose length follows from what it is
// for.
//
// Three points a length h apart, the center in their middle where there is room on both sides:
//   J = (r+ - r-) / 2h      change = |r+ - r-| / 2      bend = |r+ - 2 r0 + r-| / 2 change
// (one-sided: J = (4 r1 - r2 - 3 r0) / 2h). Measurement noise is the same at all three and cancels;
// what spoils J is roughness of the model (solver tolerance, ripple over meshes and steps), which
// counts as 1 / h, and curvature, which counts as h^2. And a slope over much less than the interval
// it will be used for says little about that. So
//   - where the residuals change by less than `felt`, as much as at the ends of a confidence
//     interval, the step is lengthened to where they would;
//   - where the three points lie on no line, bend > kStraight, a quarter of the length tells
//     whether that is curvature, whose second difference falls sixteenfold, and the shorter step is
//     better, or roughness, and a longer one is;
//   - of all lengths tried, kMostLengths at most, the straightest is taken, and said to be rough
//     where even that is not straight.
// Where a side has no room or fails the other one serves; two points a variable are the usual cost.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace latsch {

enum class SlopeQuality {
  straight,   // three points on a line
  rough,      // no length is straight: the slope is that of a rough or strongly curved model
  one_sided,  // only one point beside the center could be had: not checked
  unknown,    // every evaluation beside the center failed
};

class SlopeSearch {
 public:
  /// `has_room`: whether the center may be moved by that offset. First length, of the range.
  SlopeSearch(std::function<bool(double)> has_room, double first_length);

  /// Offsets to evaluate; empty when done.
  const std::vector<double>& wanted() const { return wanted_; }
  /// Residuals at the center and at wanted(), in units of their deviations; nullopt: failed. `felt`
  /// 0: nothing is known about the interval.
  void observe(const Eigen::VectorXd& center,
               double felt,
               const std::vector<std::optional<Eigen::VectorXd>>& residuals);

  SlopeQuality quality() const { return quality_; }
  const Eigen::VectorXd& slope() const { return slope_; }
  double length() const { return length_; }
  /// Of the length taken: the second difference over twice the change; 0 where it is not known.
  double bend() const { return bend_; }
  /// What the slope is made of, and any other quantity's over the same points: the sum of
  /// weight * value, one of them at the center, offset 0.
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
  int shortened_ = 0;  // for failures
  SlopeQuality quality_ = SlopeQuality::unknown;
  Eigen::VectorXd slope_;
  std::vector<Term> terms_;
  double length_ = 0.0, bend_ = 0.0;
};

}  // namespace latsch
