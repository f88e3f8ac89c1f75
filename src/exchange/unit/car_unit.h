// SPDX-License-Identifier: Apache-2.0
// A car on its tires on a road as a co-simulation unit. Inputs: rack, torques of the wheels and
// loads on the chassis; outputs: motion of chassis and wheels, forces of push-rods and tires.
//
// A communication step is divided into equal steps of the car, none longer than the parameter
// `step.longest`. Inputs of a step are those at its beginning, as in FMI. Torques and loads stay
// constant; the rack and the guide are extrapolated to the end of each step of the car,
//   rack.travel + t rack.velocity,    guide.x + t guide.speed                                (1)
// because the rates of both act on the car: a rack that jumps from one communication point to the
// next would cause an impact on the wheels. t is the time since the communication point.
//
// Chassis: the position is that of its center of mass ([chassis] center), which starts at its drawn
// position, in inertial axes: x and y horizontal, z up, z = 0 on a flat road. Its angles are
//   axes of the chassis = R_z(yaw) R_y(pitch) R_x(roll)           [ISO 8855:2011]            (2)
// For a chassis of two halves these are the axes of its front half.
//
// If a tire leaves the data of a road's file, a step is a Failure, unless the parameter
// `road.continues` lets the road continue in the way that its kind of file defines
// (models/road/road.h, beyond).
//
// The map of air forces is constant beyond its heights of the car's floor (models/car/aero_map.h).
// The first step beyond them is reported at once, the share of such steps at the end.
//
// The guide replaces a driver and holds the car on a line (models/car/car.h); without stiffness it
// has no effect once the car has started.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>

#include "exchange/unit/car_input_watch.h"
#include "exchange/unit/unit.h"
#include "models/car/air_watch.h"
#include "models/car/drives.h"
#include "models/road/road.h"

namespace latsch::exchange {

/// Returns roll, pitch and yaw of equation (2) in car_unit.h, rad; the pitch is within +-90
/// degrees.
Eigen::Vector3d roll_pitch_yaw(const Eigen::Matrix3d& turn);

class CarUnit final : public ExchangedModel {
 public:
  /// Throws InputError if the model cannot be driven.
  CarUnit(DrivingModel model, std::shared_ptr<const road::Road> road);

  const std::vector<ExchangedVariable>& variables() const override { return *variables_; }
  double value(std::size_t variable) const override;
  void set(std::size_t variable, double value) override;
  Status start(double time) override;
  Status step(double time, double step) override;
  std::vector<std::string> limits_met() const override;
  std::string first_limit() const override { return air_.first(); }
  std::unique_ptr<ExchangedModel> clone() const override {
    return std::make_unique<CarUnit>(*this);
  }

  /// Returns the state of the car; nullopt before start().
  const std::optional<car::CarState>& state() const { return state_; }

  static constexpr std::size_t kGiven = 26, kAnswers = 15 + 4 * 10;

 private:
  /// The car model that a unit and its copies share. They use it in turn; each has its own state.
  struct Shared {
    std::mutex turn;
    std::unique_ptr<car::Car> car;
  };
  car::CarInputs inputs(const car::Car& car, double since) const;
  /// Records parameters, inputs and the deflections of the tires.
  void watch(const car::Car& car, double time, double step);
  void take(const car::Car& car, const car::CarInputs& inputs);

  DrivingModel model_;
  std::shared_ptr<const road::Road> road_;
  std::shared_ptr<const std::vector<ExchangedVariable>> variables_;
  std::shared_ptr<Shared> shared_;  // created by the first start()
  std::optional<car::CarState> state_;
  /// greatest inputs, also of copies
  std::shared_ptr<CarInputWatch> watch_ = std::make_shared<CarInputWatch>();
  /// Samples of this unit's own way, one for each step of the car: those of steps that a program
  /// takes back do not count.
  car::AirWatch air_;
  /// parameters and inputs in the order of the table of variables
  std::array<double, kGiven> given_{};
  std::array<double, kAnswers> answers_{};  // outputs
};

}  // namespace latsch::exchange
