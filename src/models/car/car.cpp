// SPDX-License-Identifier: Apache-2.0
#include "models/car/car.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "models/car/wheel_index.h"
#include "models/road/plane_road.h"

namespace latsch::car {

using Eigen::Vector3d;
using multibody::Motion;
using multibody::Pose;
using multibody::Poses;
using multibody::Vector6d;

WheelState::WheelState(const WheelState& other)
    : tire(other.tire ? other.tire->clone() : nullptr),
      wheel(other.wheel),
      motion(other.motion),
      hub(other.hub),
      brake_moment(other.brake_moment) {}

WheelState& WheelState::operator=(const WheelState& other) {
  if (this != &other) *this = WheelState(other);
  return *this;
}

bool CarState::operator==(const CarState& other) const {
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const WheelState &a = wheels[i], &b = other.wheels[i];
    if (!(a.motion == b.motion && a.hub.force == b.hub.force && a.hub.moment == b.hub.moment))
      return false;
    const auto same = [](const FreeRate& x, const FreeRate& y) {
      return x.place == y.place && x.rate == y.rate && x.acceleration == y.acceleration;
    };
    if (a.wheel.spin && b.wheel.spin && !same(*a.wheel.spin, *b.wheel.spin)) return false;
  }
  return bodies == other.bodies && speed == other.speed && rack == other.rack && trim == other.trim;
}

Car::Car(const CarParameters& parameters, const multibody::TransientSettings& settings)
    : parameters_(parameters), settings_(settings) {
  assert(parameters.fault().empty());
  CarMechanism built = build(parameters);
  parts_ = built.parts;
  mechanism_ = std::make_unique<multibody::Mechanism>(std::move(built.mechanism));
  statics_ = std::make_unique<multibody::Equilibrium>(*mechanism_);
  transient_ = std::make_unique<multibody::Transient>(*mechanism_, settings_);
}

void Car::rebuild(std::vector<multibody::Strut> struts) {
  auto next = std::make_unique<multibody::Mechanism>(mechanism_->bodies(),
                                                     mechanism_->joints(),
                                                     std::move(struts),
                                                     kDrivers,
                                                     mechanism_->gravity());
  statics_ = std::make_unique<multibody::Equilibrium>(*next);
  transient_ = std::make_unique<multibody::Transient>(*next, settings_);
  mechanism_ = std::move(next);
}

std::optional<Car::Misfit> Car::misfit(const CarParts& parts, const Tires& tires) {
  // Largest difference between wheel-center height and tire radius, as a share of the radius.
  constexpr double kFar = 0.25;
  for (int corner = 0; corner < kCorners; ++corner) {
    const double radius = tires[at(corner)]->free_radius(),
                 z = parts.corners[at(corner)].wheel_center.z();
    if (std::abs(z - radius) < kFar * radius) continue;
    return Misfit{
        corner,
        fmt::format("the tire {} has a radius of {:.4g} mm, but its wheel center is drawn "
                    "{:.4g} mm above the ground",
                    kCornerNames[at(corner)],
                    1e3 * radius,
                    1e3 * z)};
  }
  return std::nullopt;
}

Result<std::unique_ptr<Car>> Car::make(const CarParameters& parameters,
                                       const Tires& tires,
                                       const CarInputs& at_rest,
                                       const multibody::TransientSettings& settings) {
  std::unique_ptr<Car> car(new Car(parameters, settings));
  for (std::size_t i = 0; i < tires.size(); ++i) car->tires_[i] = tires[i]->clone();
  if (const auto wrong = misfit(car->parts_, tires)) return Failure{wrong->why};
  const std::vector<multibody::Strut> struts = car->mechanism_->struts();
  if (struts.empty()) return car;
  // Stiff bars in place of the springs keep the car in its drawn position. The forces in these bars
  // are the preloads that the springs need.
  constexpr double kBar = 1e9;  // N/m
  std::vector<multibody::Strut> bars = struts;
  for (int corner = 0; corner < kCorners; ++corner)
    if (const int unit = car->parts_.corners[at(corner)].unit; unit >= 0)
      bars[at(unit)].stiffness = kBar;
  car->rebuild(bars);
  const road::PlaneRoad flat{road::PlaneRoad::Settings{}};
  const auto standing = car->settle(flat, 0.0, at_rest);
  if (!standing)
    return Failure{fmt::format("the car does not stand under its weight of {:.4g} N: {}",
                               car->mechanism_->mass() * parameters.gravity,
                               standing.failure().reason)};
  std::vector<multibody::Strut> springs = struts;
  const Motion motion{.poses = standing->bodies.poses, .memories = &standing->bodies.memories};
  for (int corner = 0; corner < kCorners; ++corner)
    if (const int unit = car->parts_.corners[at(corner)].unit; unit >= 0)
      springs[at(unit)].preload = car->transient_->assembly().strut_force(unit, motion);
  for (int corner = 0; corner < kCorners; ++corner)
    if (const Status fit = car->check_spring(corner, springs); !fit) return fit.failure();
  car->rebuild(springs);
  return car;
}

Status Car::check_spring(int corner, const std::vector<multibody::Strut>& springs) const {
  const int unit = parts_.corners[at(corner)].unit;
  if (unit < 0) return {};
  // N/m at rest: the spring unit and the springs that act on both sides of the axle
  double stiffness = 0.0;
  for (const multibody::Strut& strut : springs) {
    if (&strut != &springs[at(unit)] && strut.lines[0].b != springs[at(unit)].lines[0].b &&
        (strut.lines.size() < 2 || strut.lines[1].b != springs[at(unit)].lines[0].b))
      continue;
    stiffness += strut.stiffness;
    for (const multibody::ForcePart& part : strut.parts)
      if (const auto* curve = std::get_if<multibody::ElasticCurve>(&part))
        stiffness += curve->curve.slope(0.0);
  }
  // Largest plausible compression of a spring, as a multiple of its length.
  constexpr double kMost = 10.0;
  const double length = mechanism_->rest_length(unit), force = std::abs(springs[at(unit)].preload);
  if (stiffness * kMost * length > force) return {};
  return Failure{fmt::format(
      "{} carries {:.4g} N at rest with a stiffness of {:.4g} N/m: it would be pressed by more "
      "than ten times its length of {:.4g} mm",
      springs[at(unit)].name,
      force,
      stiffness,
      1e3 * length)};
}

const AxleMasses& Car::masses(int corner) const {
  return is_front(corner) ? parameters_.front.masses : parameters_.rear.masses;
}

Vector3d Car::wheel_center_in_upright(int corner) const {
  const CornerParts& parts = parts_.corners[at(corner)];
  return parts.wheel_center - mechanism_->bodies()[at(parts.upright)].origin;
}

WheelMotion Car::motion_of_wheel(int corner,
                                 const Poses& poses,
                                 const Eigen::VectorXd* rates) const {
  const CornerParts& parts = parts_.corners[at(corner)];
  const Pose& upright = poses[at(parts.upright)];
  const Vector3d arm = upright.turn * wheel_center_in_upright(corner);
  WheelMotion motion;
  motion.center = upright.place + arm;
  motion.carrier = upright.turn * parts.wheel_axes;
  if (rates) {
    motion.angular_velocity = rates->segment<3>(6 * parts.upright + 3);
    motion.velocity = rates->segment<3>(6 * parts.upright) + motion.angular_velocity.cross(arm);
  }
  return motion;
}

std::array<double, kCorners> Car::pushrod_forces(const CarState& state,
                                                 const CarInputs& inputs) const {
  const std::array<double, kDrivers> drivers = {inputs.rack};
  const Motion motion = transient_->motion_of(state.bodies, drivers);
  std::array<double, kCorners> forces;
  for (int corner = 0; corner < kCorners; ++corner) {
    const CornerParts& parts = parts_.corners[at(corner)];
    const Vector3d along = state.bodies.poses[at(parts.pushrod)].turn *
                           (parts.pushrod_outer - parts.pushrod_inner).normalized();
    // The load acts on the push-rod at its inner end: a push along the rod compresses it.
    const Vector6d load = transient_->assembly().joint_load(parts.pushrod_joint, motion);
    forces[at(corner)] = along.dot(load.head<3>());
  }
  return forces;
}

Motion Car::motion_of(const CarState& state) const {
  return transient_->motion_of(state.bodies, {&state.rack, kDrivers});
}

double Car::spring_extension(const CarState& state, int corner) const {
  const int unit = parts_.corners[at(corner)].unit;
  return unit < 0 ? 0.0 : transient_->assembly().extension(unit, state.bodies.poses);
}

std::array<double, kCorners> Car::vertical_forces(const CarState& state) const {
  std::array<double, kCorners> forces;
  for (std::size_t i = 0; i < kCorners; ++i)
    forces[i] = (state.wheels[i].motion.carrier * state.wheels[i].hub.force).z();
  return forces;
}

Vector3d Car::point(const CarState& state, int body, const Vector3d& at_rest) const {
  return state.bodies.poses[at(body)].at(at_rest - mechanism_->bodies()[at(body)].origin);
}

}  // namespace latsch::car
