// SPDX-License-Identifier: Apache-2.0
// Forces and moments on the bodies of a car (car.h) with their derivatives: guide, driven axle,
// aerodynamics and wheels.
#include <array>
#include <cmath>

#include "models/car/car.h"
#include "models/car/wheel_index.h"

namespace latsch::car {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using multibody::BodyForce;
using multibody::Motion;
using multibody::Pose;
using multibody::Vector6d;

namespace {

double critical(double stiffness, double inertia) { return 2.0 * std::sqrt(stiffness * inertia); }

}  // namespace

Vector3d Car::off_guide(const Pose& chassis, const GuidePoint& point) const {
  const Vector3d rest = mechanism_->bodies()[at(parts_.chassis)].origin;
  return {chassis.place.x() - rest.x() - point.x,
          chassis.place.y() - rest.y() - point.y - guide.y,
          std::atan2(chassis.turn(1, 0), chassis.turn(0, 0))};
}

void Car::add_guide(const Motion& motion,
                    const GuidePoint& point,
                    std::vector<BodyForce>& wrenches) const {
  Vector6d rate = Vector6d::Zero();
  if (motion.rates) rate = motion.rates->segment<6>(6 * parts_.chassis);
  const Vector3d off = off_guide(motion.poses[at(parts_.chassis)], point);
  const double mass = mechanism_->mass(), yaw_inertia = parameters_.chassis.body.inertia(2, 2);
  BodyForce wrench{.body = parts_.chassis};
  const auto hold = [&](int axis, double k, double inertia, double from, double rate_from) {
    const double c = motion.rates ? critical(k, inertia) : 0.0;
    if (!motion.rates) k *= kStill;
    wrench.value[axis] = -k * from - c * rate_from;
    wrench.slopes(axis, axis) = -k - motion.share * c;
  };
  hold(0, guide.along, mass, off.x(), rate[0] - point.speed);
  hold(1, guide.lateral, mass, off.y(), rate[1]);
  hold(5, guide.yaw, yaw_inertia, off.z(), rate[5]);
  wrenches.push_back(wrench);
}

void Car::add_guide(const Motion& motion,
                    const GuidePoint& point,
                    const Trim& trim,
                    std::vector<BodyForce>& wrenches) const {
  const std::size_t first = wrenches.size();
  add_guide(motion, point, wrenches);
  BodyForce& chassis = wrenches[first];
  // If the guide has no stiffness in a direction, its initial force in that direction is zero, too.
  if (guide.lateral > 0.0) chassis.value[1] += trim.lateral;
  if (guide.yaw > 0.0) chassis.value[5] += trim.yaw;
  const double pull = chassis.value[0] + trim.along;
  chassis.value[0] = chassis.slopes(0, 0) = 0.0;
  if (guide.along > 0.0) add_pull(motion, pull, trim, wrenches);
}

void Car::add_pull(const Motion& motion,
                   double pull,
                   const Trim& trim,
                   std::vector<BodyForce>& wrenches) const {
  for (int corner = 0; corner < kCorners; ++corner) {
    const double share = 0.5 * guide.drives[is_front(corner) ? 0 : 1];
    if (share == 0.0) continue;
    const Vector3d force(share * pull, 0.0, 0.0);
    const int upright = parts_.corners[at(corner)].upright;
    const Vector3d arm = motion.poses[at(upright)].turn * wheel_center_in_upright(corner);
    BodyForce wheel{.body = upright};
    wheel.value << force, arm.cross(force);
    wheel.slopes.bottomRightCorner<3, 3>() = multibody::cross(force) * multibody::cross(arm);
    wrenches.push_back(wheel);
    const int chassis = is_front(corner) ? parts_.chassis : parts_.chassis_rear;
    const Vector3d across = motion.poses[at(chassis)].turn.col(1);
    const double torque = share * pull * trim.arm[at(corner)];
    BodyForce reaction{.body = chassis};
    reaction.value.tail<3>() = -torque * across;
    reaction.slopes.bottomRightCorner<3, 3>() = torque * multibody::cross(across);
    wrenches.push_back(reaction);
  }
}

std::optional<std::array<double, 2>> Car::floor_heights(const CarState& state) const {
  if (!parameters_.aero) return std::nullopt;
  const AeroMap& air = *parameters_.aero;
  const auto height = [&](const Axle& axle, double floor) {
    return point(state, parts_.chassis, {axle.corner.wheel_center.x(), 0.0, floor}).z();
  };
  return std::array{height(parameters_.front, air.floor_front),
                    height(parameters_.rear, air.floor_rear)};
}

void Car::add_air(const Motion& motion, double speed, std::vector<BodyForce>& wrenches) const {
  if (!parameters_.aero) return;
  const AeroMap& air = *parameters_.aero;
  const Pose& pose = motion.poses[at(parts_.chassis)];
  const Vector3d rest = mechanism_->bodies()[at(parts_.chassis)].origin;
  const auto arm = [&](double x, double z) -> Vector3d {
    return pose.turn * (Vector3d(x, 0.0, z) - rest);
  };
  const std::array<Vector3d, 2> arms = {
      arm(parameters_.front.corner.wheel_center.x(), air.floor_front),
      arm(parameters_.rear.corner.wheel_center.x(), air.floor_rear)};
  // Change of a ride height per displacement and rotation of the chassis; wrench of a vertical
  // force there.
  std::array<Vector6d, 2> by_height;
  for (std::size_t i = 0; i < 2; ++i)
    by_height[i] << Vector3d::UnitZ(), arms[i].cross(Vector3d::UnitZ());
  const auto c = air.at(pose.place.z() + arms[0].z(), pose.place.z() + arms[1].z());
  const double q = 0.5 * air.density * speed * speed * air.area;
  BodyForce wrench{.body = parts_.chassis};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Vector3d force(0.0, 0.0, -q * c.downforce[row]);
    wrench.value += -q * c.downforce[row] * by_height[i];
    for (std::size_t j = 0; j < 2; ++j)
      wrench.slopes -= q * c.by_height(row, static_cast<Eigen::Index>(j)) * by_height[i] *
                       by_height[j].transpose();
    wrench.slopes.bottomRightCorner<3, 3>() += multibody::cross(force) * multibody::cross(arms[i]);
  }
  const Vector3d drag(-q * air.drag, 0.0, 0.0), at_drag = arm(rest.x(), air.drag_height);
  wrench.value.head<3>() += drag;
  wrench.value.tail<3>() += at_drag.cross(drag);
  wrench.slopes.bottomRightCorner<3, 3>() += multibody::cross(drag) * multibody::cross(at_drag);
  if (speed != 0.0) wrench.slopes.col(0) += motion.share * (2.0 / speed) * wrench.value;
  wrenches.push_back(wrench);
}

void Car::add_wheels(const CarState& state,
                     const std::array<HubForces, kCorners>& before,
                     double share,
                     const Motion& motion,
                     const CarInputs& inputs,
                     const GuidePoint& guide,
                     std::vector<BodyForce>& wrenches) const {
  double driven = 0.0;
  for (int corner = 0; corner < kCorners; ++corner) {
    const CornerParts& parts = parts_.corners[at(corner)];
    const WheelState& wheel = state.wheels[at(corner)];
    const HubForces& last = before[at(corner)];
    const Pose& upright = motion.poses[at(parts.upright)];
    const Matrix3d carrier = upright.turn * parts.wheel_axes;
    const Vector3d axis = carrier.col(1),
                   force = carrier * (share * wheel.hub.force + (1.0 - share) * last.force),
                   moment = share * wheel.hub.moment + (1.0 - share) * last.moment;
    const Vector3d w = motion.rates ? motion.rates->segment<3>(6 * parts.upright + 3).eval()
                                    : Vector3d::Zero().eval();
    const double momentum = masses(corner).wheel_spin * wheel.wheel.spin->rate;
    const Vector3d arm = upright.turn * wheel_center_in_upright(corner);
    BodyForce wrench{.body = parts.upright};
    wrench.value << force, arm.cross(force) + carrier * Vector3d(moment.x(), 0.0, moment.z()) -
                               momentum * w.cross(axis) - wheel.brake_moment * axis;
    wrench.slopes.bottomRightCorner<3, 3>() = motion.share * momentum * multibody::cross(axis);
    wrenches.push_back(wrench);
    driven += inputs.drive[at(corner)];
  }
  add_guide(motion, guide, state.trim, wrenches);
  if (motion.rates) add_air(motion, (*motion.rates)[6 * parts_.chassis], wrenches);
  if (driven != 0.0) {
    BodyForce reaction{.body = parts_.chassis_rear};
    reaction.value.tail<3>() = -driven * motion.poses[at(parts_.chassis_rear)].turn.col(1);
    wrenches.push_back(reaction);
  }
}

}  // namespace latsch::car
