// SPDX-License-Identifier: Apache-2.0
#include "models/tire/tared_tire.h"

#include <cmath>
#include <utility>

#include "models/road/plane_road.h"
#include "models/tire/free_wheel.h"

namespace latsch {
namespace {

/// Passes every call to a tire and adds the weight to the force on the hub.
class TaredTire final : public Tire {
 public:
  TaredTire(std::unique_ptr<Tire> tire, double weight) : tire_(std::move(tire)), weight_(weight) {}

  double free_radius() const override { return tire_->free_radius(); }
  Result<HubForces> settle(const WheelMotion& motion,
                           const road::Road& road,
                           double time) override {
    return without_weight(tire_->settle(motion, road, time), motion);
  }
  Result<HubForces> advance(const WheelMotion& motion,
                            const road::Road& road,
                            double time,
                            double step) override {
    return without_weight(tire_->advance(motion, road, time, step), motion);
  }
  /// The tared force also acts on an axle that is free to move vertically.
  Result<HubForces> advance_free(WheelMotion& motion,
                                 FreeWheel& wheel,
                                 const road::Road& road,
                                 double time,
                                 double step) override {
    if (!wheel.height)
      return without_weight(tire_->advance_free(motion, wheel, road, time, step), motion);
    const auto push = wheel.height->push;
    wheel.height->push = [push, weight = weight_](double at, double rate) -> Push {
      Push all = push ? push(at, rate) : Push{};
      all.value += weight;
      return all;
    };
    const Result<HubForces> hub = tire_->advance_free(motion, wheel, road, time, step);
    wheel.height->push = push;
    return without_weight(hub, motion);
  }
  std::optional<Footprint> footprint() const override { return tire_->footprint(); }
  std::optional<double> road_load() const override { return tire_->road_load(); }
  bool starts_steadily() const override { return tire_->starts_steadily(); }
  Eigen::Matrix3Xd outline() const override { return tire_->outline(); }
  std::unique_ptr<Tire> clone() const override {
    return std::make_unique<TaredTire>(tire_->clone(), weight_);
  }

 private:
  Result<HubForces> without_weight(Result<HubForces> hub, const WheelMotion& motion) const {
    if (hub) hub->force += weight_ * motion.carrier.row(2).transpose();
    return hub;
  }

  std::unique_ptr<Tire> tire_;
  double weight_;  // N
};

}  // namespace

double weight_in_air(const Tire& tire) {
  constexpr double kClearance = 1.0;  // m, distance from the tread to the ground
  constexpr double kLeast = 1e-3;     // N; a smaller weight is rounding of a belt without weight
  WheelMotion hung;
  hung.center.z() = tire.free_radius() + kClearance;
  const auto hub = tire.clone()->settle(hung, road::PlaneRoad(), 0.0);
  if (!hub || std::abs(hub->force.z()) < kLeast) return 0.0;
  return -hub->force.z();
}

std::unique_ptr<Tire> tared(std::unique_ptr<Tire> tire) {
  const double weight = weight_in_air(*tire);
  if (weight == 0.0) return tire;
  return std::make_unique<TaredTire>(std::move(tire), weight);
}

}  // namespace latsch
