// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/grip/rolling_surface.h"

#include <Eigen/Geometry>
#include <cmath>

namespace latsch::fe_tire {

RollingSurface::RollingSurface(double curvature, const Eigen::Vector2d& along)
    : curvature_(curvature) {
  heading_.col(0) = along;
  heading_.col(1) << -along.y(), along.x();
}

RollingSurface::Place RollingSurface::place(const Eigen::Vector3d& q) const {
  Place place = is_flat() ? Place{q, Eigen::Matrix3d::Identity()} : on_drum(q);
  if (ground_ != nullptr) add_ground(place);
  return place;
}

void RollingSurface::set_ground(const FeltGround& ground, const WheelPlace& wheel) {
  ground_ = &ground;
  way_ = wheel.way;
  to_ground_ = Eigen::Rotation2Dd(wheel.heading).toRotationMatrix();
}

/// Changes a place over the smooth surface to one over the ground that raises it.
void RollingSurface::add_ground(Place& place) const {
  const FeltGround::Place ground = ground_->at(way_ + to_ground_ * place.x.head<2>());
  place.x.head<2>() += to_ground_.transpose() * ground.longer;
  place.x.z() -= ground.height;
  const double slope = ground.slope.norm();
  if (slope == 0.0) return;
  const Eigen::Vector2d up = to_ground_.transpose() * (ground.slope / slope);
  const double cosine = 1.0 / std::hypot(1.0, slope), sine = slope * cosine;
  place.x.z() *= cosine;
  Eigen::Matrix3d tilt;  // rows: axes up the slope and beside it, and its normal
  tilt.row(0) << cosine * up.transpose(), sine;
  tilt.row(1) << -up.y(), up.x(), 0.0;
  tilt.row(2) << -sine * up.transpose(), cosine;
  Eigen::Matrix3d turn = tilt;
  turn.topRows<2>() = up * tilt.row(0) + Eigen::Vector2d(-up.y(), up.x()) * tilt.row(1);
  place.turn = turn * place.turn;
}

RollingSurface::Place RollingSurface::on_drum(const Eigen::Vector3d& q) const {
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
  Eigen::Vector2d at = x;
  double height = 0.0;
  if (ground_ != nullptr) {
    const Eigen::Vector2d p = ground_->at_arc(way_ + to_ground_ * x);
    at = to_ground_.transpose() * (p - way_);
    height = ground_->at(p).height;
  }
  if (is_flat()) return {at.x(), at.y(), height};
  const Eigen::Vector2d out = heading_.transpose() * at;
  const double radius = 1.0 / curvature_, angle = out.x() * curvature_, to_axis = radius + height;
  Eigen::Vector3d point;
  point << heading_ * Eigen::Vector2d(to_axis * std::sin(angle), out.y()),
      to_axis * std::cos(angle) - radius;
  return point;
}

}  // namespace latsch::fe_tire
