// SPDX-License-Identifier: Apache-2.0
// The meridian of a tire: a smooth curve through given points, seen in the (y, r) half-plane.
//
// A natural cubic spline over the chord length runs through points given for one half, from crown
// to bead, and is mirrored. Positions along it are the normalized arc length s: -1 at the +y bead,
// 0 at the crown, +1 at the -y bead. |s| is what a tire file calls "position".
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::fe_tire {

/// A point of the half-plane: axial y and radius r, m.
struct MeridianPoint {
  double y = 0.0, r = 0.0;
  bool operator==(const MeridianPoint&) const = default;
};

class Contour {
 public:
  /// Takes points of the +y half from crown (y = 0) to bead, at least three.
  explicit Contour(const std::vector<MeridianPoint>& half);

  double length() const { return length_; }  // m, bead to bead
  MeridianPoint point(double s) const;       // on the curve
  MeridianPoint tangent(double s) const;     // unit vector of increasing s
  /// Returns the point at this distance (m, positive outward) along the normal.
  MeridianPoint offset(double s, double distance) const;

 private:
  double chord(double s) const;

  Eigen::VectorXd t_;              // chord length at the points
  Eigen::Matrix2Xd p_;             // (y, r) at the points
  Eigen::Matrix2Xd a1_, a2_, a3_;  // p = p_i + a1 d + a2 d^2 + a3 d^3, d = t - t_i
  std::vector<double> arc_;        // arc length at equally spaced chord lengths
  double length_ = 0.0;
};

}  // namespace latsch::fe_tire
