// SPDX-License-Identifier: Apache-2.0
// Derivative of the belt's damping (30) by the positions of its nodes. With the viscosity c of a
// strain e, C = Σ c e_q e_q' and velocities v relative to the rim, the force -Σ c e_q e' has the
// derivative -D by positions and -C by velocities,
//   D = Σ c (e' e_qq + e_q (e_qq v)')                                                       (31)
// D is not symmetric and a small part of a step's tangent, because strains rotate little in a step.
// Newton's method omits D; derivatives of a step (motion_slopes.h) include it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/ring_tire/belt/belt.h"
#include "models/ring_tire/belt/cyclic_band.h"

namespace latsch::ring_tire {

/// The blocks (k, k + j), j = -reach .. reach, around the ring of a matrix that need not be
/// symmetric.
class WholeBand {
 public:
  explicit WholeBand(int nodes);

  Eigen::Matrix4d& block(int k, int j) {
    return blocks_[static_cast<std::size_t>(k * kWidth + j + CyclicBand::kReach)];
  }
  const Eigen::Matrix4d& block(int k, int j) const {
    return blocks_[static_cast<std::size_t>(k * kWidth + j + CyclicBand::kReach)];
  }
  /// Return A x and A' x of columns; each row is an unknown.
  SideBySide multiply(const SideBySide& x) const;
  SideBySide multiply_transposed(const SideBySide& x) const;

 private:
  static constexpr int kWidth = 2 * CyclicBand::kReach + 1;
  int nodes_;
  std::vector<Eigen::Matrix4d> blocks_;
};

/// Returns D of (31) in inertial axes, with the nodes at `at` and their rates relative to the rim.
WholeBand damping_by_places(const BeltForces& belt,
                            const RimRows& at,
                            const RimRows& rate,
                            const RimFrame& rim);

}  // namespace latsch::ring_tire
