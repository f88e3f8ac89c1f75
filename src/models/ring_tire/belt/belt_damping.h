// SPDX-License-Identifier: Apache-2.0
// How the belt's damping (30) changes with the places of its nodes. With c the viscosity of a
// strain e, C = Σ c e_q e_q' and v the velocities against the rim, the force -Σ c e_q e' has the
// slope -D by places and -C by velocities,
//   D = Σ c (e' e_qq + e_q (e_qq v)')                                                       (31)
// D is not symmetric and a small part of a step's tangent: the strains turn little in a step.
// Newton's method leaves it out, derivatives of a step (motion_slopes.h) have it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/ring_tire/belt/belt.h"
#include "models/ring_tire/belt/cyclic_band.h"

namespace latsch::ring_tire {

/// Blocks (k, k + j), j = -reach .. reach, around the ring, of any matrix.
class WholeBand {
 public:
  explicit WholeBand(int nodes);

  Eigen::Matrix4d& block(int k, int j) {
    return blocks_[static_cast<std::size_t>(k * kWidth + j + CyclicBand::kReach)];
  }
  const Eigen::Matrix4d& block(int k, int j) const {
    return blocks_[static_cast<std::size_t>(k * kWidth + j + CyclicBand::kReach)];
  }
  /// A x and A' x of columns; a row an unknown.
  SideBySide multiply(const SideBySide& x) const;
  SideBySide multiply_transposed(const SideBySide& x) const;

 private:
  static constexpr int kWidth = 2 * CyclicBand::kReach + 1;
  int nodes_;
  std::vector<Eigen::Matrix4d> blocks_;
};

/// D of (31), in inertial axes, with the nodes at `at` and their rates against the rim.
WholeBand damping_by_places(const BeltForces& belt,
                            const RimRows& at,
                            const RimRows& rate,
                            const RimFrame& rim);

}  // namespace latsch::ring_tire
