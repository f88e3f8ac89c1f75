// SPDX-License-Identifier: Apache-2.0
// What a tire asks a road: height, normal and friction of the ground below a point, and how fast
// the ground moves there (belt and drum rigs move the road under a standing tire).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace latsch::road {

/// The ground below one point. Inertial frame, z up.
struct GroundPoint {
  double height = 0.0;                                 // m
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   // unit, upward
  double friction = 1.0;                               // factor on the tire's own friction
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of the ground's material
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();   // rad/s, of it: what stands higher is faster
};

/// A row of pieces one behind the other, as of tread: places of their middles and of the count + 1
/// borders before, between and behind them, m.
struct GroundRow {
  int count;
  const double *x, *y, *border_x, *border_y;
};

/// What is below a row; of each piece, and of each border.
struct RowGround {
  double* border_height;  // m
  double* height;         // m, in the middle
  double* mean;         // m, from border to border; where that is as good as straight, the middle's
  double* slope[2];     // dz/dx, dz/dy in the middle
  double* friction;     // factor, there
  double* velocity[3];  // m/s, there, of the ground's material
};

/// A rectangle of the ground, m.
struct GroundBox {
  double x0, x1, y0, y1;
};

/// A smooth drum: a cylinder about an axis parallel to y that turns about it.
struct Cylinder {
  double x, z;      // m, of the axis
  double radius;    // m
  double up;        // 1 where the ground lies below the axis, the drum's inside; else -1
  double rate;      // rad/s, about y
  double friction;  // factor
};

/// What a road can say at once about all of a rectangle.
struct GroundBounds {
  double highest = std::numeric_limits<double>::infinity();  // m: no point of it is higher
  bool plane = false;  // all of it is the plane and the friction that `at` finds in its middle
  std::optional<Cylinder> cylinder = std::nullopt;  // all of it is that
  // A line in it may be a plane though all of it is none.
  bool lines_differ = true;
};

/// Whether heights at two places and between them are as good as on one straight line.
inline bool is_straight(double from, double middle, double to) {
  constexpr double kStraight = 1e-6;  // m
  return std::abs(from + to - 2.0 * middle) <= kStraight;
}

class Road {
 public:
  virtual ~Road() = default;

  /// x, y in m, `time` in s. Defined for every finite x, y: a road continues beyond its data in a
  /// way its class names. Const and without locks: many threads may ask one road.
  virtual GroundPoint at(double x, double y, double time) const = 0;
  /// The height alone, m, bit for bit that of `at`: what enveloping and contact search ask most.
  virtual double height(double x, double y, double time) const { return at(x, y, time).height; }
  /// The mean of the height along the straight line between two places of the ground: what a piece
  /// of tread stands on. By samples unless a road knows it in closed form.
  virtual double mean_height(const Eigen::Vector2d& from,
                             const Eigen::Vector2d& to,
                             double time) const;
  /// Empty where the road is known at that place; else what ends there, in words: beyond its data
  /// `at` is a guess that no car should roll on unasked (models/car/car.h).
  virtual std::string beyond(double x, double y) const;
  /// All of a row at once, as `at`, `height` and `mean_height` have it up to rounding.
  virtual void below(const GroundRow& row, double time, const RowGround& ground) const;
  /// For tires that ask thousands of points a step. Nothing is promised unless a road overrides it.
  virtual GroundBounds bounds(const GroundBox&, double) const { return {}; }
};

}  // namespace latsch::road
