// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/lift_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "models/tire/free_wheel.h"
#include "models/tire/tared_tire.h"

namespace latsch {
namespace {

/// Passes every call to a tire and reports the load at the end of each step to a log.
class WatchedTire final : public Tire {
 public:
  WatchedTire(std::unique_ptr<Tire> tire, LiftLog& log) : tire_(std::move(tire)), log_(log) {}

  double free_radius() const override { return tire_->free_radius(); }
  Result<HubForces> settle(const WheelMotion& motion,
                           const road::Road& road,
                           double time) override {
    return tire_->settle(motion, road, time);
  }
  Result<HubForces> advance(const WheelMotion& motion,
                            const road::Road& road,
                            double time,
                            double step) override {
    return seen(tire_->advance(motion, road, time, step), motion, time, step);
  }
  Result<HubForces> advance_free(WheelMotion& motion,
                                 FreeWheel& wheel,
                                 const road::Road& road,
                                 double time,
                                 double step) override {
    auto hub = tire_->advance_free(motion, wheel, road, time, step);
    return seen(std::move(hub), motion, time, step);
  }
  std::optional<Footprint> footprint() const override { return tire_->footprint(); }
  std::optional<double> road_load() const override { return tire_->road_load(); }
  bool starts_steadily() const override { return tire_->starts_steadily(); }
  Eigen::Matrix3Xd outline() const override { return tire_->outline(); }
  std::unique_ptr<Tire> clone() const override {
    return std::make_unique<WatchedTire>(tire_->clone(), log_);
  }

 private:
  Result<HubForces> seen(Result<HubForces> hub,
                         const WheelMotion& motion,
                         double time,
                         double step) {
    if (!hub || step == 0.0) return hub;
    if (const auto load = tire_->road_load())
      log_.see(time, step, *load, (motion.carrier * hub->force).z());
    return hub;
  }

  std::unique_ptr<Tire> tire_;
  LiftLog& log_;
};

}  // namespace

void LiftLog::see(double time, double step, double load, double hub_Fz) {
  const bool was_off = std::exchange(off_, !(load > 0.0));
  if (!off_) return;
  if (!was_off) ++lifts_;
  first_ = total_ == 0.0 ? time - step : std::min(first_, time - step);
  last_ = total_ == 0.0 ? time : std::max(last_, time);
  total_ += step;
  hub_least_ = std::min(hub_least_, hub_Fz);
  hub_most_ = std::max(hub_most_, hub_Fz);
}

std::string LiftLog::sentence() const {
  if (lifts_ == 0) return "";
  const bool is_massless = hub_least_ == 0.0 && hub_most_ == 0.0;
  return fmt::format(
      "the tire leaves the road, {} time{} between {:.4g} and {:.4g} s, for {:.4g} ms in all; Fz "
      "there is {}, and slip and slip angle mean nothing",
      lifts_,
      lifts_ == 1 ? "" : "s",
      first_ + 0.0,
      last_ + 0.0,
      1e3 * total_,
      is_massless
          ? std::string("0")
          : fmt::format("that of the belt's inertia on the hub, {:.4g} to {:.4g} N, no load "
                        "of the road",
                        hub_least_,
                        hub_most_));
}

std::unique_ptr<Tire> watched(std::unique_ptr<Tire> tire, LiftLog& log) {
  return std::make_unique<WatchedTire>(tared(std::move(tire)), log);
}

}  // namespace latsch
