// SPDX-License-Identifier: Apache-2.0
// Virtual vertical forces on the chassis that reproduce the static forces of the four push-rods, in
// place of the effects of air, pitch, roll and steering on the track [thesis K, 5-2]:
//   min |p - p0 - S (F - F0)|²,    S: slopes of the four axial forces by the loaders' forces
// where p are the wanted axial forces of the push-rods, F the forces of the loaders, and p0, F0 the
// values of both at the last step.
//
// Three loaders can change the four push-rod forces in three independent ways. The combination of
// push-rod forces that they cannot produce, which is nearly the cross-weight, is reported as
// remainder.
#pragma once

#include <Eigen/Core>

#include "models/car/car.h"

namespace latsch::car {

/// Points on the chassis at rest at which the loaders act, m. Downforce is positive.
struct AeroLoaders {
  Eigen::Matrix<double, 3, 3> points;  // one column of coordinates per loader
  std::vector<multibody::Load> loads(const Car& car, const Eigen::Vector3d& downforce) const;
};

struct LoaderSolution {
  Eigen::Vector3d downforce;  // F, N
  Eigen::Vector4d left;  // N, requested push-rod forces minus those of the car with the loaders
  // Unit vector: combination of push-rod forces that no loaders can produce.
  Eigen::Vector4d unreachable;
  Eigen::Matrix<double, 4, 3> slopes;  // S
  CarState state;  // state of equilibrium with the loaders, at the requested speed

  /// Returns the loaders' forces F and the remaining push-rod forces for other requested push-rod
  /// forces nearby, by the slopes.
  std::pair<Eigen::Vector3d, Eigen::Vector4d> near(const Eigen::Vector4d& pushrods) const;
  Eigen::Vector4d pushrods;  // with F, N
};

/// Finds the forces of the loaders that produce the wanted push-rod forces. Newton's method is used
/// with derivatives by finite differences on the standing car, then with the same derivatives on
/// the rolling car, until a step is below 1e-4 of the forces.
Result<LoaderSolution> solve_loaders(Car& car,
                                     const AeroLoaders& loaders,
                                     const Eigen::Vector4d& pushrods,
                                     const road::Road& road,
                                     double speed,
                                     const CarInputs& inputs = {});

}  // namespace latsch::car
