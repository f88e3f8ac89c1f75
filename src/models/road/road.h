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
  double height = 0.0;                                 // m
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   // unit, upward
  double friction = 1.0;                               // factor on the tire's own friction
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, of the ground's material
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();   // rad/s, of the ground: higher points move
                                                       // faster
};

/// A row of successive pieces, as of tread: the positions of their middles and of the count + 1
/// borders before, between and behind them, m.
struct GroundRow {
  int count;                                  // number of pieces
  const double *x, *y, *border_x, *border_y;  // m; count middles, and count + 1 borders
};

/// The ground below a row, at each piece and each border.
struct RowGround {
  double* border_height;  // m
  double* height;         // m, in the middle
  /// Mean from border to border, m; if the ground is practically straight, the middle's height.
  double* mean;
  double* slope[2];     // dz/dx, dz/dy in the middle
  double* friction;     // factor, in the middle
  double* velocity[3];  // m/s of the ground's material, in the middle
};

/// A rectangle of the ground, m.
struct GroundBox {
  double x0, x1, y0, y1;  // m: x0 <= x <= x1, y0 <= y <= y1
};

/// A smooth drum: a cylinder that turns about its axis, which is parallel to y.
struct Cylinder {
  double x, z;      // m, axis
  double radius;    // m
  double up;        // 1 if the ground lies below the axis, inside the drum; else -1
  double rate;      // rad/s, about y
  double friction;  // factor
};

/// Properties of a road that hold in a whole rectangle.
struct GroundBounds {
  double highest = std::numeric_limits<double>::infinity();  // m: upper bound of the height
  bool plane = false;  // the rectangle is the plane, with the friction, that `at` finds in its
                       // middle
  std::optional<Cylinder> cylinder = std::nullopt;  // the rectangle is this drum
  /// True if a line in the rectangle may be a plane although the whole rectangle is none.
  bool lines_differ = true;
};

/// True if heights at two points and between them are practically on one straight line.
inline bool is_straight(double from, double middle, double to) {
  constexpr double kStraight = 1e-6;  // m
  return std::abs(from + to - 2.0 * middle) <= kStraight;
}

class Road {
 public:
  virtual ~Road() = default;

  /// Returns the ground at x, y in m and `time` in s. It is defined for every finite x, y: a road
  /// continues beyond its data in a way documented by its class. The functions are const and
  /// without locks, so many threads may use one road.
  virtual GroundPoint at(double x, double y, double time) const = 0;
  /// Returns only the height, m, with the same bits as `at`. Enveloping and contact search call
  /// this most often.
  virtual double height(double x, double y, double time) const { return at(x, y, time).height; }
  /// Returns the mean height along the straight line between two points of the ground, on which a
  /// piece of tread stands. It is sampled unless a road has a closed form.
  virtual double mean_height(const Eigen::Vector2d& from,
                             const Eigen::Vector2d& to,
                             double time) const;
  /// Returns an empty text if the road is known at that point; otherwise the reason, such as the
  /// end of a grid. Beyond its data `at` is a guess on which no car should roll without permission
  /// (models/car/car.h).
  virtual std::string beyond(double x, double y) const;
  /// Evaluates a whole row at once; equals `at`, `height` and `mean_height` up to rounding.
  virtual void below(const GroundRow& row, double time, const RowGround& ground) const;
  /// Returns bounds for tires that evaluate thousands of points a step. Without an override there
  /// are no bounds.
  virtual GroundBounds bounds(const GroundBox&, double) const { return {}; }
};

}  // namespace latsch::road
