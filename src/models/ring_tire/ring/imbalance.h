// SPDX-License-Identifier: Apache-2.0
// A mass on the belt at a point of the curve, x = Σ w_i x_i of four nodes. It adds
//   M_ij += m w_i w_j  of x, y, z                                                            (34)
// and m w_i g to their weight, if the belt has any. If the wheel spins in the air, the force m r ω²
// acts on the hub along the mass's radius. The mass matrix is the same in all axes and does not
// rotate with the wheel.
#pragma once

#include <array>

#include "models/ring_tire/belt/cyclic_band.h"
#include "models/ring_tire/belt/rim_frame.h"
#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

class Imbalance {
 public:
  Imbalance(const Uniformity& uniformity, int nodes);

  /// Adds M a to `force`, where `a` are accelerations or velocities.
  void add_inertia(const NodeValues& a, NodeValues& force) const;
  /// Adds factor times M to K.
  void add_mass(double factor, CyclicBand& K) const;
  void add_mass(double factor, CyclicBandFactor& K) const;
  /// For gravity g, m/s²: the weight on the nodes, and the potential energy, J, above height 0.
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
