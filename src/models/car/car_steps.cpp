// SPDX-License-Identifier: Apache-2.0
// One step of a car in time (car.h): first the tires roll to the predicted positions of their
// wheels, then the mechanism takes its steps under the forces of the tires.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "models/car/car.h"
#include "models/car/wheel_index.h"

namespace latsch::car {

using Eigen::Vector3d;
using multibody::BodyForce;
using multibody::Motion;
using multibody::Pose;
using multibody::Vector6d;

namespace {

/// Extrapolates the motion of a wheel by `ahead` seconds with constant linear acceleration of its
/// center and constant angular acceleration.
void go_on(WheelMotion& motion, const Vector6d& acceleration, double ahead) {
  const Vector3d more = ahead * acceleration.head<3>();
  Pose carrier{motion.center, motion.carrier};
  Vector6d way;
  way << ahead * (motion.velocity + 0.5 * more),
      ahead * (motion.angular_velocity + 0.5 * ahead * acceleration.tail<3>());
  carrier.move(way);
  motion.center = carrier.place;
  motion.carrier = carrier.turn;
  motion.velocity += more;
  motion.angular_velocity += ahead * acceleration.tail<3>();
}

/// Moves the loads toward `to` by a share of their difference. If the two lists hold different
/// loads, replaces the loads by `to`.
void approach(std::vector<multibody::Load>& loads,
              const std::vector<multibody::Load>& to,
              double share) {
  const bool alike = std::equal(
      loads.begin(), loads.end(), to.begin(), to.end(), [](const auto& a, const auto& b) {
        return a.body == b.body && a.point == b.point;
      });
  if (!alike || share == 1.0) {
    loads = to;
    return;
  }
  for (std::size_t i = 0; i < loads.size(); ++i) {
    loads[i].force += share * (to[i].force - loads[i].force);
    loads[i].moment += share * (to[i].moment - loads[i].moment);
  }
}

}  // namespace

Vector6d Car::acceleration_of_wheel(int corner, const Motion& motion) const {
  const int upright = parts_.corners[at(corner)].upright;
  Vector6d acceleration = motion.accelerations->segment<6>(6 * upright);
  const Vector3d arm = motion.poses[at(upright)].turn * wheel_center_in_upright(corner);
  const Vector3d w = motion.rates->segment<3>(6 * upright + 3);
  acceleration.head<3>() += acceleration.tail<3>().cross(arm) + w.cross(w.cross(arm));
  return acceleration;
}

Status Car::check_on_road(int corner, const WheelMotion& wheel, const road::Road& road) const {
  if (may_leave_road) return {};
  const Vector3d contact = wheel.center - tires_[at(corner)]->free_radius() * wheel.carrier.col(2);
  const std::string beyond = road.beyond(contact.x(), contact.y());
  if (beyond.empty()) return {};
  return Failure{fmt::format(
      "tire {} is off the road's edge: {}. Drive on another line, start elsewhere or drive less "
      "far, extend the road, or allow it (beyond_edge of a test, road.continues of a unit)",
      kCornerNames[at(corner)],
      beyond)};
}

Status Car::roll(CarState& next,
                 const Motion& motion,
                 double ahead,
                 double step,
                 const road::Road& road,
                 const CarInputs& inputs) const {
  for (int corner = 0; corner < kCorners; ++corner) {
    WheelState& wheel = next.wheels[at(corner)];
    const double I = masses(corner).wheel_spin, drive = inputs.drive[at(corner)];
    WheelMotion there = motion_of_wheel(corner, motion.poses, motion.rates);
    if (ahead > 0.0) go_on(there, acceleration_of_wheel(corner, motion), ahead);
    if (Status on = check_on_road(corner, there, road); !on) return on;
    FreeWheel free = wheel.wheel;
    free.spin->push = [drive](double, double) { return Push{drive, 0.0}; };
    free.brake = inputs.brake[at(corner)];
    const auto hub = wheel.tire->advance_free(there, free, road, motion.time + ahead, step);
    if (!hub)
      return Failure{fmt::format("tire {}: {}", kCornerNames[at(corner)], hub.failure().reason)};
    free.spin->push = {};
    wheel.brake_moment =
        free.brake > 0.0 ? I * free.spin->acceleration - hub->moment.y() - drive : 0.0;
    wheel.wheel = std::move(free);
    wheel.motion = there;
    wheel.hub = *hub;
  }
  return {};
}

Status Car::advance(CarState& state, double step, const road::Road& road, const CarInputs& inputs) {
  std::array<HubForces, kCorners> before;
  for (std::size_t i = 0; i < before.size(); ++i) before[i] = state.wheels[i].hub;
  const double part = step / mechanism_steps, end = state.time() + step;
  Status rolled;
  for (int i = 1; i <= mechanism_steps; ++i) {
    // `share` is the part of the remaining change of the inputs that falls into this step, `left`
    // the time in s that remains after it.
    const double share = 1.0 / (mechanism_steps - i + 1), left = step - i * part;
    const double now = end - left;
    const GuidePoint guide = inputs.guide ? GuidePoint{inputs.guide->x - inputs.guide->speed * left,
                                                       inputs.guide->speed,
                                                       inputs.guide->y}
                                          : GuidePoint{state.speed * now, state.speed, 0.0};
    state.rack = share == 1.0 ? inputs.rack : state.rack + share * (inputs.rack - state.rack);
    approach(state.loads, inputs.loads, share);
    const std::array<double, kDrivers> drivers = {state.rack};
    const multibody::Outside outside = [&](const Motion& motion, std::vector<BodyForce>& wrenches) {
      if (i == 1) rolled = roll(state, motion, step - part, step, road, inputs);
      add_wheels(
          state, before, static_cast<double>(i) / mechanism_steps, motion, inputs, guide, wrenches);
    };
    const auto done = transient_->advance(
        state.bodies, part, {.loads = state.loads, .drivers = drivers, .outside = &outside});
    if (!rolled)
      return Failure{fmt::format("at {:.5f} s {}", state.time(), rolled.failure().reason)};
    if (!done) return done;
  }
  return {};
}

}  // namespace latsch::car
