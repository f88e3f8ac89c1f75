// SPDX-License-Identifier: Apache-2.0
#include "models/road/placed_road.h"

#include <Eigen/Geometry>
#include <cassert>
#include <initializer_list>
#include <utility>

namespace latsch::road {

PlacedRoad::PlacedRoad(std::shared_ptr<const Road> road,
                       double angle,
                       const Eigen::Vector3d& origin)
    : road_(std::move(road)), turn_(Eigen::Rotation2Dd(angle)), origin_(origin) {
  assert(road_);
}

Eigen::Vector2d PlacedRoad::local(double x, double y) const {
  return turn_.transpose() * (Eigen::Vector2d(x, y) - origin_.head<2>());
}

double PlacedRoad::height(double x, double y, double time) const {
  const Eigen::Vector2d p = local(x, y);
  return road_->height(p.x(), p.y(), time) + origin_.z();
}

GroundPoint PlacedRoad::at(double x, double y, double time) const {
  const Eigen::Vector2d p = local(x, y);
  GroundPoint ground = road_->at(p.x(), p.y(), time);
  ground.height += origin_.z();
  ground.normal.head<2>() = (turn_ * ground.normal.head<2>()).eval();
  ground.velocity.head<2>() = (turn_ * ground.velocity.head<2>()).eval();
  ground.turning.head<2>() = (turn_ * ground.turning.head<2>()).eval();
  return ground;
}

double PlacedRoad::mean_height(const Eigen::Vector2d& from,
                               const Eigen::Vector2d& to,
                               double time) const {
  return road_->mean_height(local(from.x(), from.y()), local(to.x(), to.y()), time) + origin_.z();
}

std::string PlacedRoad::beyond(double x, double y) const {
  const Eigen::Vector2d p = local(x, y);
  return road_->beyond(p.x(), p.y());
}

void PlacedRoad::below(const GroundRow& row, double time, const RowGround& ground) const {
  const auto n = static_cast<std::size_t>(row.count);
  std::vector<double> places(4 * n + 2);
  double *x = places.data(), *y = x + n, *border_x = y + n, *border_y = border_x + n + 1;
  const auto place = [&](std::size_t count,
                         const double* from_x,
                         const double* from_y,
                         double* to_x,
                         double* to_y) {
    for (std::size_t j = 0; j < count; ++j) {
      const Eigen::Vector2d p = local(from_x[j], from_y[j]);
      to_x[j] = p.x();
      to_y[j] = p.y();
    }
  };
  place(n, row.x, row.y, x, y);
  place(n + 1, row.border_x, row.border_y, border_x, border_y);
  road_->below({row.count, x, y, border_x, border_y}, time, ground);
  for (std::size_t j = 0; j <= n; ++j) ground.border_height[j] += origin_.z();
  const auto turn = [&](double* const v[2], std::size_t j) {
    const Eigen::Vector2d turned = turn_ * Eigen::Vector2d(v[0][j], v[1][j]);
    v[0][j] = turned.x();
    v[1][j] = turned.y();
  };
  for (std::size_t j = 0; j < n; ++j) {
    ground.height[j] += origin_.z();
    ground.mean[j] += origin_.z();
    turn(ground.slope, j);
    turn(ground.velocity, j);
  }
}

/// Returns bounds of the rectangle along the road's own axes that encloses the rotated box.
GroundBounds PlacedRoad::bounds(const GroundBox& box, double time) const {
  Eigen::Vector2d low = local(box.x0, box.y0), high = low;
  for (const auto& [x, y] : std::initializer_list<std::pair<double, double>>{
           {box.x1, box.y0}, {box.x0, box.y1}, {box.x1, box.y1}}) {
    const Eigen::Vector2d corner = local(x, y);
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  GroundBounds bounds = road_->bounds({low.x(), high.x(), low.y(), high.y()}, time);
  bounds.highest += origin_.z();
  bounds.cylinder.reset();  // the axis of a rotated drum may no longer be parallel to y
  return bounds;
}

}  // namespace latsch::road
