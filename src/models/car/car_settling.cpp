// SPDX-License-Identifier: Apache-2.0
// How a car comes to rest on its tires, standing or rolling, before time begins.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "models/car/car.h"
#include "models/road/plane_road.h"

namespace latsch::car {

using Eigen::Vector3d;
using multibody::Motion;
using multibody::Pose;
using multibody::Rest;
using multibody::Vector6d;
using multibody::Wrench;

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

Result<Rest> Car::stand(const LineTires& tires,
                        double speed,
                        const CarInputs& inputs,
                        const Rest& from) {
  const multibody::Outside outside = [&](const Motion& motion, std::vector<Wrench>& wrenches) {
    for (int corner = 0; corner < kCorners; ++corner) {
      const CornerParts& parts = parts_.corners[at(corner)];
      const LineTire& tire = tires[at(corner)];
      const Pose& upright = motion.poses[at(parts.upright)];
      const Vector3d arm = upright.turn * wheel_center_in_upright(corner);
      const double z = upright.place.z() + arm.z();
      Vector3d force = tire.beside.head<3>();
      force.z() += tire.force + tire.stiffness * (tire.height - z);
      Wrench wrench{.body = parts.upright};
      wrench.value << force, arm.cross(force) + tire.beside.tail<3>();
      Vector6d by_z;  // of z by the upright's motion
      by_z << Vector3d::UnitZ(), arm.cross(Vector3d::UnitZ());
      wrench.slopes = -tire.stiffness * by_z * by_z.transpose();
      wrench.slopes.bottomRightCorner<3, 3>() += multibody::cross(force) * multibody::cross(arm);
      wrenches.push_back(wrench);
    }
    const GuidePoint start = inputs.guide.value_or(GuidePoint{0.0, 0.0, 0.0});
    add_guide(motion, {0.0, 0.0, start.y}, wrenches);
    add_air(motion, speed, wrenches);
  };
  const std::array<double, kDrivers> drivers = {inputs.rack};
  return statics_->solve({.loads = inputs.loads, .drivers = drivers, .outside = &outside}, from);
}

namespace {

/// The force of a tire where it stands, as a straight line over the height of its wheel.
template <class Line>
void take(Line& line, const WheelState& wheel) {
  const Vector3d force = wheel.motion.carrier * wheel.hub.force;
  line.force = force.z();
  line.height = wheel.motion.center.z();
  line.beside << force.x(), force.y(), 0.0,
      wheel.motion.carrier * Vector3d(wheel.hub.moment.x(), 0.0, wheel.hub.moment.z());
}

Eigen::VectorXd straight_on(std::size_t bodies, double speed) {
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(bodies));
  for (Eigen::Index k = 0; k < rates.size(); k += 6) rates[k] = speed;
  return rates;
}

/// How tires roll up to where the car starts, in rounds after each of which it stands anew.
struct RollIn {
  static constexpr int kRounds = 10;
  static constexpr int kHeld = 3;  // rounds before the car moves: until belts have grown
  double duration;                 // s, of a round: 0.3 m at least, as a tire needs to forget
  int steps;                       // of a round, 12 mm long

  explicit RollIn(double speed)
      : duration(std::max(0.03, 0.3 / speed)),
        steps(static_cast<int>(std::ceil(duration * speed / 0.012))) {}
};

Failure no_stand(int corner, const std::string& why) {
  return {fmt::format("the tire {} does not stand on the road: {}", kCornerNames[at(corner)], why)};
}

}  // namespace

Result<Rest> Car::settle_on_tires(CarState& state,
                                  LineTires& lines,
                                  const road::Road& road,
                                  const CarInputs& inputs) {
  constexpr int kMost = 40;
  constexpr double kEnough = 1e-5;  // of the car's weight, at each tire
  const double weight = mechanism_->mass() * parameters_.gravity;
  const Eigen::VectorXd rates = straight_on(mechanism_->bodies().size(), state.speed);
  Rest rest = statics_->unloaded();
  for (int corner = 0; corner < kCorners; ++corner) {
    const WheelMotion drawn = motion_of_wheel(corner, rest.poses, nullptr);
    if (std::string trouble = off_road(corner, drawn, road); !trouble.empty())
      return Failure{std::move(trouble)};
    const double ground = road.height(drawn.center.x(), drawn.center.y(), 0.0);
    lines[at(corner)] = {.stiffness = 2e5, .height = ground + tires_[at(corner)]->free_radius()};
  }
  double worst = 0.0;
  for (int i = 0; i < kMost; ++i) {
    auto stood = stand(lines, state.speed, inputs, rest);
    if (!stood) return stood;
    rest = std::move(*stood);
    worst = 0.0;
    for (int corner = 0; corner < kCorners; ++corner) {
      LineTire& line = lines[at(corner)];
      WheelState& wheel = state.wheels[at(corner)];
      wheel.motion = motion_of_wheel(corner, rest.poses, &rates);
      const double z = wheel.motion.center.z(), radius = tires_[at(corner)]->free_radius();
      // A tire rolls on a radius that is shorter by a third of its deflection.
      wheel.motion.spin_rate = state.speed / (radius - std::max(0.0, radius - z) / 3.0);
      wheel.tire = tires_[at(corner)]->clone();
      const auto hub = wheel.tire->settle(wheel.motion, road, 0.0);
      if (!hub) return no_stand(corner, hub.failure().reason);
      wheel.hub = *hub;
      const double force = (wheel.motion.carrier * hub->force).z();
      worst = std::max(worst, std::abs(line.force + line.stiffness * (line.height - z) - force));
      // The secant through the last place, where it is one of a tire.
      const double secant = (force - line.force) / (line.height - z);
      if (i > 0 && std::abs(z - line.height) > 1e-9 && secant > 0.1 * line.stiffness &&
          secant < 10.0 * line.stiffness)
        line.stiffness = secant;
      take(line, wheel);
    }
    if (i > 0 && worst < kEnough * weight) break;
  }
  if (worst < 1e-3 * weight) return rest;
  return Failure{fmt::format(
      "the car finds no rest on its tires: {:.3g} N are left of {:.4g} N", worst, weight)};
}

Result<Rest> Car::roll_in(CarState& state,
                          LineTires& lines,
                          const Rest& start,
                          const road::Road& road,
                          const CarInputs& inputs) {
  const RollIn way(state.speed);
  const double speed = state.speed, h = way.duration / way.steps;
  const Eigen::VectorXd rates = straight_on(mechanism_->bodies().size(), speed);
  Rest rest = start;
  for (int corner = 0; corner < kCorners; ++corner) {
    WheelState& wheel = state.wheels[at(corner)];
    const road::PlaneRoad level{
        {.height = road.height(wheel.motion.center.x(), wheel.motion.center.y(), 0.0)}};
    const double whole = way.duration * RollIn::kRounds;
    wheel.motion.center.x() -= speed * whole;
    wheel.tire = tires_[at(corner)]->clone();
    if (const auto hub = wheel.tire->settle(wheel.motion, level, -whole); !hub)
      return no_stand(corner, hub.failure().reason);
  }
  for (int round = 0; round < RollIn::kRounds; ++round) {
    if (round >= RollIn::kHeld) {
      auto stood = stand(lines, state.speed, inputs, rest);
      if (!stood) return stood;
      rest = std::move(*stood);
    }
    for (int corner = 0; corner < kCorners; ++corner) {
      WheelState& wheel = state.wheels[at(corner)];
      const WheelMotion end = motion_of_wheel(corner, rest.poses, &rates);
      const road::PlaneRoad level{{.height = road.height(end.center.x(), end.center.y(), 0.0)}};
      const Vector3d from = wheel.motion.center;
      HubForces mean;  // over the second half: what has no period left in it
      for (int i = 1; i <= way.steps; ++i) {
        const double left = way.duration * (RollIn::kRounds - 1 - round) + h * (way.steps - i);
        WheelMotion there = end;
        const double part = static_cast<double>(i) / way.steps;
        there.center.y() = from.y() + part * (end.center.y() - from.y());
        there.center.z() = from.z() + part * (end.center.z() - from.z());
        there.center.x() = end.center.x() - speed * left;
        there.spin = wheel.motion.spin + h * wheel.motion.spin_rate;
        there.spin_rate = wheel.motion.spin_rate;
        Result<HubForces> hub = wheel.tire->advance_free(there, wheel.wheel, level, -left, h);
        if (!hub) return no_stand(corner, hub.failure().reason);
        wheel.hub = *hub;
        wheel.motion = there;
        if (2 * i <= way.steps) continue;
        const double share = 1.0 / (way.steps - way.steps / 2);
        mean.force += share * hub->force;
        mean.moment += share * hub->moment;
      }
      std::swap(wheel.hub, mean);
      take(lines[at(corner)], wheel);
      std::swap(wheel.hub, mean);
    }
  }
  return rest;
}

Result<CarState> Car::settle(const road::Road& road, double speed, const CarInputs& inputs) {
  CarState state;
  state.speed = speed;
  LineTires lines;
  auto rest = settle_on_tires(state, lines, road, inputs);
  if (!rest) return rest.failure();
  for (int corner = 0; corner < kCorners; ++corner) {
    WheelState& wheel = state.wheels[at(corner)];
    wheel.wheel.spin = FreeRate{
        .inertia = masses(corner).wheel_spin, .place = 0.0, .rate = wheel.motion.spin_rate};
  }
  if (speed > 0.0) {
    rest = roll_in(state, lines, *rest, road, inputs);
    if (!rest) return rest.failure();
  }
  const GuidePoint start = inputs.guide.value_or(GuidePoint{0.0, speed, 0.0});
  state.rack = inputs.rack;
  state.loads = inputs.loads;
  const multibody::Outside outside = [&](const Motion& motion, std::vector<Wrench>& wrenches) {
    add_wheels(state, {}, 1.0, motion, inputs, start, wrenches);
  };
  const std::array<double, kDrivers> drivers = {inputs.rack};
  const Eigen::VectorXd rates = straight_on(mechanism_->bodies().size(), speed);
  auto bodies = transient_->start(
      *rest, {.loads = inputs.loads, .drivers = drivers, .outside = &outside}, 0.0, &rates);
  if (!bodies) return bodies.failure();
  state.bodies = std::move(*bodies);
  return state;
}

}  // namespace latsch::car
