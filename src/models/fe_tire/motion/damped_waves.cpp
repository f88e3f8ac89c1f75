// SPDX-License-Identifier: Apache-2.0
// Damped modes of a tire that spins or whose rim moves (DampedTire::modes).
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numbers>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/history/dynamic_moduli.h"
#include "models/fe_tire/motion/damped_tire.h"
#include "models/fe_tire/motion/spinning_waves.h"

namespace latsch::fe_tire {
namespace {

using Complex = std::complex<double>;

constexpr int kMostWaveSteps = 60;
constexpr double kSameRoot = 1e-12;     // relative change of omega in the last step
constexpr double kBesideRoot = 1e-9;    // keeps the matrix from being exactly singular
constexpr double kNewWave = 1e-4;       // share of a wave of unit mass that others do not contain
constexpr double kWavesFollowed = 1.5;  // damped waves that are computed for each asked for

/// The equations (H.6) of one n in the coordinates of a few of its waves.
struct WaveEquations {
  Eigen::MatrixXcd K, G, M;                // Hermitian, G with the speed
  std::vector<Eigen::MatrixXcd> relaxing;  // K_r, Hermitian
  std::vector<PronyTerms> terms;           // one series for each K_r
  double passing = 0.0;                    // n Omega, rad/s

  Eigen::MatrixXcd stiffness(Complex omega) const {
    const Complex s = Complex(0.0, 1.0) * (omega - passing);
    Eigen::MatrixXcd A = K;
    for (std::size_t r = 0; r < relaxing.size(); ++r) {
      Complex share = 0.0;
      for (const PronyTerm& term : terms[r])
        share += term.beta * s * term.tau / (1.0 + s * term.tau);
      A += share * relaxing[r];
    }
    return A;
  }
};

struct WaveRoot {
  Complex omega;
  Eigen::VectorXcd q;
};

/// Returns the root of A(omega) q = 0 that grows out of one of the waves: Rayleigh quotients with
/// the stiffness at the last omega, and steps of inverse iteration.
Result<WaveRoot> root_from(const WaveEquations& wave, Eigen::VectorXcd q, double omega_start) {
  Complex omega = omega_start;
  for (int step = 0; step < kMostWaveSteps; ++step) {
    const Eigen::MatrixXcd A = wave.stiffness(omega);
    const Complex k = q.dot(A * q), g = q.dot(wave.G * q), m = q.dot(wave.M * q);
    const Complex root = std::sqrt(g * g + 4.0 * k * m);
    const Complex plus = (g + root) / (2.0 * m), minus = (g - root) / (2.0 * m);
    const Complex next = std::abs(plus - omega) < std::abs(minus - omega) ? plus : minus;
    const bool is_settled = std::abs(next - omega) <= kSameRoot * std::abs(next);
    omega = next;
    if (is_settled) return WaveRoot{omega, q};
    const Complex beside = omega * (1.0 + kBesideRoot);
    const Eigen::MatrixXcd Z = wave.stiffness(beside) + beside * wave.G - beside * beside * wave.M;
    q = Z.partialPivLu().solve((2.0 * beside * wave.M - wave.G) * q).eval();
    q.normalize();
  }
  return Failure{
      fmt::format("the damped frequency of a wave was not found in {} steps; it is near "
                  "{:.5g} Hz",
                  kMostWaveSteps,
                  std::abs(omega) / (2.0 * std::numbers::pi))};
}

Eigen::MatrixXcd projected(const numerics::BorderedHermitian& A, const Eigen::MatrixXcd& waves) {
  Eigen::MatrixXcd product(waves.rows(), waves.cols());
  A.multiply(waves, product);
  return waves.adjoint() * product;
}

/// Returns an orthonormal basis of the waves in the inner product of M. Without spin a wave with
/// and one against it have the same phi, and at a low speed nearly so.
Eigen::MatrixXcd orthonormal(const numerics::BorderedHermitian& M, const Eigen::MatrixXcd& waves) {
  Eigen::MatrixXcd basis(waves.rows(), 0), M_phi(waves.rows(), 1);
  for (Eigen::Index k = 0; k < waves.cols(); ++k) {
    Eigen::VectorXcd phi = waves.col(k);
    double rest = 0.0;
    // Twice, because the first pass leaves an error of rounding that is large beside a small rest.
    for (int pass = 0; pass < 2; ++pass) {
      M.multiply(phi, M_phi);
      phi -= basis * (basis.adjoint() * M_phi.col(0)).eval();
      M.multiply(phi, M_phi);
      rest = std::sqrt(std::max(0.0, phi.dot(M_phi.col(0)).real()));
    }
    if (rest <= kNewWave) continue;
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols(1) = phi / rest;
  }
  return basis;
}

/// Returns the real and then the imaginary parts, on all section planes, of the waves relative to
/// their rim.
std::vector<Mode> strained_shapes(const SpinningHarmonics& harmonics,
                                  const Mesh& mesh,
                                  const Eigen::Matrix3Xd& u,
                                  int n,
                                  const Eigen::MatrixXcd& waves) {
  const int nodes = mesh.nodes_per_sector();
  const Eigen::Index count = waves.cols();
  std::vector<Mode> shapes(2 * count);
  for (Eigen::Index k = 0; k < count; ++k) {
    Eigen::Matrix3Xcd section = harmonics.displacements(n, waves.col(k));
    if (harmonics.rim().motions(n) > 0) {
      const Eigen::Vector2cd q = waves.col(k).tail(2);
      for (int node = 0; node < nodes; ++node)
        section.col(node) -= rim_displacements(n, mesh.X.col(node) + u.col(node)) * q;
    }
    Eigen::Matrix3Xcd whole(3, mesh.nodes());
    for (int s = 0; s < mesh.sectors; ++s)
      whole.middleCols(s * nodes, nodes) = std::polar(1.0, n * mesh.angle(s)) * section;
    shapes[k].shape = whole.real();
    shapes[count + k].shape = whole.imag();
  }
  return shapes;
}

/// Returns phi_i* K phi_j of one sector from the products of real and imaginary parts on the ring.
Eigen::MatrixXcd hermitian_form(const Eigen::MatrixXd& K, int sectors) {
  const Eigen::Index m = K.rows() / 2;
  const auto aa = K.topLeftCorner(m, m), ab = K.topRightCorner(m, m);
  const auto ba = K.bottomLeftCorner(m, m), bb = K.bottomRightCorner(m, m);
  Eigen::MatrixXcd H(m, m);
  H.real() = (aa + bb) / sectors;
  H.imag() = (ab - ba) / sectors;
  return H;
}

}  // namespace

Result<std::vector<DecayingWave>> DampedTire::modes(const Inflated& spinning,
                                                    const Rim& rim,
                                                    int count) {
  FeTire::Impl& impl = *tire_.impl_;
  const Mesh& mesh = impl.ring.mesh();
  const double tolerance = impl.settings.mode_tolerance;
  const auto waves_of = [&](int many) -> Result<std::vector<FoundWave>> {
    const auto harmonics = SpinningHarmonics::about(impl.even_elements(), spinning, rim);
    if (!harmonics) return harmonics.failure();
    return lowest_waves(*harmonics, many, tolerance);
  };
  const auto first = waves_of(count);
  if (!first) return first.failure();
  // Rubber and cords have the moduli of frequencies on the tire.
  double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
  for (const FoundWave& wave : *first) {
    const double on_tire = std::abs(wave.omega - wave.n * spinning.spin);
    lowest = std::min(lowest, on_tire), highest = std::max(highest, on_tire);
  }
  const Materials relaxed = tire_.materials();
  tire_.set(stiffened(relaxed, losses_, std::sqrt(lowest * highest)));
  const auto basis = waves_of(static_cast<int>(std::ceil(kBasis * count)));
  tire_.set(relaxed);
  if (!basis) return basis.failure();
  const auto harmonics = SpinningHarmonics::about(impl.even_elements(), spinning, rim);
  if (!harmonics) return harmonics.failure();

  std::map<int, std::vector<const FoundWave*>> by_n;
  const int followed = std::min<int>(static_cast<int>(std::ceil(kWavesFollowed * count)),
                                     static_cast<int>(basis->size()));
  for (const FoundWave& wave : *basis) by_n[wave.n].push_back(&wave);
  std::vector<FoundWave> found;
  std::vector<Complex> roots;
  for (const auto& [n, of_n] : by_n) {
    const auto equations = harmonics->equations(n);
    if (!equations)
      return Failure{
          fmt::format("modes: nothing holds a wave of circumferential number {} of the "
                      "spinning tire with relaxed moduli",
                      n)};
    Eigen::MatrixXcd waves(equations->problem.K.size(), std::ssize(of_n));
    for (std::size_t k = 0; k < of_n.size(); ++k)
      waves.col(static_cast<Eigen::Index>(k)) = of_n[k]->phi;
    const Eigen::MatrixXcd phi = orthonormal(equations->problem.M, waves);
    Eigen::MatrixXcd M_waves(waves.rows(), waves.cols());
    equations->problem.M.multiply(waves, M_waves);
    const Eigen::MatrixXcd starts = phi.adjoint() * M_waves;
    WaveEquations wave{projected(equations->problem.K, phi),
                       projected(equations->problem.G, phi),
                       projected(equations->problem.M, phi),
                       {},
                       {},
                       n * spinning.spin};
    if (equations->soft.size() > 0) {
      const Eigen::MatrixXcd of_rim = phi.bottomRows(equations->soft.size());
      wave.K -= of_rim.adjoint() * equations->soft.asDiagonal() * of_rim;
    }
    auto parts = project(relaxed, spinning, strained_shapes(*harmonics, mesh, spinning.u, n, phi));
    if (!parts) return parts.failure();
    for (RelaxingStiffness& part : parts->parts) {
      wave.relaxing.push_back(hermitian_form(part.K, mesh.sectors));
      wave.terms.push_back(std::move(part.terms));
    }
    for (std::size_t k = 0; k < of_n.size(); ++k) {
      if (of_n[k] - basis->data() >= followed) continue;
      const auto root = root_from(wave, starts.col(static_cast<Eigen::Index>(k)), of_n[k]->omega);
      if (!root) return Failure{"modes: " + root.failure().reason};
      const double frequency = std::abs(root->omega) / (2.0 * std::numbers::pi);
      if (equations->soft.size() > 0 && frequency < kWholeWheel) continue;
      FoundWave& damped = found.emplace_back(*of_n[k]);
      damped.omega = std::copysign(std::abs(root->omega), root->omega.real());
      damped.phi = phi * root->q;
      roots.push_back(root->omega);
    }
  }
  std::vector<std::size_t> order(found.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return std::abs(roots[k]); });
  order.resize(std::min<std::size_t>(order.size(), count));
  std::vector<FoundWave> sorted;
  for (const std::size_t k : order) sorted.push_back(found[k]);
  auto named = named_waves(*harmonics, mesh, std::move(sorted), spinning.spin);
  std::vector<DecayingWave> modes;
  for (std::size_t k = 0; k < named.size(); ++k) {
    const Complex omega = roots[order[k]];
    named[k].frequency_on_tire = std::abs(omega - static_cast<double>(named[k].n) * spinning.spin) /
                                 (2.0 * std::numbers::pi);
    modes.push_back({std::move(named[k]), omega.imag() / std::abs(omega)});
  }
  return modes;
}

}  // namespace latsch::fe_tire
