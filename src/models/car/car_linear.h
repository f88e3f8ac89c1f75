// SPDX-License-Identifier: Apache-2.0
// A car at rest on its tires, for small motion (multibody/linear_model.h). Inputs are the heights h
// of the road below its four tires, outputs are signals of sensors on it.
//   tire: the force on the hub changes by -k x - c x',  x: wheel center relative to its road,
//   lateral and vertical (y, z)
// k and c of a tire of any kind are found by moving its wheel at constant velocity, which gives
// F(t) - F(0) = -c v - k v t. They are fitted by least squares after the transient of the start has
// decayed, as the mean of both directions. This is exact for a spring and damper. For other tires k
// and c are valid below the frequencies of the tire's own (belt) modes, with sticking friction.
// Along x a tire has no stiffness, because the wheel rolls freely. Derivatives by camber and the
// moments of a tire on its hub are omitted, so that its lateral force acts at the wheel center:
// docs/car.md states the consequence for tires with lateral stiffness.
#pragma once

#include <string>
#include <vector>

#include "models/car/car.h"
#include "models/multibody/linear_model.h"

namespace latsch::car {

/// Stiffness and damping of a tire: derivatives of its force with respect to displacement and
/// velocity along y and z.
struct TireStiffness {
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  // k, N/m
  Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();    // c, N s/m
};

struct TireProbe {
  double speed = 1e-3;                    // v, m/s
  double starting = 0.05, lasting = 0.2;  // s
  double step = 2e-4;                     // s
};

/// Finds the stiffness and damping of a tire by moving its wheel from its current state. `wheel` is
/// not changed.
Result<TireStiffness> probe(const WheelState& wheel,
                            const road::Road& road,
                            double time,
                            const TireProbe& settings = {});

struct LinearCar {
  multibody::LinearModel model;
  multibody::LinearInputs heights;  // heights of the road at FL, FR, RL, RR, m
  multibody::LinearOutputs sensors;
  // Names of the sensors, pushrod_FL ... N; hub_FL ..., body_z m/s^2: car_record.h.
  std::vector<std::string> names;

  /// Returns the transfer functions from road heights to sensors at a frequency in Hz: one row per
  /// sensor.
  Eigen::MatrixXcd response(double frequency) const;
};

/// Linearizes the car about the equilibrium `state`, under the inputs that led to it.
Result<LinearCar> linearize(const Car& car,
                            const CarState& state,
                            const road::Road& road,
                            const CarInputs& inputs = {});

}  // namespace latsch::car
