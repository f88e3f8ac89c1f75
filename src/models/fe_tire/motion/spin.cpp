// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/spin.h"

#include <Eigen/LU>
#include <vector>

#include "models/fe_tire/element/hex8_rebar.h"
#include "models/fe_tire/element/hex8_shape.h"

namespace latsch::fe_tire {
namespace {

/// Adds the inertia of a mass (kg) at a point of the parent cube.
void add_mass(
    const Matrix38& X, double mass, double xi, double eta, double zeta, FlowInertia& sum) {
  const Vector8 N = shape_functions(xi, eta, zeta);
  const Matrix38 parent = parent_gradients(xi, eta, zeta);
  const Eigen::Matrix3d J = X * parent.transpose();  // columns: dX/dxi, dX/deta, dX/dzeta
  const Eigen::Vector3d at = X * N;
  const Eigen::Vector3d velocity(at.z(), 0.0, -at.x());  // e x X
  const Vector8 DN = parent.transpose() * (J.inverse() * velocity);
  sum.M.noalias() += mass * N * N.transpose();
  sum.G.noalias() += mass * N * DN.transpose();
  sum.W.noalias() += mass * DN * DN.transpose();
}

/// Returns the matrix of 24 displacements that is `m` in each direction.
Matrix24 in_each_direction(const Matrix8& m) {
  Matrix24 full = Matrix24::Zero();
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < 8; ++b) full.block<3, 3>(3 * a, 3 * b).diagonal().setConstant(m(a, b));
  }
  return full;
}

/// Returns the matrix of 24 displacements whose 3 x 3 blocks are m(a, b) times `block`.
Matrix24 by_blocks(const Matrix8& m, const Eigen::Matrix3d& block) {
  Matrix24 full;
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < 8; ++b) full.block<3, 3>(3 * a, 3 * b) = m(a, b) * block;
  }
  return full;
}

/// Returns [e x], the cross product with the spin axis from the left.
Eigen::Matrix3d cross_with_axis() {
  Eigen::Matrix3d cross;
  cross << 0, 0, 1, 0, 0, 0, -1, 0, 0;
  return cross;
}

/// Adds the product of an element matrix with the element's corners to the forces of a sector, and
/// the matrix in the frames of its nodes to the blocks.
void add_with_load(
    const Ring& ring, int element, Matrix24 K, SectorBlocks& blocks, Eigen::VectorXd& w_0) {
  const Element& e = ring.mesh().elements[element];
  Matrix38 X;
  for (int a = 0; a < 8; ++a)
    X.col(a) = ring.mesh().X.col(e.node[a] % ring.mesh().nodes_per_sector());
  X = ring.in_element_frame(0, element, X);
  Vector24 f = K * X.reshaped();
  ring.turn_to_node_frames(0, element, f, &K);
  const std::array<int, 24>& dofs = ring.local_dofs(element);
  for (int k = 0; k < 24; ++k) {
    if (dofs[k] >= 0) w_0[dofs[k] % ring.sector_unknowns()] += f[k];
  }
  blocks.add(dofs, K);
}

void add_turned(const Ring& ring, int element, Matrix24 K, SectorBlocks& blocks) {
  Vector24 no_force = Vector24::Zero();
  ring.turn_to_node_frames(0, element, no_force, &K);
  blocks.add(ring.local_dofs(element), K);
}

}  // namespace

FlowInertia flow_inertia(const HexShape& shape,
                         const Materials& materials,
                         const Element& element) {
  FlowInertia sum{Matrix8::Zero(), Matrix8::Zero(), Matrix8::Zero()};
  const double density = materials.solids[element.solid].density;
  for (int q = 0; q < 8; ++q) {
    add_mass(shape.corners,
             density * shape.dV[q],
             kGauss * kXi[q],
             kGauss * kEta[q],
             kGauss * kZeta[q],
             sum);
  }
  for (const CordMass& cords : cord_masses(shape, materials, element)) {
    add_mass(shape.corners,
             cords.mass,
             kGauss * kXi[cords.point],
             kGauss * kEta[cords.point],
             cords.zeta,
             sum);
  }
  return {
      between_nodes(element, sum.M), between_nodes(element, sum.G), between_nodes(element, sum.W)};
}

SectorFlow::SectorFlow(const RingElements& elements)
    : M(elements.ring()),
      G(elements.ring()),
      W(elements.ring()),
      w_0(Eigen::VectorXd::Zero(elements.ring().sector_unknowns())) {
  const Ring& ring = elements.ring();
  for (int e = 0; e < ring.elements_per_sector(); ++e) {
    const FlowInertia inertia =
        flow_inertia(ring.shape(0, e), elements.materials(), ring.mesh().elements[e]);
    add_turned(ring, e, in_each_direction(inertia.M), M);
    add_turned(ring, e, in_each_direction(inertia.G - inertia.G.transpose()), G);
    add_with_load(ring, e, in_each_direction(inertia.W), W, w_0);
  }
}

SectorSpin::SectorSpin(const RingElements& elements)
    : M(elements.ring()),
      C(elements.ring()),
      MP(elements.ring()),
      w_0(Eigen::VectorXd::Zero(elements.ring().sector_unknowns())) {
  const Ring& ring = elements.ring();
  const Eigen::Matrix3d cross = cross_with_axis(), P = -cross * cross;
  for (int e = 0; e < ring.elements_per_sector(); ++e) {
    const Matrix8 m = mass(ring.shape(0, e), elements.materials(), ring.mesh().elements[e]);
    add_turned(ring, e, in_each_direction(m), M);
    add_turned(ring, e, by_blocks(m, cross), C);
    add_with_load(ring, e, by_blocks(m, P), MP, w_0);
  }
}

void spin_element(
    const RingElements& elements, int element, Matrix24& M, Matrix24& C, Matrix24& MP) {
  const Ring& ring = elements.ring();
  const Matrix8 m =
      mass(ring.shape(0, element), elements.materials(), ring.mesh().elements[element]);
  const Eigen::Matrix3d cross = cross_with_axis();
  M = in_each_direction(m);
  C = by_blocks(m, cross);
  MP = by_blocks(m, -cross * cross);
  Vector24 no_force = Vector24::Zero();
  for (Matrix24* matrix : {&M, &C, &MP}) ring.turn_to_node_frames(0, element, no_force, matrix);
}

SectorSpin::Harmonic SectorSpin::harmonic(int n) const {
  Harmonic at{M.harmonic(n), C.harmonic_of_skew(n), MP.harmonic(n)};
  at.W.lower() += (2.0 * n) * at.iG.lower() + (1.0 * n * n) * at.M.lower();
  at.iG.lower() = (2.0 * (at.iG.lower() + (1.0 * n) * at.M.lower())).eval();
  return at;
}

numerics::SymmetricMatrix flow_stiffness(const RingAssembly& assembly,
                                         const RingElements& elements) {
  const RingUnknowns& unknowns = assembly.unknowns();
  const Ring& ring = unknowns.ring();
  numerics::SymmetricMatrix W(*assembly.pattern());
  Vector24 no_force = Vector24::Zero();
  std::vector<std::vector<Matrix24>> of_width(ring.widths());
  for (int s = 0, global = 0; s < unknowns.sectors(); ++s) {
    std::vector<Matrix24>& known = of_width[ring.width(s)];
    for (int e = 0; e < ring.elements_per_sector(); ++e, ++global) {
      if (std::ssize(known) == e) {
        known.push_back(in_each_direction(
            flow_inertia(ring.shape(s, e), elements.materials(), ring.mesh().elements[e]).W));
        ring.turn_to_node_frames(s, e, no_force, &known.back());
      }
      Matrix24 We = known[e];
      unknowns.bring_in_order(s, e, We);
      W.add_element(global, We.data());
    }
  }
  return W;
}

Eigen::VectorXd flow_forces(const RingUnknowns& unknowns,
                            const RingElements& elements,
                            const Eigen::Matrix3Xd& u) {
  const Ring& ring = unknowns.ring();
  const Mesh& mesh = ring.mesh();
  const int n = mesh.nodes_per_sector(), S = ring.sectors();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(unknowns.size());
  std::vector<std::vector<Matrix8>> of_width(ring.widths());
  for (int s = 0; s < unknowns.sectors(); ++s) {
    std::vector<Matrix8>& known = of_width[ring.width(s)];
    for (int e = 0; e < ring.elements_per_sector(); ++e) {
      const Element& element = mesh.elements[e];
      if (std::ssize(known) == e)
        known.push_back(flow_inertia(ring.shape(s, e), elements.materials(), element).W);
      Matrix38 x;
      for (int a = 0; a < 8; ++a) {
        const int node = element.node[a] % n, plane = (s + element.node[a] / n) % S;
        x.col(a) = mesh.X.col(node) + u.col(plane * n + node);
      }
      x = ring.in_element_frame(s, e, x);
      Vector24 f = (x * known[e]).reshaped();
      ring.turn_to_node_frames(s, e, f, nullptr);
      unknowns.add_forces(s, e, f, sum);
    }
  }
  return sum;
}

}  // namespace latsch::fe_tire
