// SPDX-License-Identifier: Apache-2.0
// Virtual vertical forces on the chassis that reproduce the static forces of the four push-rods, in
// the place of what air, pitch, roll and steering did on the track [thesis K, 5-2]:
//   min |p - p0 - S (F - F0)|²,    S: slopes of the four axial forces in the loaders' forces
// Three of them span three of the four directions. What is left over, the part of the four that no
// three loaders produce (nearly the cross-weight), is told, not hidden.
#pragma once

#include <Eigen/Core>

#include "models/car/car.h"

namespace latsch::car {

/// Where they act, on the chassis at rest, m; downforce is positive.
struct AeroLoaders {
  Eigen::Matrix<double, 3, 3> points;  // a loader a column
  std::vector<multibody::Load> loads(const Car& car, const Eigen::Vector3d& downforce) const;
};

struct LoaderSolution {
  Eigen::Vector3d downforce;           // F, N
  Eigen::Vector4d left;                // N, p less what the car has with them
  Eigen::Vector4d unreachable;         // unit: the direction of the four that they cannot produce
  Eigen::Matrix<double, 4, 3> slopes;  // S
  CarState state;                      // at rest with them, at that speed

  /// For other forces near by: F and what is left.
  std::pair<Eigen::Vector3d, Eigen::Vector4d> near(const Eigen::Vector4d& pushrods) const;
  Eigen::Vector4d pushrods;  // with F, N
};

/// Newton's method with slopes by differences, on the car standing; then with these slopes on the
/// car as it rolls, until a step is below 1e-4 of the forces.
Result<LoaderSolution> solve_loaders(Car& car,
                                     const AeroLoaders& loaders,
                                     const Eigen::Vector4d& pushrods,
                                     const road::Road& road,
                                     double speed,
                                     const CarInputs& inputs = {});

}  // namespace latsch::car
