// SPDX-License-Identifier: Apache-2.0
#include "models/car/car.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "models/road/plane_road.h"

namespace latsch::car {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using multibody::BodyForce;
using multibody::Motion;
using multibody::Pose;
using multibody::Poses;
using multibody::Vector6d;

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Moves the wheel on by `ahead` seconds, with these accelerations of its center and about it.
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

/// Changes the loads by a share of their difference from `to`, or replaces them by `to` if the two
/// lists have different loads.
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
  constexpr double kFar = 0.25;  // share of the radius
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
  // With bars in place of the springs the car stands as drawn, and the bar forces are those that
  // springs must carry.
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
  double stiffness = 0.0;  // at rest, of the unit and of springs on both sides of the axle
  for (const multibody::Strut& strut : springs) {
    if (&strut != &springs[at(unit)] && strut.lines[0].b != springs[at(unit)].lines[0].b &&
        (strut.lines.size() < 2 || strut.lines[1].b != springs[at(unit)].lines[0].b))
      continue;
    stiffness += strut.stiffness;
    for (const multibody::ForcePart& part : strut.parts)
      if (const auto* curve = std::get_if<multibody::ElasticCurve>(&part))
        stiffness += curve->curve.slope(0.0);
  }
  constexpr double kMost = 10.0;  // times its length: no spring is that long, whatever its travel
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

Vector6d Car::acceleration_of_wheel(int corner, const Motion& motion) const {
  const int upright = parts_.corners[at(corner)].upright;
  Vector6d acceleration = motion.accelerations->segment<6>(6 * upright);
  const Vector3d arm = motion.poses[at(upright)].turn * wheel_center_in_upright(corner);
  const Vector3d w = motion.rates->segment<3>(6 * upright + 3);
  acceleration.head<3>() += acceleration.tail<3>().cross(arm) + w.cross(w.cross(arm));
  return acceleration;
}

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
  // A guide without stiffness in a direction does not start with a force there either.
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
  std::array<Vector6d, 2> by_height;  // change of a height by the motion of the chassis; wrench of
                                      // a lift
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

Status Car::advance(CarState& state, double step, const road::Road& road, const CarInputs& inputs) {
  std::array<HubForces, kCorners> before;
  for (std::size_t i = 0; i < before.size(); ++i) before[i] = state.wheels[i].hub;
  const double part = step / mechanism_steps, end = state.time() + step;
  Status rolled;
  for (int i = 1; i <= mechanism_steps; ++i) {
    // `share` is the part of the remaining change of the inputs, `left` the time after this step.
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
