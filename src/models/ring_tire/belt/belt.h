// SPDX-License-Identifier: Apache-2.0
// The belt: a closed chain of N nodes under pressure, the control points of belt_curve.h. With L0 =
// 2π R/N the length of a segment at rest, g_k the curve's slope in the middle of segment k, g0 its
// length at rest, u = a . (x - c), n the outward normal in the plane of the rim and primes by s of
// one a segment, its energy is the sum over k of
//
//   extension        1/2 EA L0 (|g_k|/g0 - 1 + T0/EA)^2                                        (1)
//   pressure         p w a . ((x_k - c) × ((x_(k+1) - c)/3 + (x_(k+2) - c)/12))                (2)
//   bending          1/2 (EI/L0^3) (s - s_0)^2,  s = n . X''                                   (3)
//   out-of-plane     1/2 (EI_o/L0^3) (u'' - ζ ψ s)^2                                           (4)
//   twist            1/2 (GJ/L0) (ψ' + ζ u' s/L0^2)^2                                          (5)
//
// (1) and (5) are taken in the middle of each segment: more points would hold a curve that hardly
// stretches back from bending. (3) and (4) by Simpson's rule, at the knots and between them; (2),
// less the area, at the knots. All are of fourth order in L0. T0 holds the pressure at rest, so
// nothing else is stressed there. (1) and (3) do not change when the ring is turned, (4) and (5)
// not when it is tilted, which is what ζ = 1 + O(L0^2) is for. A section that has turned by ψ bends
// across with what the belt bends now, s: at rest -L0^2/R, in a flat patch nothing. Lateral travel
// and torsion are taken as small; in-plane motion may be large. Equations: docs/ring_tire.md,
// section 2.
//
// Plies: energy (32) of bending with twist, ply_coupling.h. Where the belt is a cone at rest, its
// sections turned by ψ_0, (4) counts from there: u'' - ζ (ψ s - ψ_0 s_0)                       (33)
//
// Damping: beside the stress of (1) and (3) to (5), K times the strain e, stands K τ e'       (30)
// with the strain's rate e' by the velocities against the turning rim; τ_e of extension, which is
// the cords', τ_b of all others, which are the rubber's between them. Where the belt moves as a
// rigid body in the plane of the rim nothing is lost.
#pragma once

#include "models/ring_tire/belt/rim_frame.h"
#include "models/ring_tire/belt/rim_rows.h"
#include "models/ring_tire/belt/stiffness_rows.h"
#include "models/ring_tire/description/ring_parameters.h"

namespace latsch::ring_tire {

/// What the elements know; stretch0: g0, s0: of (3) at rest at a knot and between two,
/// tilt_between: ζ of (4) there (1 at a knot), tilt_twist: of (5).
struct BeltLaw {
  double R, L0, stretch0, T0, EA, EI, EI_out_of_plane, GJ, pressure_width, s0, s0_between,
      tilt_between, tilt_twist;
  double damping_time, extension_damping_time;  // s, τ_b and τ_e of (30)
  double D16, cone, cone_between;               // of (32), N m^2; ζ ψ_0 s_0 of (33), m

  /// Times more of what strains stretch: (1) alone, all others.
  BeltLaw stiffer(double extension, double bending) const {
    BeltLaw law = *this;
    law.EA *= extension;
    law.EI *= bending;
    law.EI_out_of_plane *= bending;
    law.GJ *= bending;
    law.D16 *= bending;
    return law;
  }
  /// Without stress or pressure, of the same shape.
  BeltLaw slack() const {
    BeltLaw law = stiffer(0.0, 0.0);
    law.T0 = law.pressure_width = law.cone = law.cone_between = 0.0;
    return law;
  }
};

/// Of (2): the weights of the next node and of that after it.
constexpr double kArea1 = 1.0 / 3.0, kArea2 = 1.0 / 12.0;
/// Of (3): Simpson's rule has a third at the knots, the rest between them.
constexpr double kKnotShare = 1.0 / 3.0;

class BeltForces {
 public:
  BeltForces(const Belt& belt, int nodes);

  /// J, of the configuration q, against that of the ring at rest but for the constant of (2).
  double energy(const NodeValues& q, const RimFrame& rim) const;
  /// Whether (30) has anything to damp.
  bool damped() const { return law_.damping_time > 0.0 || law_.extension_damping_time > 0.0; }
  /// force = -energy', nodes at their places `at`; with kScratch rows more. Where their rates are
  /// given, less the damping (30).
  void find_force(const RimRows& at, const RimRows* rate, RimRows& force) const;
  static constexpr int kScratch = 15;
  /// K = scale * (energy'' + velocity C), C: of find_damping().
  void find_stiffness(const RimRows& at, double velocity, double scale, StiffnessRows& K) const;
  /// C = scale * (minus the slope of (30) by the rates).
  void find_damping(const RimRows& at, double scale, StiffnessRows& C) const;
  const BeltLaw& law() const { return law_; }

  /// L0, T0.
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
