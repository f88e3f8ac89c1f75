// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/contact/ground.h"

#include <Eigen/Geometry>
#include <cmath>

namespace latsch::fe_tire {

GroundPose between(const GroundPose& a, const GroundPose& b, double share) {
  const auto at = [share](double from, double to) { return from + share * (to - from); };
  return {
      at(a.height, b.height), at(a.x, b.x), at(a.y, b.y), at(a.camber, b.camber), at(a.yaw, b.yaw)};
}

PosedGround::PosedGround(const Ground& ground, const GroundPose& pose) : bar_(ground.bar) {
  const Eigen::Matrix3d yaw =
      Eigen::AngleAxisd(-pose.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  R_ = yaw * Eigen::AngleAxisd(pose.camber, Eigen::Vector3d::UnitX()).toRotationMatrix();
  shift_ = yaw * Eigen::Vector3d(-pose.x, -pose.y, pose.height);
  if (bar_) along_ = {std::cos(bar_->angle), std::sin(bar_->angle)};
}

PosedGround::Distance PosedGround::distance(const Eigen::Vector3d& q) const {
  if (!bar_) return {q.z(), Eigen::Vector3d::UnitZ()};
  const double s = along_.dot(q.head<2>()), inside = 0.5 * bar_->length - std::abs(s);
  if (inside <= 0.0) return {q.z(), Eigen::Vector3d::UnitZ()};
  if (inside >= bar_->bevel) return {q.z() - bar_->height, Eigen::Vector3d::UnitZ()};
  const double h = bar_->height - (bar_->bevel - inside), slope = s > 0.0 ? -1.0 : 1.0;
  const double cosine = 1.0 / std::sqrt(2.0);
  const Eigen::Vector2d down = -slope * cosine * along_;
  return {(q.z() - h) * cosine, Eigen::Vector3d(down.x(), down.y(), cosine)};
}

}  // namespace latsch::fe_tire
