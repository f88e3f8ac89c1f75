// SPDX-License-Identifier: Apache-2.0
// The finite-element tire as a tire that rolls (models/tire/tire.h).
//
//   settle     presses the tire on the plane of the road below it, without friction or rotation.
//   first step of a wheel that rolls: the steady state of its motion (rolling_tire.h), whatever the
//              length of the step. There is no run-in; a wheel whose spin is free begins with the
//              spin of its steady state, one whose height is free with the height of its load.
//   later ones steps of rolling_transient.h, no longer than the settings', so a longer step is made
//              in equal parts. Between two calls the wheel's velocity changes evenly. A step of
//              another length than the last costs a factorization.
//
// The road is felt by road_ground.h over a reference plane, that of the road where the tire
// settled: kerbs, ramps and hills are heights over it. A smooth drum below the axle is one
// (RollingCase::curvature). Friction is the tire's times the road's factor, its mean over nine
// places of 0.12 m by 0.08 m below the axle. A wheel that leaves the ground and comes back goes on.
//
// The free motions of a wheel (free_wheel.h): its spin follows the trapezoidal rule within each
// part of a step. Its height is found by trials of the whole step.
//
// Refused in words: a wheel that stands, moves backward or is locked, one that turns at less than a
// quarter of the spin at which it began, a drum with cleats or with the tire inside, a road that
// reaches the tread beyond the part that may touch. Not in it: the weight of the tire.
//
// Tires of one make (and their clones) share one workspace, which costs some hundred megabytes. A
// step begins from the tire's own state and with its own tangent, so its result does not depend on
// the others; but tires that take turns factorize each time. Two tires of one workspace wait for
// each other, tires of different ones do not.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/passage/tire_in_time.h"
#include "models/fe_tire/passage/wheel_on_plane.h"
#include "models/tire/free_wheel.h"
#include "models/tire/tire.h"

namespace latsch::fe_tire {

struct FeRollingSettings {
  RollingTransientSettings transient = {};
  /// Half angle of the tread that may touch, rad, and the hat's half width of (G.4), m; 0: the
  /// length of an element around the tread below the axle.
  double touching = 0.5, smooth = 0.0;
  /// Set: the tire is reduced about the steady state of its first motion (reduced_tire.h).
  std::optional<ReductionSettings> reduction = {};
};

class FeRollingTire final : public Tire {
 public:
  /// Friction of the tire at a speed, m/s, on a road with the factor 1.
  using Friction = std::function<RollingFriction(double speed)>;

  /// Makes a workspace with the mesh and the materials of a tire and these inflated shape and
  /// losses, of which any number of tires can be made.
  FeRollingTire(const FeTire& tire,
                const Inflated& inflated,
                LossMaterials losses,
                Friction friction,
                const FeRollingSettings& settings = {});
  ~FeRollingTire() override;
  FeRollingTire& operator=(const FeRollingTire&) = delete;

  double free_radius() const override;
  Result<HubForces> settle(const WheelMotion& motion, const road::Road& road, double time) override;
  Result<HubForces> advance(const WheelMotion& motion,
                            const road::Road& road,
                            double time,
                            double step) override;
  Result<HubForces> advance_free(WheelMotion& motion,
                                 FreeWheel& wheel,
                                 const road::Road& road,
                                 double time,
                                 double step) override;
  std::optional<Footprint> footprint() const override { return print_; }
  bool starts_steadily() const override { return true; }
  std::unique_ptr<Tire> clone() const override;

 private:
  struct Workspace;
  struct Memory;  // state of one tire, beside what the workspace holds for it
  FeRollingTire(const FeRollingTire& other);
  Result<HubForces> begin(WheelMotion& motion,
                          FreeWheel& wheel,
                          const road::Road& road,
                          double time);
  Result<HubForces> go_on(
      WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double step);
  Result<HubForces> go_on_at_free_height(
      WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double step);
  void hold();
  void take(const TransientForces& found);

  std::shared_ptr<Workspace> workspace_;
  std::unique_ptr<Memory> memory_;
  std::optional<Footprint> print_;
};

}  // namespace latsch::fe_tire
