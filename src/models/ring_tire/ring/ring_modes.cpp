// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/ring_modes.h"

#include <Eigen/Eigenvalues>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/belt/inner_forces.h"

namespace latsch::ring_tire {
namespace {

using Complex = std::complex<double>;
using Eigen::Matrix4cd;
using Eigen::Matrix4d;

/// Returns the directions of the displacement components of node k as columns: e_r, e_t, a, and
/// torsion.
Matrix4d axes(const RimFrame& rim, const NodeAngles& angles, int k) {
  Matrix4d Q = Matrix4d::Identity();
  Q.block<3, 1>(0, 0) = angles.radial(rim, k);
  Q.block<3, 1>(0, 1) = angles.tangential(rim, k);
  Q.block<3, 1>(0, 2) = rim.a;
  return Q;
}

/// The unloaded ring at rest, from which modes are computed.
struct RestingRing {
  explicit RestingRing(const RingParameters& ring)
      : angles(ring.nodes),
        rim(RimFrame::of(WheelMotion())),
        q(4, ring.nodes),
        K(ring.nodes),
        C(ring.nodes) {
    const double radius = ring.belt.radius * node_radius_over_knot_radius(ring.nodes);
    for (int k = 0; k < ring.nodes; ++k)
      q.col(k) << radius * angles.radial(rim, k), ring.belt.conicity;
    RingParameters even = ring;
    even.uniformity = {};
    InnerForces inner(even);
    inner.find_stiffness(q, rim, {}, 1.0).turn_back(rim, K);
    if (inner.belt().damped()) inner.find_belt_damping(q, rim).turn_back(rim, C);
  }

  /// Returns K(n) of (20), or the corresponding matrix of the damping C, for amplitudes at the
  /// belt's knots. It is computed at a node far enough from the first and the last one that the
  /// blocks to both sides are stored.
  Matrix4cd harmonic(const CyclicBand& K, int n) const {
    const int N = angles.nodes(), at = CyclicBand::kReach;
    const Matrix4d Q = axes(rim, angles, at);
    Matrix4cd sum = (Q.transpose() * K.block(at, 0) * Q).cast<Complex>();
    for (int j = 1; j <= CyclicBand::kReach; ++j) {
      const double phase = 2.0 * std::numbers::pi * n * j / N;
      const Matrix4d after = Q.transpose() * K.block(at, j) * axes(rim, angles, at + j);
      const Matrix4d before =
          Q.transpose() * K.block(at - j, j).transpose() * axes(rim, angles, at - j);
      sum += after * std::polar(1.0, phase) + before * std::polar(1.0, -phase);
    }
    // e_r and e_t rotate from node to node, so a wave n along them consists of waves n + 1 and n -
    // 1 along fixed axes.
    const Matrix4cd B = knots_over_nodes(n);
    const Matrix4cd inverse = B.inverse();
    return inverse.adjoint() * sum * inverse;
  }

  /// Returns the matrix B of belt_curve.h for waves with the circumferential number n.
  Matrix4cd knots_over_nodes(int n) const {
    const int N = angles.nodes();
    const Matrix4d Q = axes(rim, angles, 0);
    const double phase = 2.0 * std::numbers::pi * n / N;
    const Matrix4d after = Q.transpose() * axes(rim, angles, 1);
    const Matrix4d before = Q.transpose() * axes(rim, angles, N - 1);
    return (4.0 * Matrix4cd::Identity() + after * std::polar(1.0, phase) +
            before * std::polar(1.0, -phase)) /
           6.0;
  }

  NodeAngles angles;
  RimFrame rim;
  NodeValues q;
  CyclicBand K, C;  // C of (30)
};

/// Losses of waves with the circumferential number n.
struct Losses {
  Eigen::Vector4d damping, maxwell;  // damping and Maxwell stiffness of the sidewall at a node
  double tau;
  Matrix4cd of_belt;

  Losses(const RingParameters& ring, const Matrix4cd& belt)
      : tau(ring.sidewall.time_constant), of_belt(belt) {
    const Sidewall& s = ring.sidewall;
    const double share = 2.0 * std::numbers::pi * ring.belt.radius / ring.nodes;
    damping =
        share * Eigen::Vector4d(
                    s.radial.damping, s.tangential.damping, s.lateral.damping, s.torsion_damping);
    const auto maxwell_of = [&](const SidewallElement& e) {
      return share * e.stiffness * e.dynamic_stiffening;
    };
    maxwell << maxwell_of(s.radial), maxwell_of(s.tangential), maxwell_of(s.lateral), 0.0;
  }
};

RingMode mode_of(double squared, const Eigen::Vector4cd& shape, const Losses& losses) {
  const Eigen::Vector4d weight = shape.cwiseAbs2();  // normalizes the shape to unit modal mass
  const double lost = losses.damping.dot(weight) + shape.dot(losses.of_belt * shape).real();
  const auto [frequency, damping] =
      damped_mode(squared, lost, losses.maxwell.dot(weight), losses.tau);
  RingMode mode;
  mode.frequency = frequency;
  mode.damping = damping;
  for (int i = 0; i < 4; ++i) mode.shape[static_cast<std::size_t>(i)] = std::abs(shape[i]);
  return mode;
}

/// Appends the modes of one plane. In the ring at rest, motion in the plane of the rim (u_r, u_t)
/// and lateral motion (u_y, ψ) are independent.
void append_plane(const Matrix4cd& K,
                  const Eigen::Vector4d& mass,
                  bool lateral,
                  int n,
                  const Losses& losses,
                  std::vector<RingMode>& modes) {
  const int first = lateral ? 2 : 0;
  // If the sections have no inertia about the belt, their torsion follows statically from the
  // lateral motion.
  if (lateral && mass[3] == 0.0) {
    Eigen::Vector4cd shape = Eigen::Vector4cd::Zero();
    const bool stiff = std::abs(K(3, 3)) > 0.0;
    shape[2] = 1.0 / std::sqrt(mass[2]);
    shape[3] = stiff ? -K(3, 2) / K(3, 3) * shape[2] : Complex(0.0);
    const Complex condensed = K(2, 2) - (stiff ? K(2, 3) * K(3, 2) / K(3, 3) : Complex(0.0));
    modes.push_back(mode_of(condensed.real() / mass[2], shape, losses));
    modes.back().n = n;
    modes.back().lateral = true;
    return;
  }
  const Eigen::Vector2d scale = mass.segment<2>(first).cwiseSqrt().cwiseInverse();
  const Eigen::Matrix2cd A = scale.asDiagonal() * K.block<2, 2>(first, first) * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2cd> solver(A);
  for (int i = 0; i < 2; ++i) {
    Eigen::Vector4cd shape = Eigen::Vector4cd::Zero();
    shape.segment<2>(first) = scale.asDiagonal() * solver.eigenvectors().col(i);
    modes.push_back(mode_of(solver.eigenvalues()[i], shape, losses));
    modes.back().n = n;
    modes.back().lateral = lateral;
    modes.back().order = i + 1;
  }
}

/// Appends the modes of all four components, for coupled plies or a conical belt, which couple the
/// two planes. A mode is named after the plane in which it has more kinetic energy.
void append_mixed(const Matrix4cd& K,
                  const Eigen::Vector4d& mass,
                  int n,
                  const Losses& losses,
                  std::vector<RingMode>& modes) {
  assert(mass[3] > 0.0);
  const Eigen::Vector4d scale = mass.cwiseSqrt().cwiseInverse();
  const Matrix4cd A = scale.asDiagonal() * K * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix4cd> solver(A);
  std::array<int, 2> found = {0, 0};
  std::vector<RingMode> of_plane[2];
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector4cd own = solver.eigenvectors().col(i);
    const bool lateral = own.tail<2>().squaredNorm() > 0.5;
    RingMode mode = mode_of(solver.eigenvalues()[i], scale.asDiagonal() * own, losses);
    mode.n = n;
    mode.lateral = lateral;
    mode.order = ++found[lateral ? 1 : 0];
    of_plane[lateral ? 1 : 0].push_back(mode);
  }
  for (const auto& plane : of_plane) modes.insert(modes.end(), plane.begin(), plane.end());
}

}  // namespace

DampedMode damped_mode(double squared, double damping, double maxwell, double time_constant) {
  double omega = std::sqrt(std::max(squared, 0.0));
  const auto x = [&] { return omega * time_constant * omega * time_constant; };
  // This fixed-point iteration converges, because the derivative of the expression by ω² is smaller
  // than 1. After 30 rounds the result is exact to the last bit.
  for (int round = 0; maxwell > 0.0 && round < 30; ++round)
    omega = std::sqrt(std::max(squared + maxwell * x() / (1.0 + x()), 0.0));
  return {.frequency = omega / (2.0 * std::numbers::pi),
          .damping = omega > 0.0 ? (damping + maxwell * time_constant / (1.0 + x())) / (2.0 * omega)
                                 : 0.0};
}

std::vector<RingMode> unloaded_modes(const RingParameters& ring, int most_waves) {
  assert(most_waves <= ring.nodes / 2);
  const RestingRing resting(ring);
  const double m = ring.belt.mass / ring.nodes;
  const double J =
      ring.belt.torsion_inertia * 2.0 * std::numbers::pi * ring.belt.radius / ring.nodes;
  std::vector<RingMode> modes;
  for (int n = 0; n <= most_waves; ++n) {
    const Matrix4cd K = resting.harmonic(resting.K, n);
    const Losses losses(ring, resting.harmonic(resting.C, n));
    if (ring.belt.bending_twist != 0.0 || ring.belt.conicity != 0.0) {
      append_mixed(K, {m, m, m, J}, n, losses, modes);
      continue;
    }
    append_plane(K, {m, m, m, J}, false, n, losses, modes);
    append_plane(K, {m, m, m, J}, true, n, losses, modes);
  }
  return modes;
}

const RingMode& find_mode(const std::vector<RingMode>& modes, int n, bool lateral, int order) {
  for (const RingMode& mode : modes)
    if (mode.n == n && mode.lateral == lateral && mode.order == order) return mode;
  assert(false && "no such mode");
  return modes.front();
}

}  // namespace latsch::ring_tire
