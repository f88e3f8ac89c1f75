// SPDX-License-Identifier: Apache-2.0
// An additional mass m (imbalance) on the belt, at a point x = Σ w_i x_i that depends on four
// nodes. It adds
//   M_ij += m w_i w_j  of x, y, z                                                            (34)
// to the mass matrix of the nodes i and j, and m w_i g to their weight, if weight is included. If
// the wheel spins in the air, the force m r ω² acts on the hub along the mass's radius. The mass
// matrix is the same in all axes and does not rotate with the wheel.
#pragma once

#include <array>

#include "models/ring_tire/belt/cyclic_band.h"
#include "models/ring_tire/belt/rim_frame.h"
#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

class Imbalance {
 public:
  Imbalance(const Uniformity& uniformity, int nodes);

  /// Adds M a to `force`, where M is the additional mass matrix and `a` holds accelerations or
  /// velocities.
  void add_inertia(const NodeValues& a, NodeValues& force) const;
  /// Add `factor` times the additional mass matrix M to K.
  void add_mass(double factor, CyclicBand& K) const;
  void add_mass(double factor, CyclicBandFactor& K) const;
  /// Return, for gravity g (m/s²), the weight of the mass on the nodes, and its potential energy,
  /// J, relative to the height 0.
  void add_weight(double g, NodeValues& force) const;
  double height_energy(double g, const NodeValues& q) const;

 private:
  template <class Add>
  void find_mass(double factor, const Add& add) const;

  double mass_;  // kg; 0: no imbalance
  std::array<int, 4> node_;
  std::array<double, 4> weight_;
};

}  // namespace latsch::ring_tire
