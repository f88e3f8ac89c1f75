// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/drum_rig.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "experiment/rigs/duration_limit.h"
#include "models/road/drum_road.h"
#include "models/tire/free_wheel.h"

namespace latsch::experiment {
namespace {

constexpr double kFirstStiffness = 2.0e5;  // N/m, for a first guess of the deflection
// largest first guess of the deflection, as a share of the radius
constexpr double kFirstShare = 0.25;
constexpr double kWidestTire = 0.8;  // half width of the widest tire over its radius
constexpr double kFastest = 200.0;   // m/s; a larger value means that the file uses another unit

road::DrumRoad::Settings drum_of(const DrumTest& test) {
  road::DrumRoad::Settings settings;
  settings.diameter = test.diameter;
  settings.surface = test.speed;
  if (test.cleat) {
    const Cleat& cleat = *test.cleat;
    // The cleat is below the axle at time 0; before, its distance is the remaining travel of the
    // drum's surface.
    settings.cleats = {{.profile = road::cleat_profile(cleat.height, cleat.length, cleat.bevel),
                        .starting_angle = 0.0,
                        .angle = cleat.angle}};
  }
  return settings;
}

WheelMotion standing(double height, const Eigen::Matrix3d& carrier) {
  WheelMotion motion;
  motion.center.z() = height;
  motion.carrier = carrier;
  return motion;
}

/// Returns the rate, 1/s, with which the wheel's speed is kept at its initial value, `time` before
/// the cleat is below the axle. The first guess of the speed has an error of a percent; a wheel
/// that is released at once would oscillate on its tread for half a second. If it is released
/// slowly, it reaches its own speed without oscillation.
double run_in_hold(const DrumTest& test, double time) {
  constexpr double kFirst = 100.0;  // 1/s; about critical damping for 10 to 40 Hz
  const double left = (-time - test.lead) / test.run_in;
  return left > 0.0 && left <= 1.0 ? kFirst * left * left : 0.0;
}

/// Returns the mean of several records with the same times.
Channels mean(const std::vector<Channels>& records) {
  if (records.size() == 1) return records.front();
  Channels mean;
  for (Channel channel : records.front().all()) {
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      double sum = 0.0;
      for (const Channels& record : records) sum += record[channel.name][i];
      channel.values[i] = sum / static_cast<double>(records.size());
    }
    mean.add(std::move(channel));
  }
  return mean;
}

struct Surfaces {
  explicit Surfaces(const DrumTest& test)
      : drum(drum_of(test)), smooth({.diameter = test.diameter, .surface = test.speed}) {}
  road::DrumRoad drum, smooth;
};

/// A tire on the drum and its wheel, starting at rest under its load.
class Passage {
 public:
  Passage(Tire& tire, const DrumTest& test, const Surfaces& surfaces, const WheelMotion& start)
      : tire_(tire), test_(test), surfaces_(surfaces), motion_(start) {
    // A belt of fixed length rolls with nearly its free radius; the wheel finds the exact speed
    // itself.
    const double deflection = tire.free_radius() - start.center.z();
    motion_.spin_rate = test.speed / (tire.free_radius() - 0.35 * deflection);
  }

  Result<Channels> run() {
    auto hub = tire_.settle(motion_, surfaces_.smooth, 0.0);
    if (!hub) return hub.failure();
    const double rolled = motion_.spin_rate, inertia = test_.wheel_inertia;
    FreeWheel wheel;
    wheel.spin = {.inertia = inertia,
                  .place = motion_.spin,
                  .rate = rolled,
                  .acceleration = hub->moment.y() / inertia,
                  .push = [this, inertia, rolled](double time, double rate) -> Push {
                    const double hold = inertia * run_in_hold(test_, time);
                    return {-hold * (rate - rolled), -hold};
                  }};
    const long first = std::lround((test_.run_in + test_.lead) / test_.step);
    const long every = std::lround(test_.sample_step / test_.step);
    const long lead = std::lround(test_.lead / test_.step);
    const long last = std::lround((test_.duration - test_.lead) / test_.step);
    ForceRecord forces(test_.frames);
    std::vector<double> times, speeds, wheel_speeds;
    for (long i = -first + 1; i <= last; ++i) {
      hub = advance(wheel, static_cast<double>(i) * test_.step);
      if (!hub) return hub.failure();
      if (i <= -lead || (i + lead) % every != 0) continue;
      times.push_back(static_cast<double>(i) * test_.step);
      forces.add(*hub, motion_);
      speeds.push_back(test_.speed);
      wheel_speeds.push_back(motion_.spin_rate);
    }
    Channels record;
    record.add({"time", "s", std::move(times)});
    forces.add_to(record);
    record.add({"speed", "m/s", std::move(speeds)});
    record.add({"wheel_speed", "rad/s", std::move(wheel_speeds)});
    return record;
  }

 private:
  Result<HubForces> advance(FreeWheel& wheel, double time) {
    // If the cleat is far from the axle it cannot touch the tire, and the smooth drum is faster to
    // compute.
    const double radius = tire_.free_radius();
    const double reach =
        std::max(0.5 * radius + 0.5, reach_of_cleat(test_, radius, kWidestTire * radius));
    const bool away = std::abs(time) * test_.speed > reach;
    return tire_.advance_free(
        motion_, wheel, away ? surfaces_.smooth : surfaces_.drum, time, test_.step);
  }

  Tire& tire_;
  const DrumTest& test_;
  const Surfaces& surfaces_;
  WheelMotion motion_;
};

}  // namespace

DrumTest read_drum_test(const Node& root, const MeasuredConditions& measured) {
  root.choice("kind", {"drum_cleat"});
  DrumTest test;
  const auto speed = find_measured(root, "speed"), load = find_measured(root, "load");
  test.speed = speed ? measured_mean(*speed, {"Vx", "m/s"}, measured)
                     : root.quantity("speed", "m/s", {0.0, kFastest, true});
  if (root.has("load") == root.has("deflection"))
    root.reject("load", "or deflection is required, exactly one of the two");
  if (root.has("load"))
    test.load = load ? measured_mean(*load, {"Fz", "N", true, "W"}, measured)
                     : root.quantity("load", "N", Range::positive());
  if (root.has("deflection")) test.deflection = root.quantity("deflection", "m", Range::positive());
  test.pressure = read_pressure(root, measured);
  test.camber = root.quantity("camber", "rad", Range::between(-0.5, 0.5), 0.0);
  test.diameter = root.quantity("drum_diameter", "m", Range::between(0.2, 100.0));
  test.wheel_inertia = root.quantity("wheel_inertia", "kg m^2", Range::positive(), 1.0);
  test.run_in = root.quantity("run_in", "s", Range::not_negative(), test.run_in);
  test.duration = root.quantity("duration", "s", Range::positive(), test.duration);
  test.lead = root.quantity("lead", "s", Range::not_negative(), test.lead);
  test.step = root.quantity("step", "s", Range::between(kShortestStep, 0.01), test.step);
  check_step(root, test.speed, test.step);
  test.sample_step = root.quantity("sample_step", "s", {0.0, 0.1, true}, test.step);
  for (const auto& [key, seconds] :
       {std::pair("run_in", test.run_in), {"duration", test.duration}, {"lead", test.lead}})
    check_duration(root, key, seconds, test.step);
  test.passages = static_cast<int>(root.integer("passages", 1, 100, 1));
  test.wheel_step = root.quantity("wheel_step", "rad", {}, 0.0);
  test.wheel_start = root.quantity("wheel_start", "rad", {}, 0.0);
  test.frames = read_frames(root, test.frames);
  const double ratio = test.sample_step / test.step;
  if (std::abs(ratio - std::round(ratio)) > 1e-6 || ratio < 0.5)
    root.reject("sample_step", "is no multiple of step");
  // rad; at larger angles the bar lies along the circumference of the drum
  constexpr double kWidest = 1.4;
  test.cleat = read_cleat(root, kWidest);
  if (test.cleat && test.speed * test.step > test.cleat->length * (1.0 + 1e-9))
    root.reject("step",
                fmt::format("moves the tire {:.3g} mm at {:.3g} km/h, over a cleat of {:.3g} mm at "
                            "once; expected at most {:.3g} ms",
                            1e3 * test.speed * test.step,
                            3.6 * test.speed,
                            1e3 * test.cleat->length,
                            1e3 * test.cleat->length / test.speed));
  if (const std::string fault = road::DrumRoad::fault(drum_of(test)); !fault.empty())
    root.reject("cleat", "does not fit the drum: " + fault);
  if (2.0 * test.sample_step > test.duration)
    root.reject("sample_step",
                fmt::format("leaves less than two samples of {:.4g} s: expected a shorter one",
                            test.duration));
  if (test.cleat && test.duration <= test.lead)
    root.reject(root.has("duration") ? "duration" : "lead",
                fmt::format("ends the record before the cleat is below the axle: {:g} s are "
                            "recorded, {:g} s of them ahead of it; make duration longer or lead "
                            "shorter",
                            test.duration,
                            test.lead));
  root.close();
  return test;
}

double reach_of_cleat(const DrumTest& test, double free_radius, double half_width) {
  if (!test.cleat) return 0.0;
  const double expected =
      std::min(test.load.value_or(0.0) / kFirstStiffness, kFirstShare * free_radius);
  const double depth = test.deflection.value_or(expected) + test.cleat->height;
  const double chord = std::sqrt(2.0 * free_radius * depth);
  const double slope = std::tan(std::abs(test.cleat->angle));
  return chord + half_width * slope + 0.5 * test.cleat->length / std::cos(test.cleat->angle);
}

void check_step(const Node& test, double speed, double step) {
  if (speed * step <= kFarthestStep * (1.0 + 1e-9)) return;
  test.reject("step",
              fmt::format("moves the tire {:.3g} mm at {:.3g} km/h, expected at most {:.3g} mm",
                          1e3 * speed * step,
                          3.6 * speed,
                          1e3 * kFarthestStep));
}

Result<double> height_under_load(Tire& tire,
                                 const road::Road& road,
                                 const Eigen::Matrix3d& carrier,
                                 double load) {
  constexpr int kMost = 12;
  constexpr double kClose = 1e-5;  // share of the load
  const double free = tire.free_radius();
  const auto failure = [&](double height, const std::string& why) {
    return Failure{
        fmt::format("no height of the axle was found under a load of {:g} N: pressed by "
                    "{:.3g} mm {}; is it a load this tire can carry?",
                    load,
                    1e3 * (free - height),
                    why)};
  };
  double z0 = free, F0 = 0.0, z = z0 - std::min(load / kFirstStiffness, kFirstShare * free);
  for (int i = 0; i < kMost; ++i) {
    const auto hub = tire.settle(standing(z, carrier), road, 0.0);
    if (!hub && z != z0 && i + 1 < kMost) {  // the guess was too deep
      z = 0.5 * (z + z0);
      continue;
    }
    if (!hub) return failure(z, "it has no state of rest (" + hub.failure().reason + ")");
    const double F = (carrier * hub->force).z();
    if (std::abs(F - load) <= kClose * load) {
      const Status fit = check_depth(tire, free - z);
      if (!fit) return failure(z, "it has no state of rest (" + fit.failure().reason + ")");
      return z;
    }
    const double slope = z != z0 && F != F0 ? (F - F0) / (z - z0) : -kFirstStiffness;
    z0 = z;
    F0 = F;
    z += std::clamp((load - F) / std::min(slope, -0.1 * kFirstStiffness), -0.02, 0.02);
  }
  return failure(z0, fmt::format("it carries {:.4g} N", F0));
}

Result<Channels> run(Tire& tire, const DrumTest& test) {
  const Surfaces surfaces(test);
  WheelMotion start =
      standing(tire.free_radius() - test.deflection.value_or(0.0),
               Eigen::AngleAxisd(test.camber, Eigen::Vector3d::UnitX()).toRotationMatrix());
  if (const Status fit = check_depth(tire, test.deflection.value_or(0.0)); !fit)
    return Failure{"on the drum: " + fit.failure().reason};
  if (test.load) {
    const auto height = height_under_load(tire, surfaces.smooth, start.carrier, *test.load);
    if (!height) return height.failure();
    start.center.z() = *height;
  }
  std::vector<Channels> passages;
  for (int k = 0; k < test.passages; ++k) {
    start.spin = test.wheel_start + k * test.wheel_step;
    auto record = Passage(tire, test, surfaces, start).run();
    if (!record) return Failure{"on the drum: " + record.failure().reason};
    passages.push_back(std::move(*record));
  }
  return mean(passages);
}

}  // namespace latsch::experiment
