// SPDX-License-Identifier: Apache-2.0
// A car at rest on its tires, for small motion (multibody/linear_model.h): inputs are the heights h
// of the road below its four tires, outputs what sensors on it record.
//   tire: its force on the hub changes by  -k x - c x',  x: wheel center against its road, across
//   and upward (y, z)
// A tire of any kind is asked for k and c by moving its wheel evenly:  F(t) - F(0) = -c v - k v t,
// by least squares after what starting leaves has died out; the mean of both directions. Exact of a
// spring and damper; of other tires k and c hold below the frequencies of their own modes (belt),
// where friction sticks. Along x a free wheel rolls, and camber's slopes are left out.
#pragma once

#include <string>
#include <vector>

#include "models/car/car.h"
#include "models/multibody/linear_model.h"

namespace latsch::car {

/// By motion along y and z.
struct TireSlopes {
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  // k, N/m
  Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();    // c, N s/m
};

struct TireProbe {
  double speed = 1e-3;                    // v, m/s
  double starting = 0.05, lasting = 0.2;  // s
  double step = 2e-4;                     // s
};

/// Of a wheel as it stands; it stays as it is.
Result<TireSlopes> probe(const WheelState& wheel,
                         const road::Road& road,
                         double time,
                         const TireProbe& settings = {});

struct LinearCar {
  multibody::LinearModel model;
  multibody::LinearInputs heights;  // of FL, FR, RL, RR, m
  multibody::LinearOutputs sensors;
  std::vector<std::string> names;  // pushrod_FL ... N; hub_FL ..., body_z m/s^2: car_record.h

  /// Sensors by heights, at a frequency in Hz.
  Eigen::MatrixXcd response(double frequency) const;
};

/// At rest where `state` is, under the same inputs as brought it there.
Result<LinearCar> linearize(const Car& car,
                            const CarState& state,
                            const road::Road& road,
                            const CarInputs& inputs = {});

}  // namespace latsch::car
