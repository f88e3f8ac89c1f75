// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/static_stiffness.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "experiment/rigs/drum_rig.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"

namespace latsch::experiment {
namespace {

WheelMotion standing(double height, double camber = 0.0) {
  WheelMotion motion;
  motion.center.z() = height;
  motion.carrier = Eigen::AngleAxisd(camber, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return motion;
}

/// A smooth motion from 0 to 1 without a jump of the acceleration: its position and its rate, as
/// functions of the share of the ramp.
struct Way {
  double place, rate;
};
Way way_at(double share) {
  if (share >= 1.0) return {1.0, 0.0};
  const double s2 = share * share;
  return {s2 * share * (10.0 - 15.0 * share + 6.0 * s2), 30.0 * s2 * (1.0 - share) * (1.0 - share)};
}

WheelMotion moved(const WheelMotion& from, Direction direction, double travel, double rate) {
  WheelMotion motion = from;
  if (direction == Direction::torsional) {
    motion.carrier =
        Eigen::AngleAxisd(travel, Eigen::Vector3d::UnitZ()).toRotationMatrix() * from.carrier;
    motion.angular_velocity.z() = rate;
    return motion;
  }
  const int axis = direction == Direction::longitudinal ? 0 : 1;
  motion.center[axis] += travel;
  motion.velocity[axis] = rate;
  return motion;
}

double reaction(const WheelMotion& motion, const HubForces& hub, Direction direction) {
  if (direction == Direction::torsional) return (motion.carrier * hub.moment).z();
  return (motion.carrier * hub.force)[direction == Direction::longitudinal ? 0 : 1];
}

}  // namespace

const char* name_of(Direction direction) { return kDirections[static_cast<int>(direction)]; }
const char* unit_of(Direction direction) {
  return direction == Direction::torsional ? "N m/rad" : "N/m";
}

Result<double> load_at(Tire& tire, double deflection, const std::optional<Cleat>& cleat) {
  if (const Status fit = check_depth(tire, deflection); !fit) return fit.failure();
  const auto on = [&](const road::Road& ground) -> Result<double> {
    const double height = ground.height(0.0, 0.0, 0.0) + tire.free_radius() - deflection;
    const auto hub = tire.settle(standing(height), ground, 0.0);
    if (!hub) return hub.failure();
    return hub->force.z();
  };
  if (!cleat) return on(road::PlaneRoad());
  return on(road::cleat_road(0.0, cleat->height, cleat->length, cleat->bevel, cleat->angle));
}

Result<double> stiffness(Tire& tire, const StiffnessTest& test) {
  const road::PlaneRoad ground;
  const Eigen::Matrix3d carrier = standing(0.0, test.camber).carrier;
  const auto height = height_under_load(tire, ground, carrier, test.load);
  if (!height) return height.failure();
  if (const double pressed = tire.free_radius() - *height;
      test.direction == Direction::vertical && test.camber == 0.0 && test.travel >= pressed)
    return Failure{
        fmt::format("a travel of {:.3g} mm lifts the tire off the ground: {:g} N press "
                    "it by {:.3g} mm; a shorter travel is expected",
                    1e3 * test.travel,
                    test.load,
                    1e3 * pressed)};
  if (test.direction == Direction::vertical) {
    const auto load_on = [&](double lower) -> Result<double> {
      const auto hub = tire.settle(standing(*height - lower, test.camber), ground, 0.0);
      if (!hub) return hub.failure();
      return (carrier * hub->force).z();
    };
    const auto more = load_on(test.travel);
    if (!more) return more;
    const auto less = load_on(-test.travel);
    if (!less) return less;
    return (*more - *less) / (2.0 * test.travel);
  }
  const WheelMotion start = standing(*height, test.camber);
  auto hub = tire.settle(start, ground, 0.0);
  if (!hub) return hub.failure();
  const double before = reaction(start, *hub, test.direction);
  WheelMotion motion = start;
  const long steps = std::lround((test.ramp + test.hold) / test.step);
  for (long i = 1; i <= steps; ++i) {
    const double time = static_cast<double>(i) * test.step;
    const Way way = way_at(time / test.ramp);
    motion =
        moved(start, test.direction, way.place * test.travel, way.rate * test.travel / test.ramp);
    hub = tire.advance(motion, ground, time, test.step);
    if (!hub) return hub.failure();
  }
  return (before - reaction(motion, *hub, test.direction)) / test.travel;
}

namespace {

/// Fails if the steps of the tire do not resolve a travel as small as that of the test: then force
/// over travel differs from that of a larger travel, over which the patch does not slide either.
Status check_resolution(Tire& tire, const StiffnessTest& test, double found) {
  constexpr double kResolved = 2e-4;    // m, rad; 1 N at a tenth of the stiffness of a car tire
  constexpr double kDifference = 0.02;  // above a tire's nonlinearity over this travel
  if (test.direction == Direction::vertical || test.travel >= kResolved) return {};
  StiffnessTest larger = test;
  larger.travel = kResolved;
  const auto expected = stiffness(tire, larger);
  if (!expected) return expected.failure();
  if (std::abs(found - *expected) <= kDifference * std::abs(*expected)) return {};
  const bool turns = test.direction == Direction::torsional;
  return Failure{fmt::format(
      "a {} of {:.3g} {} is less than the steps of this tire resolve: the {} stiffness is {:.4g} "
      "{} over it and {:.4g} over {:g} {}; a larger {} is expected",
      turns ? "twist" : "travel",
      (turns ? 1.0 : 1e3) * test.travel,
      turns ? "rad" : "mm",
      name_of(test.direction),
      found,
      unit_of(test.direction),
      *expected,
      (turns ? 1.0 : 1e3) * kResolved,
      turns ? "rad" : "mm",
      turns ? "twist" : "travel")};
}

}  // namespace

Channels standing_channels(const StandingTest& test,
                           const std::vector<double>& forces,
                           const std::vector<double>& stiffnesses) {
  Channels channels;
  if (!test.deflections.empty()) {
    channels.add({"deflection", "m", test.deflections});
    channels.add({"force", "N", forces});
  }
  for (std::size_t k = 0; k < test.directions.size(); ++k) {
    channels.add({name_of(test.directions[k]), unit_of(test.directions[k]), {stiffnesses[k]}});
  }
  return channels;
}

Result<Channels> stand(Tire& tire, const StandingTest& test) {
  if (test.friction)
    throw InputError("a tire that rolls has friction in its own file: expected a test without it");
  std::vector<double> forces, stiffnesses;
  for (const double deflection : test.deflections) {
    const auto load = load_at(tire, deflection, test.cleat);
    if (!load) return load.failure();
    forces.push_back(*load);
  }
  for (const Direction direction : test.directions) {
    StiffnessTest one;
    one.direction = direction;
    one.load = test.load;
    one.camber = test.camber;
    one.travel = direction == Direction::torsional ? test.twist : test.travel;
    const auto found = stiffness(tire, one);
    if (!found) return found.failure();
    if (const Status resolved = check_resolution(tire, one, *found); !resolved)
      return resolved.failure();
    stiffnesses.push_back(*found);
  }
  return standing_channels(test, forces, stiffnesses);
}

}  // namespace latsch::experiment
