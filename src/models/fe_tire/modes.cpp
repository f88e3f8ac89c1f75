// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/fe_tire/mode_label.h"
#include "models/fe_tire/sector.h"
#include "numerics/lanczos.h"

namespace latsch::fe_tire {
namespace {

constexpr double kTolerance =
    1e-7;                        // of Lanczos' inverted residual; a frequency's error is its square
constexpr int kPerHarmonic = 6;  // modes of one circumferential number computed at a time

double to_hertz(double omega_squared) {
  return std::sqrt(std::max(0.0, omega_squared)) / (2.0 * std::numbers::pi);
}

/// One mode of circumferential number n: its complex shape over the unknowns of a sector.
struct HarmonicMode {
  double frequency;
  int n;
  Eigen::VectorXcd phi;
};

/// The lowest modes of circumferential number n; false where the harmonic tangent is not positive
/// definite.
bool solve_harmonic(const SectorBlocks& K,
                    const SectorBlocks& M,
                    int n,
                    int count,
                    std::vector<HarmonicMode>& modes) {
  numerics::BandedCholesky cholesky;
  if (!cholesky.factorize(K.harmonic(n))) return false;
  const numerics::BandedHermitian mass = M.harmonic(n);
  numerics::EigenProblem<std::complex<double>> problem;
  problem.size = K.size();
  problem.solve = [&](Eigen::Ref<Eigen::MatrixXcd> X) { cholesky.solve(X); };
  problem.mass = [&](const Eigen::Ref<const Eigen::MatrixXcd>& X, Eigen::Ref<Eigen::MatrixXcd> Y) {
    mass.multiply(X, Y);
  };
  numerics::LanczosSettings settings;
  settings.count = std::min(count, K.size());
  settings.tolerance = kTolerance;
  settings.block = 1;
  const auto pairs = numerics::lanczos(problem, settings);
  for (int k = 0; k < pairs.values.size(); ++k) {
    modes.push_back({to_hertz(pairs.values[k]), n, pairs.vectors.col(k)});
  }
  return true;
}

/// Modes of n = 0 and, where S is even, n = S / 2 are single; all others are pairs.
bool single(int n, int sectors) { return n == 0 || 2 * n == sectors; }

/// Real shape over the ring: the real or the imaginary part of phi exp(i n s 2 pi / S),
/// mass-normalized.
Eigen::VectorXd unfold(const HarmonicMode& mode, int sectors, bool imaginary) {
  const int m = static_cast<int>(mode.phi.size());
  // phi has unit mass over one sector; a real part summed over all sectors has S / 2 of it, a
  // single mode S.
  const double scale = std::sqrt((single(mode.n, sectors) ? 1.0 : 2.0) / sectors);
  Eigen::VectorXd x(m * sectors);
  for (int s = 0; s < sectors; ++s) {
    const double angle = 2.0 * std::numbers::pi * mode.n * s / sectors;
    const Eigen::VectorXcd turned = mode.phi * std::polar(scale, angle);
    if (imaginary) {
      x.segment(s * m, m) = turned.imag();
    } else {
      x.segment(s * m, m) = turned.real();
    }
  }
  return x;
}

/// Kinetic energy in the three directions of the sector frame, by the magnitudes at the nodes.
Eigen::Vector3d directional_energy(const Eigen::VectorXcd& phi) {
  Eigen::Vector3d energy = Eigen::Vector3d::Zero();
  for (int k = 0; k < phi.size(); ++k) energy[k % 3] += std::norm(phi[k]);
  return energy;
}

/// A complex vector's phase is arbitrary: turn the largest entry onto the real axis, so that
/// results repeat.
void fix_phase(Eigen::VectorXcd& phi) {
  int largest;
  phi.cwiseAbs2().maxCoeff(&largest);
  phi *= std::conj(phi[largest]) / std::abs(phi[largest]);
}

}  // namespace

Result<std::vector<Mode>> harmonic_modes(const Ring& ring,
                                         const Materials& materials,
                                         const Inflated& inflated,
                                         int count) {
  const int S = ring.sectors();
  SectorBlocks K(ring);
  Eigen::VectorXd f, alpha = inflated.alpha;
  assemble_sector(
      ring, materials, ring.compress(inflated.u), inflated.pressure, alpha, f, &K, nullptr);
  const SectorBlocks M = sector_mass(ring, materials);

  std::vector<HarmonicMode> found;
  int enough = 0;  // successive harmonics that held none of the lowest
  for (int n = 0; n <= S / 2 && enough < 2; ++n) {
    const std::size_t first = found.size();
    if (!solve_harmonic(K, M, n, kPerHarmonic, found)) {
      return Failure{fmt::format(
          "modes: the inflated tire is not stable in circumferential number {} at {:.4g} bar: it "
          "buckles; check pressure, thicknesses and moduli",
          n,
          inflated.pressure / 1e5)};
    }
    std::vector<double> all;
    for (const HarmonicMode& mode : found) {
      all.insert(all.end(), single(mode.n, S) ? 1 : 2, mode.frequency);
    }
    std::sort(all.begin(), all.end());
    const bool complete = static_cast<int>(all.size()) >= count;
    enough = complete && found[first].frequency > all[count - 1] ? enough + 1 : 0;
  }
  std::stable_sort(found.begin(), found.end(), [](const HarmonicMode& a, const HarmonicMode& b) {
    return a.frequency < b.frequency;
  });

  std::vector<Mode> modes;
  for (HarmonicMode& mode : found) {
    if (static_cast<int>(modes.size()) >= count) break;
    fix_phase(mode.phi);
    Mode result;
    result.frequency = mode.frequency;
    result.n = mode.n;
    result.type = type_of(mode.n, directional_energy(mode.phi));
    for (int member = 0; member < (single(mode.n, S) ? 1 : 2); ++member) {
      result.shape = ring.expand(unfold(mode, S, member == 1));
      modes.push_back(result);
    }
  }
  number_orders(modes);
  return modes;
}

Result<std::vector<double>> ring_frequencies(const numerics::Factorization& factor,
                                             const numerics::SymmetricMatrix& M,
                                             int count,
                                             const Eigen::MatrixXd& start,
                                             Eigen::MatrixXd& shapes) {
  numerics::EigenProblem<double> problem;
  problem.size = M.size();
  problem.solve = [&](Eigen::Ref<Eigen::MatrixXd> X) { factor.solve_columns(X); };
  problem.mass = [&](const Eigen::Ref<const Eigen::MatrixXd>& X, Eigen::Ref<Eigen::MatrixXd> Y) {
    M.multiply(X, Y);
  };
  numerics::LanczosSettings settings;
  settings.count = std::min(count, M.size());
  settings.tolerance = kTolerance;
  const auto pairs = numerics::lanczos(problem, settings, start);
  if (!pairs.converged) {
    return Failure{fmt::format("modes: Lanczos found {} of {} modes in {} solves",
                               pairs.values.size(),
                               count,
                               pairs.solves)};
  }
  shapes = pairs.vectors;
  std::vector<double> frequencies;
  for (double value : pairs.values) frequencies.push_back(to_hertz(value));
  return frequencies;
}

Eigen::MatrixXd shape_columns(const Ring& ring, const std::vector<Mode>& modes) {
  Eigen::MatrixXd columns(ring.unknowns(), modes.size());
  for (std::size_t k = 0; k < modes.size(); ++k) {
    columns.col(static_cast<int>(k)) = ring.compress(modes[k].shape);
  }
  return columns;
}

}  // namespace latsch::fe_tire
