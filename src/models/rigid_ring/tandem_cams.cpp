// SPDX-License-Identifier: Apache-2.0
#include "models/rigid_ring/tandem_cams.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace latsch::rigid_ring {
namespace {

constexpr double kSpacing = 0.004;  // m, of the points of a cam: a cleat of 10 mm has two
constexpr int kMostTracks = 10;

}  // namespace

TandemCams::TandemCams(const magic_formula::Parameters& p)
    : shift_(p.ELLIPS_SHIFT),
      b_e_(p.ELLIPS_HEIGHT * p.UNLOADED_RADIUS),
      tracks_(std::clamp(static_cast<int>(p.ELLIPS_NWIDTH), 1, kMostTracks)) {
  const double a_e = p.ELLIPS_LENGTH * p.UNLOADED_RADIUS;
  // Beyond a half of its length a cam stands so high that no step a tire survives reaches it.
  const int points = std::max(1, static_cast<int>(std::ceil(0.5 * a_e / kSpacing)));
  for (int i = -points; i <= points; ++i) {
    const double x = 0.5 * a_e * i / points;
    const double inside = 1.0 - std::pow(std::abs(x) / a_e, p.ELLIPS_ORDER);
    x_.push_back(x);
    z_.push_back(b_e_ * (1.0 - std::pow(inside, 1.0 / p.ELLIPS_ORDER)));
  }
}

double TandemCams::lowest(
    double x, double y, const Eigen::Vector2d& heading, const road::Road& road, double time) const {
  double height = -INFINITY;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const double ground = road.height(x + x_[i] * heading.x(), y + x_[i] * heading.y(), time);
    height = std::max(height, ground - z_[i]);
  }
  return height + b_e_;
}

magic_formula::RoadPlane TandemCams::plane(const Eigen::Vector3d& center,
                                           const Eigen::Vector3d& forward,
                                           double a,
                                           double b,
                                           const road::Road& road,
                                           double time) const {
  const Eigen::Vector2d heading = forward.head<2>().normalized();
  const Eigen::Vector2d left(-heading.y(), heading.x());
  const double l_s = std::max(shift_ * 2.0 * a, kSpacing);
  double w = 0.0, slope = 0.0, moment = 0.0, squares = 0.0;
  for (int track = 0; track < tracks_; ++track) {
    const double across = tracks_ == 1 ? 0.0 : b * (2.0 * track / (tracks_ - 1) - 1.0);
    const Eigen::Vector2d at = center.head<2>() + across * left;
    const Eigen::Vector2d front = at + 0.5 * l_s * heading, rear = at - 0.5 * l_s * heading;
    const double Z_f = lowest(front.x(), front.y(), heading, road, time);
    const double Z_r = lowest(rear.x(), rear.y(), heading, road, time);
    const double height = 0.5 * (Z_f + Z_r) - b_e_;
    w += height / tracks_;
    slope += (Z_f - Z_r) / l_s / tracks_;
    moment += across * height;
    squares += across * across;
  }
  const double bank = squares > 0.0 ? moment / squares : 0.0;
  // On a plain slope a cam touches uphill and stands higher: not the road's doing.
  double lift = 0.0;
  for (std::size_t i = 0; i < x_.size(); ++i) lift = std::max(lift, slope * x_[i] - z_[i]);
  w -= lift;
  const road::GroundPoint ground = road.at(center.x(), center.y(), time);
  magic_formula::RoadPlane plane;
  plane.point = {center.x(), center.y(), w};
  plane.normal =
      Eigen::Vector3d(
          -slope * heading.x() - bank * left.x(), -slope * heading.y() - bank * left.y(), 1.0)
          .normalized();
  plane.velocity = ground.velocity;
  plane.friction = ground.friction;
  return plane;
}

}  // namespace latsch::rigid_ring
