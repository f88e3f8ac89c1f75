// SPDX-License-Identifier: Apache-2.0
// The belt: a closed chain of N nodes under pressure. With x_k the positions, ψ_k the torsions,
// u_k = a . (x_k - c) the lateral travel, L0 = 2 R sin(π/N) the chord at rest and c_k = x_(k+1) -
// x_(k-1), d_k = x_(k+1) + x_(k-1) - 2 x_k in the plane of the rim, its energy is the sum over k of
//
//   extension        1/2 (EA/L0) (|x_(k+1) - x_k| - L0 + T0 L0/EA)^2                          (1)
//   pressure         -1/2 p w a . ((x_k - c) × (x_(k+1) - c)) (-1), the area enclosed          (2)
//   bending          1/2 (EI/L0^3) (s_k - s_0)^2,  s_k = a . (d_k × c_k)/|c_k|                  (3)
//   out-of-plane     1/2 EI_o L0 ((u_(k+1) + u_(k-1) - 2 u_k)/L0^2 + ψ_k/R)^2                   (4)
//   twist            1/2 GJ L0 ((ψ_(k+1) - ψ_k)/L0 - (u_(k+1) - u_k)/(L0 R))^2                 (5)
//
// T0 = p w R cos(π/N) holds the pressure at rest, so nothing else is stressed there. (1) and (3) do
// not change when the ring is turned, (4) and (5) not when it is tilted: u = γ R cos φ, ψ = γ cos φ
// is a rigid tilt by γ, also of the discrete ring. Lateral travel and torsion are taken as small;
// in-plane motion may be large. Equations: docs/ring_tire.md, section 2.
#pragma once

#include "models/ring_tire/belt/cyclic_band.h"
#include "models/ring_tire/belt/rim_frame.h"
#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

class BeltForces {
 public:
  BeltForces(const Belt& belt, int nodes);

  /// J, of the configuration q, against that of the ring at rest but for the constant of (2).
  double energy(const NodeValues& q, const RimFrame& rim) const;
  /// force -= energy'.
  void add_force(const NodeValues& q, const RimFrame& rim, NodeValues& force) const;
  /// K += scale * energy''.
  void add_stiffness(const NodeValues& q, const RimFrame& rim, double scale, CyclicBand& K) const;

  double chord() const { return L0_; }
  double tension() const { return T0_; }

 private:
  void add_bending_stiffness(
      const NodeValues& q, const RimFrame& rim, int k, double scale, CyclicBand& K) const;
  void add_lateral_stiffness(const RimFrame& rim, double scale, CyclicBand& K) const;

  int nodes_;
  double R_, L0_, T0_;
  double EA_, EI_, EI_out_of_plane_, GJ_, pressure_width_;
  double s0_;  // of (3), at rest
};

}  // namespace latsch::ring_tire
