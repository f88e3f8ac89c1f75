// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/flat_track.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "experiment/rigs/drum_rig.h"
#include "models/road/plane_road.h"
#include "models/tire/free_wheel.h"

namespace latsch::experiment {
namespace {

constexpr double kWheelInertia = 1.0;      // kg m^2, of the wheel that rolls up to its free speed
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
    double free_rate = motion_.spin_rate;
    for (long i = 1; i <= free_ + entry_ + swept_; ++i) {
      if (i > free_) {
        wheel.spin.reset();
        steer_and_brake(static_cast<double>(i), free_rate);
      }
      const double time = static_cast<double>(i) * sweep_.step;
      hub = tire_.advance_free(motion_, wheel, belt_, time, sweep_.step);
      if (!hub) return hub.failure();
      if (i <= free_) free_rate = motion_.spin_rate;
      if (i > free_ + entry_) add(time, *hub);
    }
    return channels();
  }

 private:
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
