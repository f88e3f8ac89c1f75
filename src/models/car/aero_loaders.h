// SPDX-License-Identifier: Apache-2.0
// Virtual vertical forces on the chassis that reproduce the static forces of the four push-rods, in
// place of the effects of air, pitch, roll and steering on the track [thesis K, 5-2]:
//   min |p - p0 - S (F - F0)|²,    S: slopes of the four axial forces by the loaders' forces
// Three loaders span three of the four directions. The remainder, which no three loaders can
// produce (nearly the cross-weight), is reported.
#pragma once

#include <Eigen/Core>

#include "models/car/car.h"

namespace latsch::car {

/// Points on the chassis at rest at which the loaders act, m. Downforce is positive.
struct AeroLoaders {
  Eigen::Matrix<double, 3, 3> points;  // one loader per column
  std::vector<multibody::Load> loads(const Car& car, const Eigen::Vector3d& downforce) const;
};

struct LoaderSolution {
  Eigen::Vector3d downforce;  // F, N
  Eigen::Vector4d left;  // N, requested push-rod forces minus those of the car with the loaders
  // Unit vector: combination of push-rod forces that no loaders can produce.
  Eigen::Vector4d unreachable;
  Eigen::Matrix<double, 4, 3> slopes;  // S
  CarState state;                      // state at rest with the loaders, at the requested speed

  /// Returns the loaders' forces F and the remaining push-rod forces for other requested push-rod
  /// forces nearby, by the slopes.
  std::pair<Eigen::Vector3d, Eigen::Vector4d> near(const Eigen::Vector4d& pushrods) const;
  Eigen::Vector4d pushrods;  // with F, N
};

/// Uses Newton's method with slopes by differences on the standing car, then with these slopes on
/// the rolling car, until a step is below 1e-4 of the forces.
Result<LoaderSolution> solve_loaders(Car& car,
                                     const AeroLoaders& loaders,
                                     const Eigen::Vector4d& pushrods,
                                     const road::Road& road,
                                     double speed,
                                     const CarInputs& inputs = {});

}  // namespace latsch::car
