// SPDX-License-Identifier: Apache-2.0
// The meridian of a tire: a smooth curve through given points, seen in the (y, r) half-plane.
//
// A natural cubic spline over the chord length runs through points given for one half, from crown
// to bead, and is mirrored. Positions along it are the normalized arc length s: -1 at the +y bead,
// 0 at the crown, +1 at the -y bead. In a tire file, |s| is called "position".
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::fe_tire {

/// A point of the half-plane: axial coordinate y and radius r, m.
struct MeridianPoint {
  double y = 0.0, r = 0.0;
  bool operator==(const MeridianPoint&) const = default;
};

class Contour {
 public:
  /// Makes the contour from at least three points of its +y half, from the crown (y = 0) to the
  /// bead.
  explicit Contour(const std::vector<MeridianPoint>& half);

  double length() const { return length_; }  // m, length from bead to bead
  MeridianPoint point(double s) const;       // point of the curve at s
  MeridianPoint tangent(double s) const;     // unit vector in the direction of increasing s
  /// Returns the point at a distance (m, positive outward) from the curve, along its normal at s.
  MeridianPoint offset(double s, double distance) const;

 private:
  double chord(double s) const;

  Eigen::VectorXd t_;              // chord length up to each point
  Eigen::Matrix2Xd p_;             // the given points (y, r), m
  Eigen::Matrix2Xd a1_, a2_, a3_;  // p = p_i + a1 d + a2 d^2 + a3 d^3, d = t - t_i
  std::vector<double> arc_;        // arc length up to equally spaced values of the chord length
  double length_ = 0.0;
};

}  // namespace latsch::fe_tire
