// SPDX-License-Identifier: Apache-2.0
// Finds the static equilibrium of a car on its tires, standing or rolling at constant speed, from
// which a simulation starts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "models/car/car.h"
#include "models/car/falling_ranges.h"
#include "models/car/wheel_index.h"
#include "models/road/plane_road.h"

namespace latsch::car {

using Eigen::Vector3d;
using multibody::BodyForce;
using multibody::Motion;
using multibody::Pose;
using multibody::Rest;
using multibody::Vector6d;

Result<Rest> Car::stand(const LineTires& tires,
                        double speed,
                        const CarInputs& inputs,
                        const Rest& from,
                        Trim& trim,
                        double* held) {
  const multibody::Outside outside = [&](const Motion& motion, std::vector<BodyForce>& wrenches) {
    for (int corner = 0; corner < kCorners; ++corner) {
      const CornerParts& parts = parts_.corners[at(corner)];
      const LineTire& tire = tires[at(corner)];
      const Pose& upright = motion.poses[at(parts.upright)];
      const Vector3d arm = upright.turn * wheel_center_in_upright(corner);
      const double z = upright.place.z() + arm.z();
      Vector3d force = tire.beside.head<3>();
      force.z() += tire.force + tire.stiffness * (tire.height - z);
      BodyForce wrench{.body = parts.upright};
      wrench.value << force, arm.cross(force) + tire.beside.tail<3>();
      // Derivative of the height z with respect to the upright's displacement and rotation.
      Vector6d by_z;
      by_z << Vector3d::UnitZ(), arm.cross(Vector3d::UnitZ());
      wrench.slopes = -tire.stiffness * by_z * by_z.transpose();
      wrench.slopes.bottomRightCorner<3, 3>() += multibody::cross(force) * multibody::cross(arm);
      wrenches.push_back(wrench);
    }
    const GuidePoint start = inputs.guide.value_or(GuidePoint{0.0, 0.0, 0.0});
    add_guide(motion, {0.0, 0.0, start.y}, wrenches);
    add_pull(motion, trim.along, trim, wrenches);
    add_air(motion, speed, wrenches);
  };
  const std::array<double, kDrivers> drivers = {inputs.rack};
  const multibody::RestSettings standing{
      .loads = inputs.loads, .drivers = drivers, .outside = &outside};
  auto found = statics_->solve(standing, from);
  // If the solver finds no equilibrium from this start, it begins at the drawn position and applies
  // the load in shares.
  if (!found) found = statics_->solve(standing, statics_->unloaded());
  if (!found)
    return Failure{found.failure().reason + "; " +
                   (statics_->share() > 0.0 ? sunk(statics_->reached(), tires, speed)
                                            : unstable_as_drawn(speed))};
  const double off = off_guide(found->poses[at(parts_.chassis)], {0.0, 0.0, 0.0}).x();
  const double left = -kStill * guide.along * off;
  trim.along += left;
  if (held) *held = left;
  return found;
}

std::string Car::unstable_as_drawn(double speed) const {
  std::string words =
      "not even a small share of the load has an equilibrium near the position in which the car is "
      "drawn";
  if (!parameters_.aero || speed == 0.0) return words;
  const AeroMap& air = *parameters_.aero;
  const double q = 0.5 * air.density * speed * speed * air.area;
  const AeroMap::Coefficients there = air.at(air.floor_front, air.floor_rear);
  return words + fmt::format(
                     ". There the downforce is {:.4g} N, {:.2g} times the weight, and grows by "
                     "{:.3g} N with every millimeter that the floor sinks; springs and tires have "
                     "to hold more than that",
                     q * there.downforce.sum(),
                     q * there.downforce.sum() / (mechanism_->mass() * parameters_.gravity),
                     -1e-3 * q * there.by_height.sum());
}

std::string Car::sunk(const Rest& rest, const LineTires& tires, double speed) const {
  const Pose& chassis = rest.poses[at(parts_.chassis)];
  int worst = kFL;
  std::array<double, kCorners> risen{}, pressed{}, shortened{};
  for (int corner = 0; corner < kCorners; ++corner) {
    const CornerParts& parts = parts_.corners[at(corner)];
    const Vector3d center = motion_of_wheel(corner, rest.poses, nullptr).center;
    const Vector3d drawn =
        chassis.at(parts.wheel_center - mechanism_->bodies()[at(parts_.chassis)].origin);
    risen[at(corner)] = center.z() - drawn.z();
    const LineTire& tire = tires[at(corner)];
    const double force = tire.force + tire.stiffness * (tire.height - center.z());
    pressed[at(corner)] = tire.stiffness > 0.0 ? force / tire.stiffness : 0.0;
    if (parts.unit >= 0)
      shortened[at(corner)] = -transient_->assembly().extension(parts.unit, rest.poses);
    if (risen[at(corner)] > risen[at(worst)]) worst = corner;
  }
  std::string words = fmt::format(
      "in its last equilibrium it had sunk most at {}: the wheel stands {:.3g} mm higher in the "
      "car than "
      "drawn, the tire is pressed by some {:.3g} mm of its radius of {:.4g} mm",
      kCornerNames[at(worst)],
      1e3 * risen[at(worst)],
      1e3 * pressed[at(worst)],
      1e3 * tires_[at(worst)]->free_radius());
  if (const int unit = parts_.corners[at(worst)].unit; unit >= 0)
    words += fmt::format(", its spring unit shortened by {:.3g} mm of {:.4g} mm",
                         1e3 * shortened[at(worst)],
                         1e3 * mechanism_->rest_length(unit));
  if (!parameters_.aero || speed == 0.0) return words;
  const AeroMap& air = *parameters_.aero;
  const auto floor_at = [&](const Axle& axle, double height) {
    const Vector3d origin = mechanism_->bodies()[at(parts_.chassis)].origin;
    return chassis.at(Vector3d(axle.corner.wheel_center.x(), 0.0, height) - origin).z();
  };
  const double front = floor_at(parameters_.front, air.floor_front),
               rear = floor_at(parameters_.rear, air.floor_rear);
  const double down =
      0.5 * air.density * speed * speed * air.area * air.at(front, rear).downforce.sum();
  return words + fmt::format(
                     ". There the downforce would be {:.4g} N, {:.2g} times the weight, the floor "
                     "{:.3g} mm above z = 0 in front and {:.3g} mm behind",
                     down,
                     down / (mechanism_->mass() * parameters_.gravity),
                     1e3 * front,
                     1e3 * rear);
}

namespace {

/// Linearizes the vertical force of a tire about its current state, as a function of the height of
/// its wheel.
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

/// Settings for letting the tires roll to the car's starting position. They roll in rounds; after
/// each round the car's equilibrium is computed again.
struct RollIn {
  static constexpr int kRounds = 12;
  static constexpr int kMostRounds = 32 * kRounds;  // 115 m of path below 10 m/s, 11.5 s above
  // Rounds in which the car's body is held until the belts have grown.
  static constexpr int kHeld = 3;
  // Duration of a round, s. It covers at least 0.3 m of path, after which a tire of short
  // relaxation length has lost its initial transient.
  double duration;
  int steps;  // number of steps of a round, each 12 mm long

  explicit RollIn(double speed)
      : duration(std::max(0.03, 0.3 / speed)),
        steps(static_cast<int>(std::ceil(duration * speed / 0.012))) {}
};

/// Returns the height of the wheel center over the road, m.
double arm_over(const road::Road& road, const WheelState& wheel) {
  const Vector3d& center = wheel.motion.center;
  return center.z() - road.height(center.x(), center.y(), 0.0);
}

Failure no_stand(int corner, const std::string& why) {
  return {fmt::format("the tire {} does not stand on the road: {}", kCornerNames[at(corner)], why)};
}

/// Returns the secant stiffness of a tire, N/m, from the change of its force while it was lowered
/// by `travel` (m). Returns the previous `stiffness` if the secant differs from it implausibly.
double secant_of(double more_force, double travel, double stiffness) {
  if (std::abs(travel) <= 1e-9) return stiffness;
  const double secant = more_force / travel;
  return secant > 0.1 * stiffness && secant < 10.0 * stiffness ? secant : stiffness;
}

}  // namespace

Result<Rest> Car::settle_on_tires(CarState& state,
                                  LineTires& lines,
                                  const road::Road& road,
                                  const CarInputs& inputs) {
  constexpr int kMost = 40;
  // Convergence tolerances: change of a tire load relative to the car's weight.
  constexpr double kEnough = 1e-8, kUsual = 1e-5;
  const double weight = mechanism_->mass() * parameters_.gravity;
  const Eigen::VectorXd rates = straight_on(mechanism_->bodies().size(), state.speed);
  Rest rest = statics_->unloaded();
  for (int corner = 0; corner < kCorners; ++corner) {
    const WheelMotion drawn = motion_of_wheel(corner, rest.poses, nullptr);
    if (const Status on = check_on_road(corner, drawn, road); !on) return on.failure();
    const double ground = road.height(drawn.center.x(), drawn.center.y(), 0.0);
    lines[at(corner)] = {.stiffness = 2e5, .height = ground + tires_[at(corner)]->free_radius()};
    state.trim.arm[at(corner)] = tires_[at(corner)]->free_radius();
  }
  double worst = 0.0, before = 0.0;
  // N/m, stiffness of each tire when it last touched the road
  std::array<double, kCorners> touching;
  touching.fill(lines[kFL].stiffness);
  int touched = 0;  // number of touching tires in the last round
  for (int i = 0; i < kMost; ++i) {
    double held = 0.0;
    auto stood = stand(lines, state.speed, inputs, rest, state.trim, &held);
    if (!stood) return stood;
    rest = std::move(*stood);
    before = worst;
    worst = std::abs(held);
    const int stood_on = std::exchange(touched, 0);
    for (int corner = 0; corner < kCorners; ++corner) {
      LineTire& line = lines[at(corner)];
      WheelState& wheel = state.wheels[at(corner)];
      wheel.motion = motion_of_wheel(corner, rest.poses, &rates);
      const double z = wheel.motion.center.z(), radius = tires_[at(corner)]->free_radius();
      // The effective rolling radius of a tire is its free radius minus a third of its deflection.
      wheel.motion.spin_rate = state.speed / (radius - std::max(0.0, radius - z) / 3.0);
      wheel.tire = tires_[at(corner)]->clone();
      const auto hub = wheel.tire->settle(wheel.motion, road, 0.0);
      if (!hub)
        return Failure{no_stand(corner, hub.failure().reason).reason + "; " +
                       sunk(rest, lines, state.speed)};
      wheel.hub = *hub;
      const double force = (wheel.motion.carrier * hub->force).z();
      worst = std::max(worst, std::abs(line.force + line.stiffness * (line.height - z) - force));
      if (force > 0.0) {
        ++touched;
        if (line.stiffness == 0.0)
          line.stiffness = touching[at(corner)];
        else if (i > 0)
          line.stiffness = secant_of(force - line.force, line.height - z, line.stiffness);
        touching[at(corner)] = line.stiffness;
      } else if (stood_on > 2) {
        line.stiffness = 0.0;  // this tire is off the road while the other three carry the car
      }
      take(line, wheel);
      // If the arm of the longitudinal pull changes, its moment on the chassis changes.
      constexpr double kArm = 1.0;  // m, arm that converts a moment to tire loads
      double& arm = state.trim.arm[at(corner)];
      const double was = std::exchange(arm, arm_over(road, wheel));
      worst = std::max(worst, std::abs(state.trim.along * (arm - was)) / kArm);
    }
    // The rounds end when the error is below the accuracy of the tires, or when a round no longer
    // halves it.
    if (i > 0 && worst < kEnough * weight) break;
    if (i > 0 && worst < kUsual * weight && worst > 0.5 * before) break;
  }
  if (worst < 1e-3 * weight) return rest;
  return Failure{
      fmt::format("the car finds no rest on its tires: {:.3g} N are left of {:.4g} N; {}",
                  worst,
                  weight,
                  sunk(rest, lines, state.speed))};
}

Result<Rest> Car::roll_in(CarState& state,
                          LineTires& lines,
                          const Rest& start,
                          const road::Road& road,
                          const CarInputs& inputs) {
  Rest rest = start;
  for (int rounds = RollIn::kRounds;; rounds *= 2) {
    std::array<double, kCorners> falling{};
    auto rolled = roll_rounds(rounds, state, lines, rest, road, inputs, falling);
    if (!rolled) return rolled;
    rest = std::move(*rolled);
    const auto most = std::max_element(falling.begin(), falling.end());
    if (*most == 0.0) return rest;
    const double round = RollIn(state.speed).duration * state.speed;  // m, path of a round
    if (rounds >= RollIn::kMostRounds)
      return Failure{fmt::format(
          "the tire {} is not steady after {:.3g} m of free rolling: its force still changes by "
          "{:.3g} N in {:.2g} m; its relaxation length (slip stiffness over carcass stiffness) is "
          "too large under its load of {:.4g} N",
          kCornerNames[most - falling.begin()],
          rounds * round,
          *most,
          0.5 * round,
          lines[at(static_cast<int>(most - falling.begin()))].force)};
  }
}

Result<Rest> Car::start_steadily(CarState& state,
                                 LineTires& lines,
                                 const Rest& start,
                                 const road::Road& road,
                                 const CarInputs& inputs) {
  constexpr int kMost = 12;
  constexpr double kEnough = 1e-5;  // change of a tire load, relative to the car's weight
  const RollIn way(state.speed);
  const double weight = mechanism_->mass() * parameters_.gravity, h = way.duration / way.steps;
  const Eigen::VectorXd rates = straight_on(mechanism_->bodies().size(), state.speed);
  Rest rest = start;
  double worst = 0.0;
  for (int round = 0; round < kMost; ++round) {
    worst = 0.0;
    for (int corner = 0; corner < kCorners; ++corner) {
      WheelState& wheel = state.wheels[at(corner)];
      LineTire& line = lines[at(corner)];
      WheelMotion there = motion_of_wheel(corner, rest.poses, &rates);
      const Vector3d center = there.center;
      const road::PlaneRoad level{{.height = road.height(center.x(), center.y(), 0.0)}};
      there.spin_rate = wheel.motion.spin_rate;
      wheel.wheel.spin->rate = there.spin_rate;
      wheel.tire = tires_[at(corner)]->clone();
      auto hub = wheel.tire->settle(there, level, 0.0);
      if (hub) hub = wheel.tire->advance_free(there, wheel.wheel, level, 0.0, h);
      if (!hub) return no_stand(corner, hub.failure().reason);
      wheel.hub = *hub;
      wheel.motion = there;
      const double force = (there.carrier * hub->force).z();
      worst = std::max(worst,
                       std::abs(line.force + line.stiffness * (line.height - center.z()) - force));
      take(line, wheel);
      state.trim.arm[at(corner)] = center.z() - level.height(0.0, 0.0, 0.0);
    }
    if (round > 0 && worst < kEnough * weight) return rest;
    auto stood = stand(lines, state.speed, inputs, rest, state.trim);
    if (!stood) return stood;
    rest = std::move(*stood);
  }
  return Failure{fmt::format(
      "the car does not come to rest on tires in their steady states: a tire load still changes by "
      "{:.3g} N of the {:.4g} N of its weight",
      worst,
      weight)};
}

Result<Rest> Car::roll_rounds(int rounds,
                              CarState& state,
                              LineTires& lines,
                              const Rest& start,
                              const road::Road& road,
                              const CarInputs& inputs,
                              std::array<double, kCorners>& falling) {
  constexpr double kSteady = 1e-6;  // range of force in half a round, relative to the weight
  const RollIn way(state.speed);
  const double speed = state.speed, h = way.duration / way.steps;
  const Eigen::VectorXd rates = straight_on(mechanism_->bodies().size(), speed);
  std::array<FallingRanges, kCorners> ranges;
  Rest rest = start;
  for (int corner = 0; corner < kCorners; ++corner) {
    WheelState& wheel = state.wheels[at(corner)];
    const road::PlaneRoad level{
        {.height = road.height(wheel.motion.center.x(), wheel.motion.center.y(), 0.0)}};
    const double whole = way.duration * rounds;
    wheel.motion.center.x() -= speed * whole;
    wheel.tire = tires_[at(corner)]->clone();
    if (const auto hub = wheel.tire->settle(wheel.motion, level, -whole); !hub)
      return no_stand(corner, hub.failure().reason);
  }
  for (int round = 0; round < rounds; ++round) {
    if (round >= RollIn::kHeld) {
      // A tire that rolls carries its wheel at another height than the tire at rest.
      for (int corner = 0; corner < kCorners; ++corner) {
        const Vector3d center = motion_of_wheel(corner, rest.poses, &rates).center;
        state.trim.arm[at(corner)] =
            lines[at(corner)].height - road.height(center.x(), center.y(), 0.0);
      }
      auto stood = stand(lines, state.speed, inputs, rest, state.trim);
      if (!stood) return stood;
      rest = std::move(*stood);
    }
    for (int corner = 0; corner < kCorners; ++corner) {
      WheelState& wheel = state.wheels[at(corner)];
      const WheelMotion end = motion_of_wheel(corner, rest.poses, &rates);
      const road::PlaneRoad level{{.height = road.height(end.center.x(), end.center.y(), 0.0)}};
      const Vector3d from = wheel.motion.center;
      HubForces mean;  // mean forces over the second half of the round, which contains no transient
      // Mean height of the wheel center over the same time, at which the linearized tire has these
      // forces, m.
      double height = 0.0;
      for (int i = 1; i <= way.steps; ++i) {
        const double left = way.duration * (rounds - 1 - round) + h * (way.steps - i);
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
        const int first_half = way.steps / 2;  // number of its steps, rounded down
        const double share = 1.0 / (way.steps - first_half);
        height += share * there.center.z();
        mean.force += share * hub->force;
        mean.moment += share * hub->moment;
        ranges[at(corner)].add(hub->force);
      }
      ranges[at(corner)].end_round();
      std::swap(wheel.hub, mean);
      take(lines[at(corner)], wheel);
      lines[at(corner)].height = height;
      std::swap(wheel.hub, mean);
    }
  }
  const double least = kSteady * mechanism_->mass() * parameters_.gravity;
  for (int corner = 0; corner < kCorners; ++corner)
    falling[at(corner)] = ranges[at(corner)].still_falling(least);
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
    const bool steady =
        std::ranges::all_of(tires_, [](const auto& tire) { return tire->starts_steadily(); });
    rest = steady ? start_steadily(state, lines, *rest, road, inputs)
                  : roll_in(state, lines, *rest, road, inputs);
    if (!rest) return rest.failure();
  }
  const GuidePoint start = inputs.guide.value_or(GuidePoint{0.0, speed, 0.0});
  // The guide's constant forces are those that it bore in equilibrium, minus the forces of its
  // springs.
  const Vector3d off = off_guide(rest->poses[at(parts_.chassis)], {0.0, 0.0, start.y});
  state.trim.along += guide.along * off.x();
  state.trim.lateral = (1.0 - kStill) * guide.lateral * off.y();
  state.trim.yaw = (1.0 - kStill) * guide.yaw * off.z();
  state.rack = inputs.rack;
  state.loads = inputs.loads;
  const multibody::Outside outside = [&](const Motion& motion, std::vector<BodyForce>& wrenches) {
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
