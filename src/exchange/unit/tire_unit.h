// SPDX-License-Identifier: Apache-2.0
// A rolling tire of any kind on a road as a co-simulation unit: its input is the motion of the
// wheel, its output the force on the hub.
//
//   carrier = R_z(yaw) R_x(inclination) R_y(pitch)                                           (1)
// rotates the axes of the TYDEX C frame into the inertial ones: the first two rotations determine
// the spin axis, and the angles are regular unless the wheel lies flat.
//
// Inputs of a step are those at its beginning, as in FMI. They are extrapolated to its end
//   center + h velocity,  exp(h [angular velocity]) carrier,  spin + h spin rate             (2)
// and the tire is moved there. So a coupling in which all units step in parallel is of first order
// in the forces and of second order in the motion. If the parameter `inputs.carried_on` is 0, the
// inputs are the motion at the step's end, for a caller that knows it.
//
// If the parameter `spin.is_free` is 1, the unit turns the wheel itself, with the tire's own step
// (models/tire/free_wheel.h), because a wheel that another program integrates beside the unit is
// unstable at steps of a millisecond:
//   spin.inertia w' = My + spin.drive + brake,   carrier.My = -(spin.drive + brake)          (3)
// My is that of the tire on the rim. It turns the wheel and must not act on the carrier again,
// which feels the other components of the hub's force and moment, and carrier.My.
//
// A pressure that no tire has is refused. Other values that a test of the same tire would refuse or
// doubt, such as a time step that is too long, a speed above 200 m/s or a rim below the road, are
// computed, because a co-simulation may pass through them; limits_met() then reports them.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "exchange/unit/unit.h"
#include "models/road/road.h"
#include "models/tire/free_wheel.h"
#include "models/tire/rolls.h"

namespace latsch::exchange {

/// Returns the distance, m, from the wheel center down to the road in the plane of the wheel. The
/// road is replaced by the plane that touches it below the wheel. The result is infinite if the
/// wheel lies flat on the road.
double loaded_radius(const WheelMotion& motion, const road::Road& road, double time);

/// Evaluates (2).
WheelMotion carried_on(const WheelMotion& motion, double step);

class TireUnit final : public ExchangedModel {
 public:
  /// Throws InputError if the model does not roll.
  TireUnit(RollingModel model, std::shared_ptr<const road::Road> road);
  TireUnit(const TireUnit& other);

  const std::vector<ExchangedVariable>& variables() const override { return *variables_; }
  double value(std::size_t variable) const override;
  void set(std::size_t variable, double value) override;
  Status start(double time) override;
  Status step(double time, double step) override;
  std::vector<std::string> limits_met() const override;
  std::unique_ptr<ExchangedModel> clone() const override {
    return std::make_unique<TireUnit>(*this);
  }

  /// Returns the motion of the wheel that the inputs state.
  WheelMotion motion() const;

 private:
  /// Largest values that a unit and its copies have received.
  struct Greatest {
    double speed = 0.0, way = 0.0, deflection = 0.0;  // m/s; m in a step; m
    double release = 0.0;                             // N m, least torque of a brake, below 0
    std::string pressure = {};  // sentence about an unusual pressure; else empty
  };

  void take(const HubForces& hub, const WheelMotion& motion, double time);
  /// Returns the torque of the brake, N m, which is 0 for a negative input.
  double brake_torque();
  /// Returns the free wheel of the start; `moment` is that of the tire, N m.
  FreeWheel free_wheel_at(const WheelMotion& motion, double moment);
  /// Moves the tire to `end` and, if its wheel is free, sets the spin there.
  Result<HubForces> advance(WheelMotion& end, double time, double step);

  static constexpr std::size_t kGiven = 16, kAnswers = 13, kPrints = 3, kGivenOfSpin = 4, kSpun = 3;
  /// Number of variables before those of the free spin.
  static constexpr std::size_t kBeforeSpin = kGiven + kAnswers + kPrints;
  /// Returns the place in `given_` of a parameter or an input; nullopt for an output.
  static std::optional<std::size_t> place_of_given(std::size_t variable);

  RollingModel model_;
  std::shared_ptr<const road::Road> road_;
  std::shared_ptr<const std::vector<ExchangedVariable>> variables_;
  std::shared_ptr<Greatest> greatest_ = std::make_shared<Greatest>();
  std::unique_ptr<Tire> tire_;
  /// parameters and inputs in the order of the table of variables
  std::array<double, kGiven + kGivenOfSpin> given_{};
  /// outputs in the order of the table, except those of the footprint
  std::array<double, kAnswers> answers_{};
  /// computed when an output of the footprint is first read
  mutable std::optional<Footprint> print_;
  std::optional<FreeWheel> wheel_;    // its spin; nullopt: the inputs state it
  std::array<double, kSpun> spun_{};  // the last outputs of the table
};

}  // namespace latsch::exchange
