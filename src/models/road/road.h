// SPDX-License-Identifier: Apache-2.0
// Interface of a road for tires: height, normal and friction of the ground below a point, and the
// velocity of the ground there (belt and drum rigs move the road under a standing tire).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace latsch::road {

/// The ground below one point, in the inertial frame with z up.
struct GroundPoint {
  double height = 0.0;                                // m
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit vector, upward
  double friction = 1.0;  // factor by which the tire's own friction is multiplied
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, velocity of the ground's material
  /// Angular velocity of the ground, rad/s; points above it move accordingly.
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();
};

/// Successive pieces along a row, such as tread blocks, at which the road is evaluated: positions
/// of their centers, and of the count + 1 borders between and around them, m.
struct GroundRow {
  int count;                                  // number of pieces
  const double *x, *y, *border_x, *border_y;  // m; `count` centers and count + 1 borders
};

/// Result of the evaluation of a road along a row: the ground at each piece and the heights at the
/// borders.
struct RowGround {
  double* border_height;  // m
  double* height;         // m, at the center of each piece
  /// Mean height of each piece from border to border, m. If the ground is practically straight
  /// there, this is the height at the center.
  double* mean;
  double* slope[2];     // dz/dx, dz/dy at the centers
  double* friction;     // friction factor at the centers
  double* velocity[3];  // m/s, velocity of the ground's material at the centers
};

/// A rectangle in plan view, m.
struct GroundBox {
  double x0, x1, y0, y1;  // m: x0 <= x <= x1, y0 <= y <= y1
};

/// A smooth drum: a cylinder that rotates about its axis, which is parallel to y.
struct Cylinder {
  double x, z;    // m, axis
  double radius;  // m
  /// 1 if the road is the inside of the drum, below its axis; -1 if it is the outside, above the
  /// axis
  double up;
  double rate;      // rad/s, angular velocity about y
  double friction;  // factor
};

/// Properties of a road that hold at every point of a rectangle.
struct GroundBounds {
  double highest = std::numeric_limits<double>::infinity();  // m: upper bound of the height
  /// True: in the whole rectangle the road is the plane, with the friction, that at() returns for
  /// its center.
  bool plane = false;
  /// Set if the road in the rectangle is this smooth drum.
  std::optional<Cylinder> cylinder = std::nullopt;
  /// True if the road along a line may be straight although the road in the whole rectangle is no
  /// plane.
  bool lines_differ = true;
};

/// Returns true if the heights at two points and at the middle between them lie practically on one
/// straight line.
inline bool is_straight(double from, double middle, double to) {
  constexpr double kStraight = 1e-6;  // m
  return std::abs(from + to - 2.0 * middle) <= kStraight;
}

class Road {
 public:
  virtual ~Road() = default;

  /// Returns the ground at x, y in m and `time` in s. The result is defined for every finite x, y;
  /// the documentation of each class says how the road continues beyond its data. All functions are
  /// const and need no locks, so that several threads may use one road.
  virtual GroundPoint at(double x, double y, double time) const = 0;
  /// Returns only the height, m, with the same bits as at(). Tire models call this function most
  /// often, for enveloping and contact search.
  virtual double height(double x, double y, double time) const { return at(x, y, time).height; }
  /// Returns the mean height, m, along the straight line between two points of the ground. A piece
  /// of tread rests on this line. Roads without a closed form sample the height.
  virtual double mean_height(const Eigen::Vector2d& from,
                             const Eigen::Vector2d& to,
                             double time) const;
  /// Returns an empty text if the road's data cover this point. Otherwise returns the reason, such
  /// as the end of a grid. Beyond its data the result of at() is extrapolated, and a car that rolls
  /// there needs permission (models/car/car.h).
  virtual std::string beyond(double x, double y) const;
  /// Evaluates a whole row at once. Results equal those of at(), height() and mean_height() up to
  /// rounding.
  virtual void below(const GroundRow& row, double time, const RowGround& ground) const;
  /// Returns bounds that hold in a rectangle, for tires that evaluate thousands of points per step.
  /// A road without an override has no bounds.
  virtual GroundBounds bounds(const GroundBox&, double) const { return {}; }
};

}  // namespace latsch::road
