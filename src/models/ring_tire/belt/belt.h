// SPDX-License-Identifier: Apache-2.0
// The belt is a closed chain of N nodes under pressure, the control points of belt_curve.h. L0 = 2π
// R/N is the length of a segment at rest, g_k the curve's slope in the middle of segment k, g0 its
// length at rest, u = a . (x - c), and n the outward normal in the plane of the rim. Primes are
// derivatives by s, which runs from 0 to 1 in a segment. The energy of the belt is the sum over k
// of
//
//   extension        1/2 EA L0 (|g_k|/g0 - 1 + T0/EA)^2                                        (1)
//   pressure         p w a . ((x_k - c) × ((x_(k+1) - c)/3 + (x_(k+2) - c)/12))                (2)
//   bending          1/2 (EI/L0^3) (s - s_0)^2,  s = n . X''                                   (3)
//   out-of-plane     1/2 (EI_o/L0^3) (u'' - ζ ψ s)^2                                           (4)
//   twist            1/2 (GJ/L0) (ψ' + ζ u' s/L0^2)^2                                          (5)
//
// (1) and (5) are evaluated in the middle of each segment: more points would keep a curve that
// hardly stretches from bending. (3) and (4) use Simpson's rule, at the knots and between them;
// (2), minus its constant, is evaluated at the knots. All are of fourth order in L0. T0 balances
// the pressure at rest, so nothing else is stressed there. (1) and (3) do not change when the ring
// is rotated, (4) and (5) not when it is tilted; ζ = 1 + O(L0^2) ensures this. A section rotated by
// ψ bends laterally with the belt's present bend s, which is -L0^2/R at rest and 0 in a flat patch.
// Lateral travel and torsion are assumed to be small; in-plane motion may be large. Equations:
// docs/ring_tire.md, section 2.
//
// Plies: energy (32) of bending with twist, ply_coupling.h. If the belt is a cone at rest, its
// sections rotated by ψ_0, (4) is measured from that state: u'' - ζ (ψ s - ψ_0 s_0)           (33)
//
// Damping: each stress K e of (1) and (3) to (5) is accompanied by K τ e'                     (30)
// where e' is the rate of the strain e by the velocities relative to the rotating rim. τ_e belongs
// to extension, which strains the cords, τ_b to all other strains, which act on the rubber between
// the cords. A rigid-body motion of the belt in the plane of the rim loses no energy.
#pragma once

#include "models/ring_tire/belt/rim_frame.h"
#include "models/ring_tire/belt/rim_rows.h"
#include "models/ring_tire/belt/stiffness_rows.h"
#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

/// Constants of the elements. stretch0: g0; s0: s of (3) at rest at a knot and between two;
/// tilt_between: ζ of (4) between knots (1 at a knot); tilt_twist: ζ of (5).
struct BeltLaw {
  double R, L0, stretch0, T0, EA, EI, EI_out_of_plane, GJ, pressure_width, s0, s0_between,
      tilt_between, tilt_twist;
  double damping_time, extension_damping_time;  // s, τ_b and τ_e of (30)
  double D16, cone, cone_between;               // D16 of (32), N m^2; ζ ψ_0 s_0 of (33), m

  /// Multiplies the stiffness of (1) by `extension`, that of all other strains by `bending`.
  BeltLaw stiffer(double extension, double bending) const {
    BeltLaw law = *this;
    law.EA *= extension;
    law.EI *= bending;
    law.EI_out_of_plane *= bending;
    law.GJ *= bending;
    law.D16 *= bending;
    return law;
  }
  /// Returns the law without stress or pressure, for a belt of the same shape.
  BeltLaw slack() const {
    BeltLaw law = stiffer(0.0, 0.0);
    law.T0 = law.pressure_width = law.cone = law.cone_between = 0.0;
    return law;
  }
};

/// Weights of the next node and of the node after it in (2).
constexpr double kArea1 = 1.0 / 3.0, kArea2 = 1.0 / 12.0;
/// Weight of the knots in Simpson's rule for (3); the points between them have the rest.
constexpr double kKnotShare = 1.0 / 3.0;

class BeltForces {
 public:
  BeltForces(const Belt& belt, int nodes);

  /// Energy of the configuration q, J, relative to the ring at rest except for the constant of (2).
  double energy(const NodeValues& q, const RimFrame& rim) const;
  /// True if (30) damps anything.
  bool damped() const { return law_.damping_time > 0.0 || law_.extension_damping_time > 0.0; }
  /// Computes force = -energy' with nodes at the positions `at`; `force` needs kScratch additional
  /// rows. If the rates of the nodes are given, the damping (30) is subtracted.
  void find_force(const RimRows& at, const RimRows* rate, RimRows& force) const;
  static constexpr int kScratch = 15;
  /// Computes K = scale * (energy'' + velocity C), where C is that of find_damping().
  void find_stiffness(const RimRows& at, double velocity, double scale, StiffnessRows& K) const;
  /// Computes C = scale * (minus the derivative of (30) by the rates).
  void find_damping(const RimRows& at, double scale, StiffnessRows& C) const;
  const BeltLaw& law() const { return law_; }

  /// L0, m, and T0, N.
  double segment() const { return law_.L0; }
  double tension() const { return law_.T0; }

 private:
  void find_by_laws(const BeltLaw& stress,
                    const BeltLaw& stretch,
                    const RimRows& at,
                    double scale,
                    StiffnessRows& K) const;
  void add_lateral_stiffness(const BeltLaw& law, double scale, StiffnessRows& K) const;

  int nodes_;
  BeltLaw law_;
};

}  // namespace latsch::ring_tire
