// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/linkage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/suspension/plausible_points.h"

namespace latsch::suspension {
namespace {

using Eigen::Vector3d;

// Convergence tolerance, m: the rounding of coordinates of about a meter.
constexpr double kConverged = 1e-13;
// Residual, m, that is accepted if rounding prevents a smaller one.
constexpr double kSolved = 1e-10;
constexpr int kIterations = 12;
// Longest step of travel and rack, m, in which the links turn little.
constexpr double kLongStep = 0.05;
// Shortest step, m. If steps become shorter, the linkage is at the end of its range.
constexpr double kShortStep = 1e-7;
// Largest rotation of the upright in a step, rad; beyond it the other assembly of the linkage may
// be reached.
constexpr double kFarTurn = 0.35;
// Smallest pivot of the equations that counts as regular; lengths are relative to the longest arm.
constexpr double kSingular = 1e-5;

}  // namespace

Vector3d Wheel::down(const Vector3d& axis) const {
  const Vector3d in_plane = Vector3d(0.0, 0.0, -1.0) + axis.z() * axis;
  return radius / in_plane.norm() * in_plane + offset * axis;
}

std::string Linkage::fault() const {
  for (const Link& link : links)
    for (const auto& [point, end] : {std::pair{&link.inner, "inner"}, {&link.outer, "outer"}})
      if (!(point->lpNorm<Eigen::Infinity>() < kFar))
        return fmt::format(
            "the {} end of {} is more than {} m from the origin: are its numbers "
            "millimeters?",
            end,
            link.name,
            kFar);
  for (const Link& link : links)
    if ((link.outer - link.inner).norm() < kNear)
      return fmt::format("both ends of {} coincide", link.name);
  if (!(wheel.radius > kNear)) return "contact is not below wheel_center: the tire has no radius";
  double arm = kNear;
  for (const Link& link : links) arm = std::max(arm, (link.outer - wheel.center).norm());
  Matrix6d J = Matrix6d::Zero();
  for (int i = 0; i < kLinks; ++i) {
    const Link& link = links[static_cast<std::size_t>(i)];
    const Vector3d n = (link.outer - link.inner).normalized();
    J.row(i) << n.transpose(), (link.outer - wheel.center).cross(n).transpose() / arm;
  }
  J(5, 2) = 1.0;
  const Eigen::FullPivLU<Matrix6d> factors(J);
  if (factors.matrixLU().diagonal().cwiseAbs().minCoeff() > kSingular) return {};
  // Forces of the links that balance each other on the unloaded upright. They exist if the
  // equations are singular.
  const Vector6d forces =
      Eigen::FullPivLU<Matrix6d>(J.transpose()).setThreshold(kSingular).kernel().col(0);
  std::string names;
  for (int i = 0; i < kLinks; ++i)
    if (std::abs(forces[i]) > 0.1 * forces.cwiseAbs().maxCoeff())
      names += (names.empty() ? "" : ", ") + links[static_cast<std::size_t>(i)].name;
  return fmt::format(
      "the upright can move although its links and its travel are held: {} do the "
      "same (a singular geometry)",
      names);
}

MovingLinkage::MovingLinkage(const Linkage& linkage, TravelOf of) : linkage_(&linkage), of_(of) {
  pose_.place = linkage.wheel.center;
  for (std::size_t i = 0; i < outer_.size(); ++i) {
    const Link& link = linkage.links[i];
    outer_[i] = link.outer - linkage.wheel.center;
    length_[i] = (link.outer - link.inner).norm();
  }
  height_ = pose_.place.z() + (of_ == TravelOf::contact ? to_contact().z() : 0.0);
  factors_.compute(equations(pose_, 0.0, 0.0).jacobian);
  orientation_ = factors_.determinant() > 0.0 ? 1.0 : -1.0;
  take(pose_, 0.0, 0.0, 0.0);
}

Vector3d MovingLinkage::inner(int link) const {
  const Vector3d at_rest = linkage_->links[static_cast<std::size_t>(link)].inner;
  if (link != linkage_->trackrod) return at_rest;
  return at_rest + Vector3d(0.0, rack_, 0.0);
}

Vector3d MovingLinkage::outer(int link) const {
  return pose_.at(outer_[static_cast<std::size_t>(link)]);
}

MovingLinkage::Equations MovingLinkage::equations(const Pose& pose,
                                                  double travel,
                                                  double rack) const {
  Equations e;
  for (int i = 0; i < Linkage::kLinks; ++i) {
    const auto k = static_cast<std::size_t>(i);
    Vector3d inner = linkage_->links[k].inner;
    if (i == linkage_->trackrod) inner.y() += rack;
    const Vector3d arm = pose.turn * outer_[k], d = pose.place + arm - inner;
    const double distance = d.norm();
    const Vector3d n = d / distance;
    e.residual[i] = distance - length_[k];
    e.jacobian.row(i) << n.transpose(), arm.cross(n).transpose();
  }
  Vector3d arm = Vector3d::Zero();
  if (of_ == TravelOf::contact) arm = linkage_->wheel.down(pose.turn * linkage_->wheel.spin_axis);
  e.residual[5] = pose.place.z() + arm.z() - height_ - travel;
  e.jacobian.row(5) << 0.0, 0.0, 1.0, arm.y(), -arm.x(), 0.0;
  return e;
}

void MovingLinkage::take(const Pose& pose, double travel, double rack, double left) {
  pose_ = pose;
  travel_ = travel;
  rack_ = rack;
  left_ = left;
  twists_.by_travel = factors_.solve(Vector6d::Unit(5));
  // The rack moves the inner end of the track-rod. This would shorten the link by n_y dr, so the
  // upright moves to keep its length.
  const Vector3d n = (outer(linkage_->trackrod) - inner(linkage_->trackrod)).normalized();
  Vector6d by_rack = Vector6d::Zero();
  by_rack[linkage_->trackrod] = n.y();
  twists_.by_rack = factors_.solve(by_rack);
}

bool MovingLinkage::try_step(double travel, double rack) {
  Pose pose = pose_;
  const Vector6d predicted =
      (travel - travel_) * twists_.by_travel + (rack - rack_) * twists_.by_rack;
  if (!(predicted.tail<3>().norm() < kFarTurn)) return false;
  pose.move(predicted);
  double before = 1e300;
  Eigen::PartialPivLU<Matrix6d> factors;
  for (int i = 0; i < kIterations; ++i) {
    const Equations e = equations(pose, travel, rack);
    const double left = e.residual.lpNorm<Eigen::Infinity>();
    factors.compute(e.jacobian);
    const bool at_rounding = left < kSolved && left > 0.1 * before;
    if (left < kConverged || at_rounding) {
      if (factors.determinant() * orientation_ <= 0.0) return false;
      if ((pose.turn - pose_.turn).norm() > kFarTurn) return false;
      factors_ = factors;
      take(pose, travel, rack, left);
      return true;
    }
    before = left;
    const Vector6d correction = factors.solve(-e.residual);
    if (!(correction.tail<3>().norm() < kFarTurn)) return false;  // written so that NaN fails, too
    pose.move(correction);
  }
  return false;
}

Result<Pose> MovingLinkage::move_to(double travel, double rack) {
  const double way = std::max(std::abs(travel - travel_), std::abs(rack - rack_));
  double step = std::min(1.0, kLongStep / std::max(way, kShortStep));
  const double from_travel = travel_, from_rack = rack_;
  double done = 0.0;
  while (done < 1.0) {
    const double to = done + step >= 1.0 - 1e-9 ? 1.0 : done + step;
    const bool ends = to == 1.0;
    if (try_step(ends ? travel : from_travel + to * (travel - from_travel),
                 ends ? rack : from_rack + to * (rack - from_rack))) {
      done = to;
      continue;
    }
    step *= 0.5;
    if (step * way < kShortStep) return Failure{end_of_way(travel, rack)};
  }
  return pose_;
}

std::string MovingLinkage::end_of_way(double travel, double rack) const {
  // Near a singularity of the equations the links balance each other with very large forces.
  const Vector6d forces = factors_.transpose().solve(Vector6d::Unit(5));
  int most = 0;
  forces.head<Linkage::kLinks>().cwiseAbs().maxCoeff(&most);
  return fmt::format(
      "travel {:.4g} mm with the rack at {:.4g} mm cannot be reached: {} ends the path at {:.4g} "
      "mm with the rack at {:.4g} mm, where the linkage is stretched "
      "or over its dead center",
      1e3 * travel,
      1e3 * rack,
      linkage_->links[static_cast<std::size_t>(most)].name,
      1e3 * travel_,
      1e3 * rack_);
}

}  // namespace latsch::suspension
