// SPDX-License-Identifier: Apache-2.0
// A mass on the belt: at a point of the curve, x = Σ w_i x_i of four nodes, it counts
//   M_ij += m w_i w_j  of x, y, z                                                            (34)
// and m w_i g in their weight, if the belt has any. Where the wheel spins in the air, the hub feels
// m r ω² along its radius. The same in all axes, it does not turn with the wheel.
#pragma once

#include <array>

#include "models/ring_tire/belt/cyclic_band.h"
#include "models/ring_tire/belt/rim_frame.h"
#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

class Imbalance {
 public:
  Imbalance(const Uniformity& uniformity, int nodes);

  /// force += M a, of accelerations or velocities.
  void add_inertia(const NodeValues& a, NodeValues& force) const;
  /// K += factor M.
  void add_mass(double factor, CyclicBand& K) const;
  void add_mass(double factor, CyclicBandFactor& K) const;
  /// Of gravity g, m/s²: force on the nodes; J above height 0.
  void add_weight(double g, NodeValues& force) const;
  double height_energy(double g, const NodeValues& q) const;

 private:
  template <class Add>
  void find_mass(double factor, const Add& add) const;

  double mass_;  // kg; 0: none
  std::array<int, 4> node_;
  std::array<double, 4> weight_;
};

}  // namespace latsch::ring_tire
