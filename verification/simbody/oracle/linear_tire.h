// SPDX-License-Identifier: Apache-2.0
// A tire as a vertical spring and damper at the wheel center, over the road that passes below it at
// the car's speed v:
//   F = k (R - (z_c - h)) + c (h' - z_c'),   h = h(x_c + v t),   h' = dh/ds (v + x_c')     F > 0
// R is the free radius, x_c and z_c are the position of the wheel center, h is the height of the
// road.
#pragma once

#include <Simbody.h>

#include <algorithm>

#include "oracle_case.h"

namespace oracle {

class LinearTire : public SimTK::Force::Custom::Implementation {
 public:
  LinearTire(const SimTK::MobilizedBody& wheel,
             const SimTK::Vec3& center,
             const TireData& data,
             const RoadData& road,
             double speed)
      : wheel_(wheel),
        center_(center),
        data_(data),
        road_(road.is_under(data.wheel_center[1]) ? road : RoadData()),
        speed_(speed) {}

  void calcForce(const SimTK::State& state,
                 SimTK::Vector_<SimTK::SpatialVec>& bodies,
                 SimTK::Vector_<SimTK::Vec3>&,
                 SimTK::Vector&) const override {
    const SimTK::Vec3 at = wheel_.findStationLocationInGround(state, center_);
    const SimTK::Vec3 rate = wheel_.findStationVelocityInGround(state, center_);
    const double s = at[0] + speed_ * state.getTime();
    const double rise = road_.slope_at(s) * (speed_ + rate[0]);
    const double F = data_.stiffness * (data_.radius - (at[2] - road_.height_at(s))) +
                     data_.damping * (rise - rate[2]);
    wheel_.applyForceToBodyPoint(state, center_, {0, 0, std::max(F, 0.0)}, bodies);
  }

  SimTK::Real calcPotentialEnergy(const SimTK::State& state) const override {
    const SimTK::Vec3 at = wheel_.findStationLocationInGround(state, center_);
    const double s = at[0] + speed_ * state.getTime();
    const double pressed = std::max(data_.radius - (at[2] - road_.height_at(s)), 0.0);
    return 0.5 * data_.stiffness * pressed * pressed;
  }

 private:
  SimTK::MobilizedBody wheel_;
  SimTK::Vec3 center_;  // center of the wheel, in the axes of its body
  TireData data_;
  RoadData road_;
  double speed_;
};

}  // namespace oracle
