// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/fe_tire/analysis/mode_label.h"
#include "models/fe_tire/ring/sector.h"
#include "numerics/sparse/lanczos.h"

namespace latsch::fe_tire {
namespace {

// Block size of Lanczos' method on the ring: solving for this many vectors together costs about as
// much as solving for one.
constexpr int kRingBlock = 8;
// Tolerances of Lanczos' method with inexact solves, in the sense of
// SolverSettings::mode_tolerance. The first is not smaller than the error of the single-precision
// operator. The second holds for spare modes, whose relative frequency error is about its square
// over the relative gap to the next frequency.
constexpr double kNearFrequency = 1e-3, kNearOfSpare = 0.02;
// Tolerance of the corrections by Davidson's method, as a multiple of
// SolverSettings::mode_tolerance. With this value the relative error of tire B's frequencies is
// 2e-9.
constexpr double kOfLoaded = 3.0;
// Number of modes computed at first for each circumferential number.
constexpr int kPerHarmonic = 3;

double to_hertz(double omega_squared) {
  return std::sqrt(std::max(0.0, omega_squared)) / (2.0 * std::numbers::pi);
}

/// A mode of circumferential number n: its frequency, Hz, and its complex shape over the unknowns
/// of a sector.
struct HarmonicMode {
  double frequency;
  int n;
  Eigen::VectorXcd phi;
  Eigen::Vector3d energy;  // kinetic energy by direction [x, y, z of sector frames]
};

Failure unfinished(const std::string& what, Eigen::Index found, int count, int solves) {
  return Failure{
      fmt::format("modes: Lanczos found {} of {} {} in {} solves", found, count, what, solves)};
}

/// Finds the lowest modes of circumferential number n. Returns a Failure if the harmonic tangent is
/// not positive definite or if not all modes are found.
Status solve_harmonic(const SectorBlocks& K,
                      const SectorBlocks& M,
                      int n,
                      int count,
                      double tolerance,
                      std::vector<HarmonicMode>& modes) {
  modes.clear();
  numerics::BandedCholesky cholesky;
  if (!cholesky.factorize(K.harmonic(n))) {
    return Failure{fmt::format(
        "modes: the inflated tire is not stable in circumferential number {}: it buckles; check "
        "pressure, thicknesses and moduli",
        n)};
  }
  const numerics::BandedHermitian mass = M.harmonic(n);
  numerics::EigenProblem<std::complex<double>> problem;
  problem.size = K.size();
  problem.solve = [&](Eigen::Ref<Eigen::MatrixXcd> X) { cholesky.solve(X); };
  problem.mass = [&](const Eigen::Ref<const Eigen::MatrixXcd>& X, Eigen::Ref<Eigen::MatrixXcd> Y) {
    mass.multiply(X, Y);
  };
  numerics::LanczosSettings settings;
  settings.count = std::min(count, K.size());
  settings.tolerance = tolerance;
  settings.block = 1;
  const auto pairs = numerics::lanczos(problem, settings);
  if (!pairs.converged) {
    const std::string what = fmt::format("modes of circumferential number {}", n);
    return unfinished(what, pairs.values.size(), settings.count, pairs.solves);
  }
  Eigen::MatrixXcd M_phi(K.size(), 1);
  for (int k = 0; k < pairs.values.size(); ++k) {
    const Eigen::VectorXcd phi = pairs.vectors.col(k);
    mass.multiply(phi, M_phi);
    modes.push_back({to_hertz(pairs.values[k]), n, phi, kinetic_energy(phi, M_phi.col(0))});
  }
  return {};
}

/// Returns true for n = 0 and, if S is even, for n = S / 2. Modes of these circumferential numbers
/// are single; all others occur as pairs.
bool single(int n, int sectors) { return n == 0 || 2 * n == sectors; }

/// Returns the real, mass-normalized shape on the section planes of `mesh`: the real or the
/// imaginary part of phi exp(i n theta_s).
Eigen::Matrix3Xd unfold(const Ring& ring,
                        const Mesh& mesh,
                        const HarmonicMode& mode,
                        bool imaginary) {
  const int S = ring.sectors(), n = mesh.nodes_per_sector();
  // The shape phi has unit mass over one sector. Summed over all S sectors, its real part has the
  // mass S / 2, or S for a single mode.
  const double scale = std::sqrt((single(mode.n, S) ? 1.0 : 2.0) / S);
  const Eigen::Matrix3Xd real = ring.expand(mode.phi.real()), imag = ring.expand(mode.phi.imag());
  Eigen::Matrix3Xd shape(3, S * n);
  for (int s = 0; s < S; ++s) {
    const double angle = mode.n * mesh.angle(s);
    const double c = scale * std::cos(angle), d = scale * std::sin(angle);
    if (imaginary) {
      shape.middleCols(s * n, n) = d * real + c * imag;
    } else {
      shape.middleCols(s * n, n) = c * real - d * imag;
    }
  }
  return shape;
}

/// Multiplies a complex vector by a phase factor that makes its largest entry real. The phase of an
/// eigenvector is arbitrary, and results must be reproducible.
void fix_phase(Eigen::VectorXcd& phi) {
  int largest;
  phi.cwiseAbs2().maxCoeff(&largest);
  phi *= std::conj(phi[largest]) / std::abs(phi[largest]);
}

/// Returns the frequency of the count-th lowest mode found, with pairs counted twice. Returns
/// infinity if there are fewer modes.
double cutoff(const std::vector<std::vector<HarmonicMode>>& by_n, int sectors, int count) {
  std::vector<double> all;
  for (const auto& modes : by_n) {
    for (const HarmonicMode& mode : modes) {
      all.insert(all.end(), single(mode.n, sectors) ? 1 : 2, mode.frequency);
    }
  }
  if (static_cast<int>(all.size()) < count) return std::numeric_limits<double>::infinity();
  std::nth_element(all.begin(), all.begin() + count - 1, all.end());
  return all[count - 1];
}

/// Returns shapes and names of the `count` lowest modes.
std::vector<Mode> named_modes(const Ring& ring,
                              const Mesh& mesh,
                              std::vector<HarmonicMode> found,
                              int count) {
  std::stable_sort(found.begin(), found.end(), [](const HarmonicMode& a, const HarmonicMode& b) {
    return a.frequency < b.frequency;
  });
  std::vector<Mode> modes;
  for (HarmonicMode& mode : found) {
    fix_phase(mode.phi);
    Mode result;
    result.frequency = mode.frequency;
    result.n = mode.n;
    result.type = type_of(mode.n, mode.energy);
    for (int member = 0; member < (single(mode.n, ring.sectors()) ? 1 : 2); ++member) {
      if (static_cast<int>(modes.size()) == count) break;
      result.shape = unfold(ring, mesh, mode, member == 1);
      modes.push_back(result);
    }
  }
  number_orders(modes);
  return modes;
}

}  // namespace

Failure no_tangent(const Ring& ring, int element) {
  return Failure{
      fmt::format("modes: the state has no tangent: {} is inverted or its law has no "
                  "value there; check pressure, deflection, thicknesses and moduli",
                  ring.place(element))};
}

Result<std::vector<Mode>> harmonic_modes(const RingElements& elements,
                                         const Mesh& mesh,
                                         const Inflated& inflated,
                                         int count,
                                         double tolerance) {
  const Ring& ring = elements.ring();
  SectorBlocks K(ring);
  Eigen::VectorXd f, alpha = inflated.alpha;
  int worst = 0;
  if (!assemble_sector(
          elements, ring.compress(inflated.u), inflated.pressure, alpha, f, &K, &worst)) {
    return no_tangent(ring, worst);
  }
  const SectorBlocks M = sector_mass(elements);
  const int S = ring.sectors();

  std::vector<std::vector<HarmonicMode>> by_n;
  const auto solve = [&](int n, int modes) {
    return solve_harmonic(K, M, n, modes, tolerance, by_n[n]);
  };
  // Number of successive harmonics whose lowest mode lies above all requested modes.
  int beyond = 0;
  for (int n = 0; n <= S / 2 && beyond < 2; ++n) {
    by_n.emplace_back();
    if (const Status done = solve(n, kPerHarmonic); !done) return done.failure();
    beyond = by_n[n].front().frequency > cutoff(by_n, S, count) ? beyond + 1 : 0;
  }
  // If all modes computed for a harmonic are among the lowest, this harmonic may have more of them.
  for (int n = 0; n < static_cast<int>(by_n.size()); ++n) {
    for (int known = kPerHarmonic;
         known < K.size() && by_n[n].back().frequency < cutoff(by_n, S, count);
         known *= 2) {
      if (const Status done = solve(n, 2 * known); !done) return done.failure();
    }
  }
  std::vector<HarmonicMode> found;
  for (const auto& modes : by_n) found.insert(found.end(), modes.begin(), modes.end());
  return named_modes(ring, mesh, std::move(found), count);
}

namespace {

/// Computes modes of the ring as vectors of its unknowns.
Result<numerics::EigenPairs<double>> ring_pairs(
    const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& solve,
    const numerics::SymmetricMatrix& M,
    const numerics::LanczosSettings& settings) {
  numerics::EigenProblem<double> problem;
  problem.size = M.size();
  problem.solve = solve;
  problem.mass = [&](const Eigen::Ref<const Eigen::MatrixXd>& X, Eigen::Ref<Eigen::MatrixXd> Y) {
    M.multiply(X, Y);
  };
  auto pairs = numerics::lanczos(problem, settings);
  if (!pairs.converged)
    return unfinished("modes", pairs.values.size(), settings.count, pairs.solves);
  return pairs;
}

std::vector<Mode> modes_of(const RingAssembly& assembly,
                           const numerics::EigenPairs<double>& pairs) {
  const RingUnknowns& unknowns = assembly.unknowns();
  std::vector<Mode> modes(pairs.values.size());
  for (int k = 0; k < pairs.values.size(); ++k) {
    modes[k].frequency = to_hertz(pairs.values[k]);
    modes[k].shape = unknowns.expand(pairs.vectors.col(k)) / std::sqrt(unknowns.multiplicity());
  }
  return modes;
}

}  // namespace

Result<std::vector<Mode>> ring_modes(const RingAssembly& assembly,
                                     const numerics::Factorization& factor,
                                     const numerics::SymmetricMatrix& M,
                                     int count,
                                     double tolerance) {
  const auto solve = [&](Eigen::Ref<Eigen::MatrixXd> X) { factor.solve_columns(X); };
  const auto pairs = ring_pairs(
      solve, M, {.count = std::min(count, M.size()), .tolerance = tolerance, .block = kRingBlock});
  if (!pairs) return pairs.failure();
  return modes_of(assembly, *pairs);
}

LoadedModes::LoadedModes(const RingAssembly& assembly,
                         const numerics::SymmetricMatrix& K,
                         const numerics::Factorization& factor,
                         const numerics::SymmetricMatrix& M,
                         const SolverSettings& settings)
    : assembly_(assembly), K_(K), M_(M), factor_(factor), tolerance_(settings.mode_tolerance) {}

Result<std::vector<double>> LoadedModes::approach(int count, int spare) {
  search_.reset();
  std::vector<double> frequencies;
  const auto solve = [&factor = factor_](Eigen::Ref<Eigen::MatrixXd> X) {
    factor.solve_roughly(X);
  };
  const auto near = ring_pairs(solve,
                               M_,
                               {.count = std::min(count, M_.size()),
                                .tolerance = kNearFrequency,
                                .spare = spare,
                                .spare_tolerance = kNearOfSpare,
                                .block = kRingBlock});
  if (near) {
    search_.emplace(K_, M_, solve, near->vectors);
    for (const double omega_squared : near->values) frequencies.push_back(to_hertz(omega_squared));
    return frequencies;
  }
  const auto modes = find(count);
  if (!modes) return modes.failure();
  for (const Mode& mode : *modes) frequencies.push_back(mode.frequency);
  return frequencies;
}

Result<std::vector<Mode>> LoadedModes::find(int count) {
  if (search_) {
    const auto pairs = search_->find(count, kOfLoaded * tolerance_);
    if (pairs.converged) return modes_of(assembly_, pairs);
    search_.reset();
  }
  return ring_modes(assembly_, factor_, M_, count, tolerance_);
}

Eigen::VectorXd nodal_masses(const RingElements& elements) {
  const Ring& ring = elements.ring();
  const Mesh& mesh = ring.mesh();
  const int n = mesh.nodes_per_sector(), S = ring.sectors();
  // Nodal masses of one sector of every width: nodes of its own section plane first, then those of
  // the next plane.
  std::vector<Eigen::VectorXd> of_width(ring.widths());
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(S) * n);
  for (int s = 0; s < S; ++s) {
    Eigen::VectorXd& sector = of_width[ring.width(s)];
    if (sector.size() == 0) {
      sector.setZero(2 * n);
      for (int e = 0; e < ring.elements_per_sector(); ++e) {
        const Matrix8 m = mass(ring.shape(s, e), elements.materials(), mesh.elements[e]);
        for (int a = 0; a < 8; ++a) sector[mesh.elements[e].node[a]] += m.row(a).sum();
      }
    }
    masses.segment(s * n, n) += sector.head(n);
    masses.segment((s + 1) % S * n, n) += sector.tail(n);
  }
  return masses;
}

}  // namespace latsch::fe_tire
