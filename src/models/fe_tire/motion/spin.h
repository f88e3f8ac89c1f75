// SPDX-License-Identifier: Apache-2.0
// Inertia of a tire whose material spins through a mesh that stands, and of one that is seen in
// axes that spin along.
//
// In axes of the wheel, which do not spin, material passes the place X of the mesh with the
// velocity e x X for each rad/s of the speed Omega about the spin axis e = +y. Rolling forward is
// Omega > 0. With D = (e x X) . grad, taken at the true X of an integration point with the
// gradients of the element's shape functions,
//   M_ab = int rho N_a N_b,   G'_ab = int rho N_a D N_b,   W_ab = int rho D N_a D N_b,
//   M u'' + Omega (G' - G'^T) u' + f_int(u) - Omega^2 (w_0 + W u) = f_ext,   w_0 = W X        (W.1)
// the same in each of the three directions. A rotation of the whole has exactly the velocity of a
// rigid body and a translation exactly none, whatever the width of the sectors. D acts on
// components along axes that stand, so the frames of the sectors turn vectors and not the
// derivative. M is the consistent mass: with the mass that vibrates in hex8.h the second-order
// error of G would be twice that of M. In axes that spin along nothing passes the mesh; with [e x]
// the cross product and P = 1 - e e^T, both within a node,
//   M u'' + 2 Omega C u' + f_int(u) - Omega^2 M P x = f_ext,   C_ab = M_ab [e x]              (W.2)
// where M is the mass of hex8.h. docs/fe_tire_motion.md has both with their sources.
#pragma once

#include <Eigen/Core>

#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/ring/ring_elements.h"
#include "models/fe_tire/ring/sector.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

/// Inertia of one element between its nodes, the same in all directions, cords included.
struct FlowInertia {
  Matrix8 M, G, W;  // kg, kg/s and kg/s^2 for 1 rad/s: int rho N N, int rho N DN, int rho DN DN
};
FlowInertia flow_inertia(const HexShape& shape, const Materials& materials, const Element& element);

/// Inertia of one sector of an evenly divided ring in axes that stand: (W.1) for 1 rad/s.
struct SectorFlow {
  SectorBlocks M, G, W;  // G: G' - G'^T, which is skew
  Eigen::VectorXd w_0;   // kg m/s^2 on the unknowns of a sector

  explicit SectorFlow(const RingElements& elements);
};

/// Inertia of one sector of an evenly divided ring in axes that spin along: (W.2) for 1 rad/s.
struct SectorSpin {
  SectorBlocks M, C, MP;  // C is skew
  Eigen::VectorXd w_0;    // M P X, kg m/s^2 on the unknowns of a sector

  explicit SectorSpin(const RingElements& elements);
  /// The matrices of K - Omega^2 W + i omega Omega G - omega^2 M of circumferential number n in
  /// axes that stand, which follow from those that spin along by omega = sigma + n Omega exactly: W
  /// = M P + 2 n (i C) + n^2 M and i G = 2 (i C + n M). All are Hermitian.
  struct Harmonic {
    numerics::BandedHermitian M, iG, W;
  };
  Harmonic harmonic(int n) const;
};

/// Computes the matrices of (W.2) of one element of the first sector in the frames of its nodes,
/// the nodes of the rim included.
void spin_element(
    const RingElements& elements, int element, Matrix24& M, Matrix24& C, Matrix24& MP);

/// Returns W of (W.1) for the unknowns of a ring, any division into sectors, for 1 rad/s. K -
/// Omega^2 W takes the place of K in a rolling tire.
numerics::SymmetricMatrix flow_stiffness(const RingAssembly& assembly,
                                         const RingElements& elements);
/// Returns w_0 + W u, the forces of (W.1) at displacements u [3 x nodes, sector frames] for 1
/// rad/s, as a sum over the unknowns, N s^2.
Eigen::VectorXd flow_forces(const RingUnknowns& unknowns,
                            const RingElements& elements,
                            const Eigen::Matrix3Xd& u);

}  // namespace latsch::fe_tire
