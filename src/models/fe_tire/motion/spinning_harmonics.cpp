// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/spinning_harmonics.h"

#include <algorithm>
#include <complex>
#include <numbers>
#include <utility>

#include "models/fe_tire/analysis/modes.h"

namespace latsch::fe_tire {
namespace {

using Complex = std::complex<double>;
using ComplexMatrix24 = Eigen::Matrix<Complex, 24, 24>;
using RimColumns = Eigen::Matrix<Complex, 24, 2>;

// Frequency of a free wheel on the springs that keep it in its place. Frequencies are corrected for
// them; softer springs would only be lost in rounding.
constexpr double kSoft = 0.1;  // Hz

/// An element of a sector as one harmonic sees it.
struct ElementWave {
  RimColumns T;                        // displacements of its 24 unknowns by the rim
  Eigen::Matrix<Complex, 24, 1> turn;  // phase of each of its 24 unknowns
};

ElementWave element_wave(const Ring& ring, int element, int n) {
  const Mesh& mesh = ring.mesh();
  ElementWave wave;
  wave.T.setZero();
  const Complex next = std::polar(1.0, 2.0 * std::numbers::pi * n / ring.sectors());
  for (int a = 0; a < 8; ++a) {
    const int node = mesh.elements[element].node[a], own = node % mesh.nodes_per_sector();
    const Complex phase = node == own ? Complex(1.0) : next;
    wave.turn.segment<3>(3 * a).setConstant(phase);
    if (ring.sector_dof(own) < 0)
      wave.T.middleRows<3>(3 * a) = phase * rim_displacements(n, mesh.X.col(own));
  }
  return wave;
}

/// Adds the rim's columns of an element matrix, Hermitian and in node frames.
void add_border(const Ring& ring,
                int element,
                const ElementWave& wave,
                const ComplexMatrix24& H,
                numerics::BorderedHermitian& sum) {
  const RimColumns HT = H * wave.T;
  const std::array<int, 24>& dofs = ring.local_dofs(element);
  for (int k = 0; k < 24; ++k) {
    if (dofs[k] >= 0)
      sum.border.row(dofs[k] % ring.sector_unknowns()) += std::conj(wave.turn[k]) * HT.row(k);
  }
  sum.corner += wave.T.adjoint() * HT;
}

bool touches_rim(const Ring& ring, int element) {
  return std::ranges::any_of(ring.local_dofs(element), [](int dof) { return dof < 0; });
}

}  // namespace

SpinningHarmonics::SpinningHarmonics(const RingElements& elements, const Rim& rim, double speed)
    : elements_(&elements),
      rim_(rim),
      speed_(speed),
      spin_(elements),
      flow_(elements),
      K_(elements.ring()) {}

Result<SpinningHarmonics> SpinningHarmonics::about(const RingElements& elements,
                                                   const Inflated& state,
                                                   const Rim& rim) {
  SpinningHarmonics harmonics(elements, rim, state.spin);
  if (const Status done = harmonics.evaluate(state); !done) return done.failure();
  return harmonics;
}

Status SpinningHarmonics::evaluate(const Inflated& state) {
  const Ring& ring = elements_->ring();
  const Eigen::VectorXd x = ring.compress(state.u);
  Eigen::VectorXd f, alpha = state.alpha;
  int worst = 0;
  if (!assemble_sector(*elements_, x, state.pressure, alpha, f, &K_, &worst))
    return no_tangent(ring, worst);
  if (rim_.motion == RimMotion::held) return {};
  mass_ = mass_properties(*elements_, state.u);
  u_ = state.u;
  for (int e = 0; e < ring.elements_per_sector(); ++e) {
    if (!touches_rim(ring, e)) continue;
    RimElement& at = rim_elements_.emplace_back();
    at.element = e;
    Matrix24 MP;
    spin_element(*elements_, e, at.M, at.C, MP);
  }
  return {};
}

std::optional<SpinningHarmonics::Equations> SpinningHarmonics::equations(int n) const {
  if (auto found = with_inertia(n, spin_.harmonic(n))) return found;
  if (rim_.motions(n) > 0) return std::nullopt;
  return with_inertia(n, {flow_.M.harmonic(n), flow_.G.harmonic_of_skew(n), flow_.W.harmonic(n)});
}

std::optional<SpinningHarmonics::Equations> SpinningHarmonics::with_inertia(
    int n, const SectorSpin::Harmonic& at) const {
  const int width = rim_.motions(n);
  using numerics::BorderedHermitian;
  Equations equations{{BorderedHermitian(K_.harmonic(n), width),
                       BorderedHermitian(at.iG, width),
                       BorderedHermitian(at.M, width)},
                      {},
                      Eigen::VectorXd::Zero(width)};
  auto& [K, G, M] = equations.problem;
  K.banded.lower() -= (speed_ * speed_) * at.W.lower();
  G.banded.lower() *= speed_;
  if (width > 0) {
    add_rim(n, equations);
    // The force that holds the tire's nodes in a motion of the whole is what the rim exerts on
    // them.
    const Eigen::MatrixXcd moved = motions_of_whole(n);
    K.banded.multiply(moved, K.border);
    K.border *= -1.0;
    K.corner = -moved.adjoint() * K.border;
    K.corner = (0.5 * (K.corner + K.corner.adjoint())).eval();
    const RimMatrices rim = rim_matrices(n, rim_);
    const Eigen::Vector2d springs = rim.springs / ring().sectors() + equations.soft;
    K.corner += springs.cast<Complex>().asDiagonal();
  }
  if (!equations.K_factor.factorize(K)) return std::nullopt;
  return equations;
}

Eigen::MatrixXcd SpinningHarmonics::motions_of_whole(int n) const {
  const Mesh& mesh = ring().mesh();
  Eigen::MatrixXcd moved(ring().sector_unknowns(), 2);
  for (int node = 0; node < mesh.nodes_per_sector(); ++node) {
    const int first = ring().sector_dof(node);
    if (first >= 0)
      moved.middleRows<3>(first) = rim_displacements(n, mesh.X.col(node) + u_.col(node));
  }
  return moved;
}

void SpinningHarmonics::add_rim(int n, Equations& equations) const {
  auto& G = equations.problem.G;
  auto& M = equations.problem.M;
  const Complex i(0.0, 1.0);
  const double waves = n;
  for (const RimElement& at : rim_elements_) {
    const ElementWave wave = element_wave(ring(), at.element, n);
    const ComplexMatrix24 iC = i * at.C.cast<Complex>();
    const ComplexMatrix24 mass = at.M.cast<Complex>();
    add_border(ring(), at.element, wave, 2.0 * speed_ * (iC + waves * mass), G);
    add_border(ring(), at.element, wave, mass, M);
  }
  const double S = ring().sectors();
  const RimMatrices rim = rim_matrices(n, rim_);
  M.corner += (rim.M / S).cast<Complex>().asDiagonal();
  G.corner += (speed_ * rim.G / S).cast<Complex>().asDiagonal();
  const double omega = 2.0 * std::numbers::pi * kSoft;
  const Eigen::Vector2d tire(mass_.mass, n == 0 ? mass_.spin_inertia : mass_.diametral_inertia);
  equations.soft = omega * omega / S * (tire + rim.M);
}

Eigen::Matrix3Xcd SpinningHarmonics::displacements(int n, const Eigen::VectorXcd& phi) const {
  const int m = ring().sector_unknowns();
  const Eigen::VectorXcd own = phi.head(m);
  Eigen::Matrix3Xcd u = ring().expand(own.real()).cast<Complex>() +
                        Complex(0.0, 1.0) * ring().expand(own.imag()).cast<Complex>();
  if (rim_.motions(n) == 0) return u;
  const Eigen::Vector2cd q = phi.tail(2);
  for (int node = 0; node < u.cols(); ++node) {
    if (ring().sector_dof(node) < 0)
      u.col(node) = rim_displacements(n, ring().mesh().X.col(node)) * q;
  }
  return u;
}

}  // namespace latsch::fe_tire
