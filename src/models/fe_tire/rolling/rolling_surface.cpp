// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_surface.h"

#include <cmath>

namespace latsch::fe_tire {

RollingSurface::RollingSurface(double curvature, const Eigen::Vector2d& along)
    : curvature_(curvature) {
  heading_.col(0) = along;
  heading_.col(1) << -along.y(), along.x();
}

RollingSurface::Place RollingSurface::place(const Eigen::Vector3d& q) const {
  if (is_flat()) return {q, Eigen::Matrix3d::Identity()};
  const Eigen::Vector2d across = heading_.transpose() * q.head<2>();
  const double radius = 1.0 / curvature_, up = q.z() + radius;
  const double arc = std::atan2(across.x(), up);
  Place place;
  place.x << heading_ * Eigen::Vector2d(radius * arc, across.y()),
      std::hypot(across.x(), up) - radius;
  Eigen::Matrix3d axes;  // columns: tangent, the drum's axis, normal
  axes.col(0) << std::cos(arc) * heading_.col(0), -std::sin(arc);
  axes.col(1) << heading_.col(1), 0.0;
  axes.col(2) << std::sin(arc) * heading_.col(0), std::cos(arc);
  place.turn << heading_ * axes.leftCols<2>().transpose(), axes.col(2).transpose();
  return place;
}

Eigen::Vector3d RollingSurface::point(const Eigen::Vector2d& x) const {
  Eigen::Vector3d at(x.x(), x.y(), 0.0);
  if (is_flat()) return at;
  const Eigen::Vector2d out = heading_.transpose() * x;
  const double radius = 1.0 / curvature_, arc = out.x() * curvature_;
  at << heading_ * Eigen::Vector2d(radius * std::sin(arc), out.y()), radius * (std::cos(arc) - 1.0);
  return at;
}

}  // namespace latsch::fe_tire
