// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/flat_track.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "experiment/rigs/drum_rig.h"
#include "experiment/rigs/steady_rolling.h"
#include "models/road/plane_road.h"
#include "models/tire/free_wheel.h"

namespace latsch::experiment {
namespace {

// Inertia, kg m^2, of the wheel that rolls freely before the sweep; a light wheel oscillates fast
// about its free speed.
constexpr double kWheelInertia = 0.25;
constexpr double kFollow = 20e-3;          // s, time constant with which the axle follows the load
constexpr double kLeastDeflection = 1e-3;  // m

/// Carrier yawed relative to the belt: with the heading turned right by α the belt moves the wheel
/// to the left of its heading.
Eigen::Matrix3d carrier_at(double alpha, double camber) {
  return (Eigen::AngleAxisd(-alpha, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(camber, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/// Returns a number that rises from 0 to 1 over `count` steps after the first `first` steps.
double ramp(double step, double first, double count) {
  return std::clamp((step - first) / count, 0.0, 1.0);
}

class Track {
 public:
  Track(Tire& tire, const SlipSweep& sweep, double height)
      : tire_(tire),
        sweep_(sweep),
        free_(std::lround(sweep.run_in / sweep.step)),
        entry_(std::lround(0.5 * sweep.run_in / sweep.step)),
        swept_(std::lround(sweep.duration / sweep.step)),
        belt_({.belt = sweep.speed}),
        forces_(sweep.frames) {
    const double deflection = std::max(tire.free_radius() - height, kLeastDeflection);
    resistance_ = kFollow * sweep.load / deflection;
    motion_.carrier = carrier_at(0.0, sweep.camber);
    motion_.center.z() = height;
    motion_.spin_rate = sweep.speed / (tire.free_radius() - 0.35 * deflection);
  }

  Result<Channels> run() {
    auto hub = tire_.settle(motion_, belt_, 0.0);
    if (!hub) return hub.failure();
    FreeWheel wheel;
    if (sweep_.axle == AxleHold::load) wheel.height = axle(*hub);
    wheel.spin = {.inertia = kWheelInertia,
                  .place = motion_.spin,
                  .rate = motion_.spin_rate,
                  .acceleration = hub->moment.y() / kWheelInertia};
    if (const Status done = roll_freely(wheel); !done) return done.failure();
    const double free_rate = motion_.spin_rate;
    wheel.spin.reset();
    const long asked = free_ + entry_ + swept_;
    const auto turn =
        static_cast<std::size_t>(std::max(2L, steps_of(kTwoPi * tire_.free_radius())));
    for (long i = free_ + 1; i <= asked || !is_steady(turn); ++i) {
      if (i > asked + steps_of(kFarthestToSteady)) return not_steady(turn);
      steer_and_brake(static_cast<double>(std::min(i, asked)), free_rate);
      hub = tire_.advance_free(motion_, wheel, belt_, time_of(i), sweep_.step);
      if (!hub) return hub.failure();
      if (i > free_ + entry_) add(static_cast<double>(i) * sweep_.step, *hub);
    }
    return channels();
  }

 private:
  static constexpr double kTwoPi = 2.0 * std::numbers::pi;

  long steps_of(double way) const { return std::lround(way / sweep_.speed / sweep_.step); }
  /// Returns the time of a step, with the way that was rolled beyond the run-in.
  double time_of(long step) const { return static_cast<double>(step + beyond_) * sweep_.step; }

  /// Rolls until the longitudinal force varies as the tire itself makes it vary.
  Status roll_freely(FreeWheel& wheel) {
    constexpr double kShare = 0.02, kLeast = 1e-4;  // shares of the range and of the load
    constexpr double kShortest = 0.5;               // m, of a stretch
    const long stretch = std::max({free_ / 2, steps_of(kShortest), 1L});
    FallingRange range;
    bool has_settled = false;
    for (long i = 1; i <= free_ || !has_settled; ++i) {
      if (i > free_ + steps_of(kFarthestToSteady))
        return Failure{
            fmt::format("the free wheel still swings after {:g} m, so that slips have no "
                        "reference; a longer run_in does not help if it never settles",
                        kFarthestToSteady)};
      beyond_ = std::max(0L, i - free_);
      const double time = static_cast<double>(i) * sweep_.step;
      const auto hub = tire_.advance_free(motion_, wheel, belt_, time, sweep_.step);
      if (!hub) return hub.failure();
      range.add(hub->force.x());
      if (i % stretch == 0) has_settled = range.has_settled(kShare, kLeast * sweep_.load);
    }
    return {};
  }

  /// True if the means of the forces that have to be steady have reached their limits.
  bool is_steady(std::size_t turn) const {
    constexpr double kLeft = 5e-4, kLeast = 1e-6;  // share of the force, of the load (N or N m)
    return std::ranges::all_of(sweep_.steady, [&](const std::string& name) {
      const std::vector<double>& force = forces_.of(name);
      if (force.size() < 2 * turn) return false;
      const double mean =
          std::accumulate(force.end() - static_cast<std::ptrdiff_t>(turn), force.end(), 0.0) /
          static_cast<double>(turn);
      return left_to_limit(force, turn) <= kLeft * std::abs(mean) + kLeast * sweep_.load;
    });
  }

  Failure not_steady(std::size_t turn) const {
    std::string text;
    for (const std::string& name : sweep_.steady)
      text += fmt::format(
          "{}{} by {:.2g}", text.empty() ? "" : ", ", name, left_to_limit(forces_.of(name), turn));
    return {
        fmt::format("the forces are not steady after {:g} m at one slip; a limit that they "
                    "approach is still off: {} (N or N m)",
                    kFarthestToSteady,
                    text)};
  }

  /// The resistance follows from the deflection of the standing tire under the load.
  FreeRate axle(const HubForces& hub) const {
    const double c = resistance_, load = sweep_.load;
    return {.place = motion_.center.z(),
            .rate = ((motion_.carrier * hub.force).z() - load) / c,
            .push = [c, load](double, double rate) -> Push {
              return {-load - c * rate, -c};
            }};
  }

  void steer_and_brake(double step, double free_rate) {
    const double entry = ramp(step, free_, entry_), share = ramp(step, free_ + entry_, swept_);
    alpha_ = entry * (sweep_.alpha_from + share * (sweep_.alpha_to - sweep_.alpha_from));
    kappa_ = entry * (sweep_.kappa_from + share * (sweep_.kappa_to - sweep_.kappa_from));
    motion_.carrier = carrier_at(alpha_, sweep_.camber);
    const double rate = free_rate * (1.0 + kappa_) * std::cos(alpha_);
    motion_.spin += 0.5 * sweep_.step * (motion_.spin_rate + rate);
    motion_.spin_rate = rate;
  }

  void add(double time, const HubForces& hub) {
    forces_.add(hub, motion_);
    times_.push_back(time);
    alphas_.push_back(alpha_);
    kappas_.push_back(kappa_);
    loaded_radii_.push_back(motion_.center.z() / std::cos(sweep_.camber));
  }

  Channels channels() const {
    Channels channels;
    channels.add({"time", "s", times_});
    channels.add({"alpha", "rad", alphas_});
    channels.add({"kappa", "1", kappas_});
    forces_.add_to(channels);
    channels.add({"loaded_radius", "m", loaded_radii_});
    return channels;
  }

  Tire& tire_;
  const SlipSweep& sweep_;
  long free_, entry_, swept_;  // steps: of free rolling, to the first slip, of the sweep
  long beyond_ = 0;            // steps rolled freely beyond free_
  road::PlaneRoad belt_;
  double resistance_ = 0.0;  // N s/m
  WheelMotion motion_;
  double alpha_ = 0.0, kappa_ = 0.0;
  ForceRecord forces_;
  std::vector<double> times_, alphas_, kappas_, loaded_radii_;
};

}  // namespace

Result<Channels> run(Tire& tire, const SlipSweep& sweep) {
  const auto height =
      height_under_load(tire, road::PlaneRoad(), carrier_at(0.0, sweep.camber), sweep.load);
  if (!height) return height.failure();
  auto channels = Track(tire, sweep, *height).run();
  if (!channels) return Failure{"on the flat track: " + channels.failure().reason};
  return channels;
}

}  // namespace latsch::experiment
