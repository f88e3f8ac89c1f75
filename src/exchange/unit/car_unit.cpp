// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit/car_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.h"
#include "exchange/unit/tire_unit.h"

namespace latsch::exchange {
namespace {

using car::kCorners;
using Eigen::Vector3d;

constexpr double kFastest = 150.0;                           // m/s
constexpr double kShortestStep = 1e-6, kLongestStep = 2e-3;  // s, limits of the car's time step

// Indices of parameters and inputs in the table of variables; for vectors the index of the first
// component.
enum Given : std::size_t {
  speed,
  longest,
  along,
  lateral,
  yaw,
  is_guide_given,
  road_continues,
  rack,
  rack_velocity,
  drive,
  brake = drive + kCorners,
  force = brake + kCorners,
  moment = force + 3,
  guide_x = moment + 3,
  guide_speed,
  guide_y,
  given_count
};
static_assert(given_count == CarUnit::kGiven);

void add_parameters(std::vector<ExchangedVariable>& table) {
  const auto parameter = Causality::parameter;
  const car::Guide guide;
  table.push_back({"speed", parameter, "m/s", "with which the car begins, along x", 0.0});
  table.push_back({"step.longest", parameter, "s", "steps of the car are no longer", 2e-4});
  table.push_back(
      {"guide.along", parameter, "N/m", "stiffness along x; 0: does not hold", guide.along});
  table.push_back({"guide.lateral", parameter, "N/m", "likewise along y", guide.lateral});
  table.push_back({"guide.yaw", parameter, "N m/rad", "likewise about z", guide.yaw});
  table.push_back({"guide.is_given",
                   parameter,
                   "1",
                   "1: the guide is where the inputs are; 0: straight on at `speed`",
                   0.0});
  table.push_back({"road.continues",
                   parameter,
                   "1",
                   "beyond the edge of its file: 1: as its kind of file does; 0: an error",
                   0.0});
}

void add_inputs(std::vector<ExchangedVariable>& table) {
  const auto input = Causality::input;
  table.push_back({"rack.travel", input, "m", "positive to the left", 0.0});
  table.push_back({"rack.velocity", input, "m/s", "of its travel", 0.0});
  for (const char* corner : car::kCornerNames)
    table.push_back({fmt::format("drive.{}", corner),
                     input,
                     "N m",
                     "torque on the wheel, its reaction on the chassis; positive drives forward",
                     0.0});
  for (const char* corner : car::kCornerNames)
    table.push_back({fmt::format("brake.{}", corner),
                     input,
                     "N m",
                     "largest torque of the brake against the wheel's spin; not negative",
                     0.0});
  for (const char* axis : {"x", "y", "z"})
    table.push_back({fmt::format("load.F{}", axis),
                     input,
                     "N",
                     "force on the chassis at its center of mass, inertial axes",
                     0.0});
  for (const char* axis : {"x", "y", "z"})
    table.push_back(
        {fmt::format("load.M{}", axis), input, "N m", "moment on the chassis, inertial axes", 0.0});
  table.push_back({"guide.x", input, "m", "distance of the guide from its start", 0.0});
  table.push_back({"guide.speed", input, "m/s", "of the guide", 0.0});
  table.push_back({"guide.y", input, "m", "line of the guide", 0.0});
}

void add_outputs(std::vector<ExchangedVariable>& table) {
  const auto add = [&](std::string name, const char* unit, const char* description) {
    table.push_back({std::move(name), Causality::output, unit, description});
  };
  for (const char* axis : {"x", "y", "z"})
    add(fmt::format("chassis.{}", axis), "m", "center of mass of the chassis, inertial axes");
  add("chassis.roll", "rad", "left side up: positive");
  add("chassis.pitch", "rad", "front down: positive");
  add("chassis.yaw", "rad", "to the left: positive");
  for (const char* axis : {"x", "y", "z"})
    add(fmt::format("chassis.v{}", axis), "m/s", "velocity of the center of mass, inertial axes");
  for (const char* axis : {"x", "y", "z"})
    add(fmt::format("chassis.w{}", axis), "rad/s", "angular velocity, inertial axes");
  for (const char* axis : {"x", "y", "z"})
    add(fmt::format("chassis.a{}", axis), "m/s^2", "acceleration of the center of mass, inertial");
  for (const char* corner : car::kCornerNames) {
    add(fmt::format("pushrod.{}.force", corner), "N", "along the push-rod; compression: positive");
    add(fmt::format("spring.{}.extension", corner), "m", "of the spring unit; 0 where locked");
    for (const char* axis : {"x", "y", "z"})
      add(fmt::format("wheel.{}.{}", corner, axis), "m", "wheel center, inertial axes");
    for (const char* axis : {"x", "y", "z"})
      add(fmt::format("wheel.{}.F{}", corner, axis), "N", "of the tire on the hub, inertial axes");
    add(fmt::format("wheel.{}.spin", corner), "rad", "of the wheel in its upright");
    add(fmt::format("wheel.{}.spin_rate", corner), "rad/s", "rolling forward: positive");
  }
}

std::vector<ExchangedVariable> table() {
  std::vector<ExchangedVariable> variables;
  add_parameters(variables);
  add_inputs(variables);
  assert(variables.size() == CarUnit::kGiven);
  add_outputs(variables);
  assert(variables.size() == CarUnit::kGiven + CarUnit::kAnswers);
  return variables;
}

void check_range(const ExchangedVariable& variable, double value, double lower, double upper) {
  if (!(value >= lower && value <= upper))
    throw InputError(fmt::format(
        "{} = {} {}: expected {} to {}", variable.name, value, variable.unit, lower, upper));
}

}  // namespace

Vector3d roll_pitch_yaw(const Eigen::Matrix3d& turn) {
  return {std::atan2(turn(2, 1), turn(2, 2)),
          std::asin(std::clamp(-turn(2, 0), -1.0, 1.0)),
          std::atan2(turn(1, 0), turn(0, 0))};
}

CarUnit::CarUnit(DrivingModel model, std::shared_ptr<const road::Road> road)
    : model_(std::move(model)),
      road_(std::move(road)),
      variables_(std::make_shared<const std::vector<ExchangedVariable>>(table())) {
  if (!model_.drives) throw InputError("the model cannot be driven: expected a car");
  for (std::size_t i = 0; i < kGiven; ++i) given_[i] = (*variables_)[i].start;
}

double CarUnit::value(std::size_t variable) const {
  if (variable < kGiven) return given_[variable];
  assert(variable - kGiven < kAnswers);
  return answers_[variable - kGiven];
}

void CarUnit::set(std::size_t variable, double value) {
  assert(variable < given_.size());
  given_[variable] = value;
}

car::CarInputs CarUnit::inputs(const car::Car& car, double since) const {
  car::CarInputs inputs;
  inputs.rack = given_[rack] + since * given_[rack_velocity];  // (1)
  for (std::size_t i = 0; i < kCorners; ++i) {
    inputs.drive[i] = given_[drive + i];
    inputs.brake[i] = std::max(0.0, given_[brake + i]);
  }
  multibody::Load load{car.parts().chassis, car.parameters().chassis.body.center};
  load.force = Eigen::Map<const Vector3d>(&given_[force]);
  load.moment = Eigen::Map<const Vector3d>(&given_[moment]);
  inputs.loads.push_back(load);
  if (given_[is_guide_given] != 0.0)
    inputs.guide = car::GuidePoint{
        given_[guide_x] + since * given_[guide_speed], given_[guide_speed], given_[guide_y]};
  return inputs;
}

void CarUnit::take(const car::Car& car, const car::CarInputs& inputs) {
  const auto chassis = static_cast<std::size_t>(car.parts().chassis);
  const multibody::Pose& pose = state_->bodies.poses[chassis];
  const Vector3d at_rest = car.parameters().chassis.body.center;
  const Vector3d arm = pose.turn * (at_rest - car.mechanism().bodies()[chassis].origin);
  const multibody::Vector6d v = state_->bodies.rates.segment<6>(6 * car.parts().chassis);
  const multibody::Vector6d a = state_->bodies.accelerations.segment<6>(6 * car.parts().chassis);
  const Vector3d w = v.tail<3>();
  double* next = answers_.data();
  const auto put = [&](const Vector3d& vector) { next = std::copy_n(vector.data(), 3, next); };
  put(pose.place + arm);
  put(roll_pitch_yaw(pose.turn));
  put(v.head<3>() + w.cross(arm));
  put(w);
  put(a.head<3>() + a.tail<3>().cross(arm) + w.cross(w.cross(arm)));
  const auto pushrods = car.pushrod_forces(*state_, inputs);
  for (int corner = 0; corner < kCorners; ++corner) {
    const car::WheelState& wheel = state_->wheels[static_cast<std::size_t>(corner)];
    *next++ = pushrods[static_cast<std::size_t>(corner)];
    *next++ = car.spring_extension(*state_, corner);
    put(wheel.motion.center);
    put(wheel.motion.carrier * wheel.hub.force);
    *next++ = wheel.motion.spin;
    *next++ = wheel.motion.spin_rate;
  }
  assert(next == answers_.data() + answers_.size());
}

void CarUnit::watch(const car::Car& car, double time, double step) {
  double mass = 0.0;
  for (const multibody::Body& body : car.mechanism().bodies()) mass += body.mass;
  constexpr double kGravity = 9.81;  // m/s^2
  watch_->set_weight(kGravity * mass);
  for (std::size_t i = 0; i < kGiven; ++i) {
    const bool is_brake = i >= brake && i < std::size_t{brake} + kCorners;
    if (is_brake)
      watch_->add_brake((*variables_)[i], given_[i]);
    else
      watch_->add((*variables_)[i], given_[i]);
  }
  const multibody::Vector6d v = state_->bodies.rates.segment<6>(6 * car.parts().chassis);
  watch_->add_way(step * v.head<3>().norm());
  for (const car::WheelState& wheel : state_->wheels)
    watch_->add_deflection(wheel.tire->free_radius() - loaded_radius(wheel.motion, *road_, time),
                           wheel.tire->free_radius());
}

Status CarUnit::start(double time) {
  check_range((*variables_)[speed], given_[speed], 0.0, kFastest);
  check_range((*variables_)[longest], given_[longest], kShortestStep, kLongestStep);
  for (const std::size_t stiffness : {along, lateral, yaw})
    check_range((*variables_)[stiffness], given_[stiffness], 0.0, HUGE_VAL);
  state_.reset();
  if (!shared_) {
    auto car = model_.drives->car({});
    if (!car) return car.failure();
    shared_ = std::make_shared<Shared>();
    shared_->car = std::move(*car);
  }
  const std::lock_guard lock(shared_->turn);
  car::Car& car = *shared_->car;
  // The equilibrium needs the guide, which holds the car on its line, even if the guide has no
  // stiffness later. The line and the guided axle are those of the car's file.
  const car::Guide holds;
  car.guide.along = holds.along;
  car.guide.lateral = holds.lateral;
  car.guide.yaw = holds.yaw;
  car.may_leave_road = given_[road_continues] != 0.0;
  const car::CarInputs now = inputs(car, 0.0);
  auto settled = car.settle(*road_, given_[speed], now);
  if (!settled) return settled.failure();
  state_ = std::move(*settled);
  air_ = {};
  air_.see(car, *state_, time);
  take(car, now);
  watch(car, time, 0.0);
  return {};
}

Status CarUnit::step(double time, double step) {
  assert(state_ && step > 0.0);
  const double exact = step / given_[longest];
  // A communication step of 1 ms has five steps of 0.2 ms despite rounding.
  const double steps = std::max(1.0, std::ceil(exact * (1.0 - 1e-9)));
  const double h = step / steps;
  const std::lock_guard lock(shared_->turn);
  car::Car& car = *shared_->car;
  car.guide.along = given_[along];
  car.guide.lateral = given_[lateral];
  car.guide.yaw = given_[yaw];
  car.may_leave_road = given_[road_continues] != 0.0;
  car::CarInputs end;
  for (double i = 1.0; i <= steps; i += 1.0) {
    end = inputs(car, i * h);
    const Status done = car.advance(*state_, h, *road_, end);
    if (!done) return done.failure();
    air_.see(car, *state_, time + i * h);
  }
  take(car, end);
  watch(car, time + step, h);
  return {};
}

std::vector<std::string> CarUnit::limits_met() const {
  // tires pass their inputs on when they are destroyed
  std::optional<car::CarState>(state_).reset();
  std::vector<std::string> limits = model_.limits_met();
  for (std::string& sentence : watch_->sentences()) limits.push_back(std::move(sentence));
  if (std::string air = air_.sentence(); !air.empty()) limits.push_back(std::move(air));
  return limits;
}

}  // namespace latsch::exchange
