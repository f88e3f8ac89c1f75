// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/grip/rolling_surface.h"

#include <cmath>

namespace latsch::fe_tire {

RollingSurface::RollingSurface(double curvature, const Eigen::Vector2d& along)
    : curvature_(curvature) {
  heading_.col(0) = along;
  heading_.col(1) << -along.y(), along.x();
}

RollingSurface::Place RollingSurface::place(const Eigen::Vector3d& q) const {
  Place place = is_flat() ? Place{q, Eigen::Matrix3d::Identity()} : on_drum(q);
  if (bar_ != nullptr) add_bar(place);
  return place;
}

/// Changes a place over the smooth surface to one over the bar.
void RollingSurface::add_bar(Place& place) const {
  const Eigen::Vector2d across = heading_ * bar_->direction();
  const double s = across.dot(place.x.head<2>() - bar_at_ * heading_.col(0));
  const PassingBar::Place bar = bar_->at(s);
  place.x.head<2>() += bar.longer * across;
  if (bar.height == 0.0 && bar.slope == 0.0) return;
  const double cosine = 1.0 / std::hypot(1.0, bar.slope), sine = bar.slope * cosine;
  place.x.z() = cosine * (place.x.z() - bar.height);
  Eigen::Matrix3d tilt;  // rows: axes along the slope and across it, and its normal
  tilt.row(0) << cosine * across.transpose(), sine;
  tilt.row(1) << -across.y(), across.x(), 0.0;
  tilt.row(2) << -sine * across.transpose(), cosine;
  Eigen::Matrix3d turn = tilt;
  turn.topRows<2>() = across * tilt.row(0) + Eigen::Vector2d(-across.y(), across.x()) * tilt.row(1);
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
  if (bar_ != nullptr) {
    const Eigen::Vector2d across = heading_ * bar_->direction();
    const double arc = across.dot(x - bar_at_ * heading_.col(0)), s = bar_->across(arc);
    at += (s - arc) * across;
    height = bar_->at(s).height;
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
