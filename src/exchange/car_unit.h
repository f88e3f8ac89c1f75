// SPDX-License-Identifier: Apache-2.0
// A car on its tires on a road as a co-simulation unit: rack, torques of the wheels and loads on
// the chassis in; motion of chassis and wheels, forces of push-rods and tires out.
//
// A communication step is divided into equal steps of the car, none longer than the parameter
// `step.longest`. Inputs of a step are those of its begin, as FMI has them. Torques and loads stay
// as they are; the rack and the guide are carried on to the end of each step of the car,
//   rack.travel + t rack.velocity,    guide.x + t guide.speed                                (1)
// because the car feels the rate of both: a rack that jumps from one communication point to the
// next hits the wheels. t is the time since the communication point.
//
// Chassis: inertial axes x, y horizontal, z up, z = 0 on a flat road; its center of mass as it is
// described, [chassis] center, begins where it is drawn.
//   axes of the chassis = R_z(yaw) R_y(pitch) R_x(roll)           [ISO 8855:2011]            (2)
// A chassis of two halves is seen at its front half.
//
// Where a tire leaves what the file of its road knows, a step is a Failure, unless the parameter
// `road.continues` lets the road go on as its kind of file does (models/road/road.h, beyond).
//
// The guide holds the car on a line in a driver's place (models/car/car.h); without stiffness it
// does nothing, once the car has begun.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>

#include "exchange/unit.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/specimen.h"
#include "models/car/car.h"
#include "models/road/road.h"

namespace latsch::exchange {

/// Of (2): roll, pitch, yaw, rad; pitch within a right angle to either side.
Eigen::Vector3d roll_pitch_yaw(const Eigen::Matrix3d& turn);

class CarUnit final : public Unit {
 public:
  /// InputError where the specimen cannot be driven.
  CarUnit(std::shared_ptr<experiment::Specimen> specimen, std::shared_ptr<const road::Road> road);

  const std::vector<Variable>& variables() const override { return *variables_; }
  double value(std::size_t variable) const override;
  void set(std::size_t variable, double value) override;
  std::optional<Failure> start(double time) override;
  std::optional<Failure> step(double time, double step) override;
  std::unique_ptr<Unit> clone() const override { return std::make_unique<CarUnit>(*this); }

  /// None before start().
  const std::optional<car::CarState>& state() const { return state_; }

  static constexpr std::size_t kGiven = 26, kAnswers = 15 + 4 * 10;

 private:
  /// One car serves a unit and its copies, one at a time: what is theirs is the state.
  struct Shared {
    std::mutex turn;
    std::unique_ptr<car::Car> car;
  };
  car::CarInputs inputs(const car::Car& car, double since) const;
  void take(const car::Car& car, const car::CarInputs& inputs);

  std::shared_ptr<experiment::Specimen> specimen_;
  const experiment::Drives* drives_;
  std::shared_ptr<const road::Road> road_;
  std::shared_ptr<const std::vector<Variable>> variables_;
  std::shared_ptr<Shared> shared_;  // from the first start() on
  std::optional<car::CarState> state_;
  std::array<double, kGiven> given_{};      // parameters and inputs, in the table's order
  std::array<double, kAnswers> answers_{};  // outputs
};

}  // namespace latsch::exchange
