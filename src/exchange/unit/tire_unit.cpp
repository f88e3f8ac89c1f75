// SPDX-License-Identifier: Apache-2.0
#include "exchange/unit/tire_unit.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/error.h"

namespace latsch::exchange {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFastestWheel = 200.0;  // m/s, limit that the tests of a tire also have

// Indices of parameters and inputs in the table of variables; for vectors the index of the first
// component.
enum Given : std::size_t { pressure, is_carried_on, x, yaw = 5, vx = 8, wx = 11, spin = 14 };
// The outputs follow in the table, and then the variables of the free spin, which are younger: the
// numbers of the older ones stay. The values of the four given ones are behind those of Given.
enum GivenOfSpin : std::size_t { is_free = 16, inertia, drive, brake };

std::vector<ExchangedVariable> table(double height) {
  const auto parameter = Causality::parameter, input = Causality::input, output = Causality::output;
  return {
      {"pressure", parameter, "Pa", "inflation; 0: that of the tire's file", 0.0},
      {"inputs.carried_on",
       parameter,
       "1",
       "1: the inputs are the motion where a step begins; 0: where it ends",
       1.0},
      {"wheel.x", input, "m", "wheel center, inertial axes, z up", 0.0},
      {"wheel.y", input, "m", "wheel center", 0.0},
      {"wheel.z", input, "m", "wheel center", height},
      {"wheel.yaw", input, "rad", "about z: positive to the left", 0.0},
      {"wheel.inclination", input, "rad", "about x: positive with the top to the right", 0.0},
      {"wheel.pitch", input, "rad", "of the carrier about the spin axis", 0.0},
      {"wheel.vx", input, "m/s", "velocity of the center, inertial axes", 0.0},
      {"wheel.vy", input, "m/s", "velocity of the center", 0.0},
      {"wheel.vz", input, "m/s", "velocity of the center", 0.0},
      {"wheel.wx", input, "rad/s", "angular velocity of the carrier, inertial axes", 0.0},
      {"wheel.wy", input, "rad/s", "angular velocity of the carrier", 0.0},
      {"wheel.wz", input, "rad/s", "angular velocity of the carrier", 0.0},
      {"wheel.spin", input, "rad", "angle of the rim in the carrier", 0.0},
      {"wheel.spin_rate", input, "rad/s", "positive rolling forward", 0.0},
      {"hub.Fx", output, "N", "force on the rim at the wheel center, carrier axes (TYDEX C)"},
      {"hub.Fy", output, "N", "force on the rim, carrier axes"},
      {"hub.Fz", output, "N", "force on the rim, carrier axes"},
      {"hub.Mx", output, "N m", "moment on the rim about the wheel center, carrier axes"},
      {"hub.My", output, "N m", "moment on the rim, carrier axes"},
      {"hub.Mz", output, "N m", "moment on the rim, carrier axes"},
      {"inertial.Fx", output, "N", "the same force, inertial axes"},
      {"inertial.Fy", output, "N", "the same force, inertial axes"},
      {"inertial.Fz", output, "N", "the same force, inertial axes"},
      {"inertial.Mx", output, "N m", "the same moment, inertial axes"},
      {"inertial.My", output, "N m", "the same moment, inertial axes"},
      {"inertial.Mz", output, "N m", "the same moment, inertial axes"},
      {"loaded_radius", output, "m", "wheel center to road in the wheel's plane"},
      {"contact.length", output, "m", "of the footprint; 0 off the road or if it is not known"},
      {"contact.width", output, "m", "of the footprint; likewise"},
      {"contact.area", output, "m^2", "of the footprint; likewise"},
      {"spin.is_free",
       parameter,
       "1",
       "1: the unit turns the wheel; wheel.spin, wheel.spin_rate are those of the start alone",
       0.0},
      {"spin.inertia", parameter, "kg m^2", "of the wheel about its axle, without the tire", 1.0},
      {"spin.drive", input, "N m", "torque on the free wheel; positive drives forward", 0.0},
      {"spin.brake",
       input,
       "N m",
       "largest torque of the brake on the free wheel; not negative",
       0.0},
      {"spin.angle", output, "rad", "angle of the rim in the carrier"},
      {"spin.rate", output, "rad/s", "positive rolling forward"},
      {"carrier.My", output, "N m", "reaction of drive and brake on the carrier, carrier axes"},
  };
}

/// Returns a sentence if the pressure, Pa, is unusual; else nothing. Throws InputError for a
/// pressure that no tire has.
std::string doubt_about_pressure(double pa) {
  // Pa; those of a test's pressure in experiment/language/usual_numbers.cpp
  constexpr double kLeast = 2e3, kLow = 3e4, kHigh = 1.6e6, kMost = 4e6;
  if (pa == 0.0 || (pa >= kLow && pa <= kHigh)) return "";
  const std::string sentence = fmt::format(
      "the parameter pressure is {:.4g} Pa, but an inflation pressure is usually 0.3 to 16 bar",
      pa);
  if (!(pa >= kLeast && pa <= kMost))
    throw InputError(sentence + ": expected a gauge pressure in Pa");
  return sentence;
}

}  // namespace

double loaded_radius(const WheelMotion& motion, const road::Road& road, double time) {
  // Number of iterations to find the road plane below the wheel.
  constexpr int kCorrections = 3;
  const Vector3d down = -motion.carrier.col(2);
  double radius = 0.0;
  for (int i = 0; i <= kCorrections; ++i) {
    const Vector3d point = motion.center + radius * down;
    const road::GroundPoint ground = road.at(point.x(), point.y(), time);
    const double steep = -down.dot(ground.normal);
    if (!(steep > 0.0)) return std::numeric_limits<double>::infinity();
    const Vector3d below(point.x(), point.y(), ground.height);
    radius = (motion.center - below).dot(ground.normal) / steep;
  }
  return radius;
}

WheelMotion carried_on(const WheelMotion& motion, double step) {
  WheelMotion end = motion;
  end.center += step * motion.velocity;
  const Vector3d turn = step * motion.angular_velocity;
  if (const double angle = turn.norm(); angle > 0.0)
    end.carrier = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * motion.carrier;
  end.spin += step * motion.spin_rate;
  return end;
}

TireUnit::TireUnit(RollingModel model, std::shared_ptr<const road::Road> road)
    : model_(std::move(model)), road_(std::move(road)) {
  if (!model_.rolls) throw InputError("the model does not roll: expected a tire that does");
  tire_ = model_.rolls->tire();
  const double height = road_->at(0.0, 0.0, 0.0).height + tire_->free_radius();
  variables_ = std::make_shared<const std::vector<ExchangedVariable>>(table(height));
  assert(variables_->size() == kGiven + kAnswers + kPrints + kGivenOfSpin + kSpun);
  for (std::size_t i = 0; i < variables_->size(); ++i)
    if (const auto place = place_of_given(i)) given_[*place] = (*variables_)[i].start;
}

std::optional<std::size_t> TireUnit::place_of_given(std::size_t variable) {
  if (variable < kGiven) return variable;
  if (variable < kBeforeSpin || variable >= kBeforeSpin + kGivenOfSpin) return std::nullopt;
  return variable - kBeforeSpin + kGiven;
}

TireUnit::TireUnit(const TireUnit& other)
    : model_(other.model_),
      road_(other.road_),
      variables_(other.variables_),
      greatest_(other.greatest_),
      tire_(other.tire_->clone()),
      given_(other.given_),
      answers_(other.answers_),
      print_(other.print_),
      wheel_(other.wheel_),
      spun_(other.spun_) {}

double TireUnit::value(std::size_t variable) const {
  if (const auto place = place_of_given(variable)) return given_[*place];
  if (variable >= kBeforeSpin) return spun_[variable - kBeforeSpin - kGivenOfSpin];
  if (variable < kGiven + kAnswers) return answers_[variable - kGiven];
  if (!print_) print_ = tire_->footprint().value_or(Footprint{});
  const double print[] = {print_->length, print_->width, print_->area};
  assert(variable - kGiven - kAnswers < std::size(print));
  return print[variable - kGiven - kAnswers];
}

void TireUnit::set(std::size_t variable, double value) {
  const auto place = place_of_given(variable);
  assert(place);
  given_[*place] = value;
}

WheelMotion TireUnit::motion() const {
  const auto vector = [&](std::size_t i) {
    return Vector3d(given_[i], given_[i + 1], given_[i + 2]);
  };
  const Eigen::AngleAxisd about_z(given_[yaw], Vector3d::UnitZ());
  const Eigen::AngleAxisd about_x(given_[yaw + 1], Vector3d::UnitX());
  const Eigen::AngleAxisd about_y(given_[yaw + 2], Vector3d::UnitY());
  WheelMotion motion;
  motion.center = vector(x);
  motion.carrier =
      about_z.toRotationMatrix() * about_x.toRotationMatrix() * about_y.toRotationMatrix();  // (1)
  motion.velocity = vector(vx);
  motion.angular_velocity = vector(wx);
  motion.spin = given_[spin];
  motion.spin_rate = given_[spin + 1];
  return motion;
}

void TireUnit::take(const HubForces& hub, const WheelMotion& motion, double time) {
  Eigen::Map<Eigen::Matrix<double, 3, 4>> vectors(answers_.data());
  vectors << hub.force, hub.moment, motion.carrier * hub.force, motion.carrier * hub.moment;
  answers_[12] = loaded_radius(motion, *road_, time);
  // the reaction is all that the tire's moment leaves to accelerate the wheel
  const double reaction =
      wheel_ ? hub.moment.y() - wheel_->spin->inertia * wheel_->spin->acceleration : 0.0;
  spun_ = {motion.spin, motion.spin_rate, reaction};
  const double deflection = tire_->free_radius() - answers_[12];
  greatest_->deflection = std::max(greatest_->deflection, deflection);
  print_.reset();
}

Status TireUnit::start(double time) {
  if (std::string doubt = doubt_about_pressure(given_[pressure]); !doubt.empty())
    greatest_->pressure = std::move(doubt);
  tire_ = model_.rolls->tire(given_[pressure] != 0.0 ? Inflation(given_[pressure]) : Inflation());
  wheel_.reset();
  if (given_[is_free] != 0.0 && !(given_[inertia] > 0.0))
    throw InputError(
        fmt::format("spin.inertia = {} kg m^2: expected more than 0, because spin.is_free is 1",
                    given_[inertia]));
  const WheelMotion now = motion();
  const Result<HubForces> hub = tire_->settle(now, *road_, time);
  if (!hub) return hub.failure();
  if (given_[is_free] != 0.0) wheel_ = free_wheel_at(now, hub->moment.y());
  take(*hub, now, time);
  return {};
}

double TireUnit::brake_torque() {
  greatest_->release = std::min(greatest_->release, given_[brake]);
  return std::max(0.0, given_[brake]);
}

FreeWheel TireUnit::free_wheel_at(const WheelMotion& motion, double moment) {
  FreeWheel wheel;
  wheel.brake = brake_torque();
  const double pulls = moment + given_[drive];
  const double left = motion.spin_rate == 0.0
                          ? std::copysign(std::max(0.0, std::abs(pulls) - wheel.brake), pulls)
                          : pulls - std::copysign(wheel.brake, motion.spin_rate);
  wheel.spin = FreeRate{given_[inertia], motion.spin, motion.spin_rate, left / given_[inertia], {}};
  return wheel;
}

Result<HubForces> TireUnit::advance(WheelMotion& end, double time, double step) {
  if (!wheel_) return tire_->advance(end, *road_, time, step);
  FreeWheel wheel = *wheel_;
  wheel.brake = brake_torque();
  wheel.spin->push = [torque = given_[drive]](double, double) { return Push{torque, 0.0}; };
  auto hub = tire_->advance_free(end, wheel, *road_, time, step);
  if (!hub) return hub;
  wheel.spin->push = {};
  wheel_ = std::move(wheel);
  return hub;
}

Status TireUnit::step(double time, double step) {
  WheelMotion end = given_[is_carried_on] != 0.0 ? carried_on(motion(), step) : motion();
  const Result<HubForces> hub = advance(end, time + step, step);
  if (!hub) return hub.failure();
  take(*hub, end, time + step);
  const double speed = end.velocity.norm();
  greatest_->speed = std::max(greatest_->speed, speed);
  greatest_->way = std::max(greatest_->way, speed * step);
  return {};
}

std::vector<std::string> TireUnit::limits_met() const {
  tire_->clone().reset();  // tires pass their inputs on when they are destroyed
  std::vector<std::string> limits = model_.limits_met();
  const Greatest& met = *greatest_;
  if (!met.pressure.empty()) limits.push_back(met.pressure);
  if (met.speed > kFastestWheel)
    limits.push_back(
        fmt::format("the wheel moved at {:.4g} m/s, above the {:g} m/s that a test "
                    "of a tire allows: are the velocities in m/s?",
                    met.speed,
                    kFastestWheel));
  if (met.way > kFarthestStep * (1.0 + 1e-9))
    limits.push_back(
        fmt::format("a step moved the wheel by {:.3g} mm, more than the {:.3g} mm "
                    "that a test of a tire allows: forces that change within a step "
                    "are lost; take shorter steps",
                    1e3 * met.way,
                    1e3 * kFarthestStep));
  if (met.release < 0.0)
    limits.push_back(
        fmt::format("spin.brake was {:.4g} N m, and is 0 where it is negative: a brake "
                    "has no direction",
                    met.release));
  if (const Status fit = check_depth(*tire_, met.deflection); !fit)
    limits.push_back(fit.failure().reason);
  return limits;
}

}  // namespace latsch::exchange
