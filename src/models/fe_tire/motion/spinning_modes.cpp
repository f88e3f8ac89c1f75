// SPDX-License-Identifier: Apache-2.0
// Modes of the spinning tire by circumferential numbers (SpinningTire::modes). A number needs no
// search if K + omega G - omega^2 M is positive definite at the highest wanted frequency of both
// signs, because then it has no mode below; so no number is left out by guess.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/analysis/mode_label.h"
#include "models/fe_tire/motion/spinning_harmonics.h"
#include "models/fe_tire/motion/spinning_tire.h"
#include "models/fe_tire/motion/spinning_waves.h"
#include "models/fe_tire/motion/standing_wave.h"

namespace latsch::fe_tire {
namespace {

constexpr int kPerSense = 3;          // modes of one number and sense computed at first
constexpr double kPair = 1e-6;        // relative distance of the frequencies of a pair at rest
constexpr double kNearCutoff = 1e-9;  // relative distance of frequencies that count as equal

double in_hertz(double omega) { return omega / (2.0 * std::numbers::pi); }

/// True for n = 0 and n = S / 2, in which both signs of omega are the same motion.
bool is_one_motion(int n, int sectors) { return n == 0 || 2 * n == sectors; }

/// Returns the frequency without the springs that keep a free wheel in its place: the root of the
/// quadratic form of the shape nearest to omega. Its error is of second order in theirs.
double without_soft_springs(const SpinningHarmonics::Equations& equations,
                            const Eigen::VectorXcd& phi,
                            double omega) {
  const auto& [K, G, M] = equations.problem;
  const auto form = [&](const numerics::BorderedHermitian& A) {
    Eigen::MatrixXcd product(phi.size(), 1);
    A.multiply(phi, product);
    return phi.dot(product.col(0)).real();
  };
  const Eigen::Index width = equations.soft.size();
  const double soft = equations.soft.dot(phi.tail(width).cwiseAbs2());
  const double k = form(K) - soft, g = form(G), m = form(M);
  const double root = std::sqrt(std::max(0.0, g * g + 4.0 * k * m));
  const double plus = (g + root) / (2.0 * m), minus = (g - root) / (2.0 * m);
  return std::abs(plus - omega) < std::abs(minus - omega) ? plus : minus;
}

class WaveSearch {
 public:
  WaveSearch(const SpinningHarmonics& harmonics, int count, double tolerance)
      : harmonics_(harmonics), count_(count), tolerance_(tolerance) {}

  /// Finds all modes below the cutoff, in no order.
  Result<std::vector<FoundWave>> run();

 private:
  struct Number {  // modes of one n and sign
    int n, sign, asked = 0;
    std::vector<FoundWave> waves = {};
    double highest = 0.0;  // rad/s, of all found, also of those left out
    bool is_complete = false;
  };
  Status solve(const SpinningHarmonics::Equations& equations, Number& number, int asked);
  Failure lost(int n) const;
  double cutoff() const;

  const SpinningHarmonics& harmonics_;
  int count_;
  double tolerance_;
  std::vector<Number> numbers_;
};

Failure WaveSearch::lost(int n) const {
  return Failure{fmt::format(
      "modes: nothing holds a wave of circumferential number {} of the spinning tire: it spins "
      "above its standing-wave speed, or it buckles; check speed, pressure, thicknesses and moduli",
      n)};
}

Status WaveSearch::solve(const SpinningHarmonics::Equations& equations, Number& number, int asked) {
  const auto found = numerics::gyroscopic_modes(
      equations.problem, equations.K_factor, number.sign, asked, tolerance_);
  if (!found.converged)
    return Failure{
        fmt::format("modes: Lanczos found {} of {} modes of circumferential number {} "
                    "in {} solves",
                    found.omega.size(),
                    asked,
                    number.n,
                    found.solves)};
  number.asked = asked;
  number.waves.clear();
  const int m = harmonics_.ring().sector_unknowns();
  Eigen::MatrixXcd M_phi(equations.problem.M.size(), 1);
  for (Eigen::Index k = 0; k < found.omega.size(); ++k) {
    Eigen::VectorXcd phi = found.phi.col(k);
    equations.problem.M.multiply(phi, M_phi);
    const double scale = 1.0 / std::sqrt(phi.dot(M_phi.col(0)).real());
    phi *= scale;
    M_phi *= scale;
    const double omega = equations.soft.size() > 0
                             ? without_soft_springs(equations, phi, found.omega[k])
                             : found.omega[k];
    number.highest = std::max(number.highest, std::abs(omega));
    if (equations.soft.size() > 0 && std::abs(in_hertz(omega)) < kWholeWheel) continue;
    number.waves.push_back(
        {omega, number.n, phi, kinetic_energy(phi.head(m), M_phi.col(0).head(m))});
  }
  number.is_complete = asked >= equations.problem.K.size();
  return {};
}

/// Returns the magnitude, rad/s, of the count-th lowest found; infinite if there are fewer.
double WaveSearch::cutoff() const {
  std::vector<double> all;
  for (const Number& number : numbers_) {
    for (const FoundWave& wave : number.waves) all.push_back(std::abs(wave.omega));
  }
  if (std::ssize(all) < count_) return std::numeric_limits<double>::infinity();
  std::nth_element(all.begin(), all.begin() + count_ - 1, all.end());
  return all[count_ - 1];
}

Result<std::vector<FoundWave>> WaveSearch::run() {
  const Ring& ring = harmonics_.ring();
  const int S = ring.sectors();
  for (int n = 0; n <= S / 2; ++n) {
    const auto equations = harmonics_.equations(n);
    if (!equations && n > most_waves(ring)) continue;  // an hourglass motion, no wave
    if (!equations) return lost(n);
    for (const int sign : {1, -1}) {
      if (sign < 0 && is_one_motion(n, S)) continue;
      const double limit = cutoff();
      const bool is_beyond =
          limit < std::numeric_limits<double>::infinity() && equations->soft.size() == 0 &&
          numerics::no_mode_below(equations->problem, sign * (1.0 + kNearCutoff) * limit);
      if (is_beyond) continue;
      Number& number = numbers_.emplace_back(Number{.n = n, .sign = sign});
      if (const Status done = solve(*equations, number, kPerSense); !done) return done.failure();
    }
  }
  // If all modes found of a number are among the lowest, it may hold more of them.
  for (Number& number : numbers_) {
    while (!number.is_complete && number.highest < cutoff()) {
      const auto equations = harmonics_.equations(number.n);
      if (const Status done = solve(*equations, number, 2 * number.asked); !done)
        return done.failure();
    }
  }
  std::vector<FoundWave> waves;
  for (Number& number : numbers_)
    waves.insert(waves.end(), number.waves.begin(), number.waves.end());
  return waves;
}

/// Turns the largest entry of a complex shape onto the real axis. Its phase is arbitrary, and
/// results must repeat.
void make_largest_real(Eigen::VectorXcd& phi) {
  Eigen::Index largest;
  phi.cwiseAbs2().maxCoeff(&largest);
  phi *= std::conj(phi[largest]) / std::abs(phi[largest]);
}

SpinningMode named(const SpinningHarmonics& harmonics,
                   const Mesh& mesh,
                   FoundWave wave,
                   double speed) {
  const int S = harmonics.ring().sectors(), n = mesh.nodes_per_sector();
  const bool is_standing = is_one_motion(wave.n, S) || speed == 0.0;
  make_largest_real(wave.phi);
  SpinningMode mode;
  mode.frequency = in_hertz(std::abs(wave.omega));
  mode.frequency_on_tire = in_hertz(std::abs(wave.omega - wave.n * speed));
  if (!is_standing) mode.sense = wave.omega * speed > 0.0 ? Sense::with : Sense::against;
  mode.n = wave.n;
  mode.type = type_of(wave.n, wave.energy);
  const double scale = std::sqrt((is_one_motion(wave.n, S) ? 1.0 : 2.0) / S);
  const Eigen::Matrix3Xcd section = scale * harmonics.displacements(wave.n, wave.phi);
  mode.shape.resize(3, S * n);
  for (int s = 0; s < S; ++s)
    mode.shape.middleCols(s * n, n) = std::polar(1.0, wave.n * mesh.angle(s)) * section;
  if (wave.omega < 0.0) mode.shape = mode.shape.conjugate().eval();
  // The two waves of a pair at rest are the conjugates of each other; their real parts must differ.
  if (wave.omega < 0.0 && speed == 0.0) mode.shape *= std::complex<double>(0.0, 1.0);
  return mode;
}

}  // namespace

std::string name(Sense sense) {
  return sense == Sense::with ? "with" : sense == Sense::against ? "against" : "-";
}

std::string SpinningMode::label() const {
  std::string text = fmt::format("{} n={}", fe_tire::name(type), n);
  if (order > 1) text += fmt::format(" ({})", order);
  if (sense != Sense::none) text += " " + fe_tire::name(sense);
  return text;
}

Result<std::vector<SpinningMode>> SpinningTire::modes(const Inflated& spinning,
                                                      const Rim& rim,
                                                      int count) {
  FeTire::Impl& tire = *tire_.impl_;
  const auto harmonics = SpinningHarmonics::about(tire.even_elements(), spinning, rim);
  if (!harmonics) return harmonics.failure();
  auto waves = lowest_waves(*harmonics, count, tire.settings.mode_tolerance);
  if (!waves) return waves.failure();
  return named_waves(*harmonics, tire.ring.mesh(), std::move(*waves), spinning.spin);
}

Result<std::vector<FoundWave>> lowest_waves(const SpinningHarmonics& harmonics,
                                            int count,
                                            double tolerance) {
  auto waves = WaveSearch(harmonics, count, tolerance).run();
  if (!waves) return waves;
  std::stable_sort(waves->begin(), waves->end(), [](const FoundWave& a, const FoundWave& b) {
    return std::abs(a.omega) < std::abs(b.omega);
  });
  waves->resize(std::min<std::size_t>(waves->size(), count),
                FoundWave{0.0, 0, {}, Eigen::Vector3d::Zero()});
  return waves;
}

std::vector<SpinningMode> named_waves(const SpinningHarmonics& harmonics,
                                      const Mesh& mesh,
                                      std::vector<FoundWave> waves,
                                      double speed) {
  std::vector<SpinningMode> modes;
  std::map<std::tuple<int, ModeType, Sense>, int> orders;
  for (FoundWave& wave : waves) {
    modes.push_back(named(harmonics, mesh, std::move(wave), speed));
    SpinningMode& mode = modes.back();
    int& order = orders[{mode.n, mode.type, mode.sense}];
    const bool is_partner =
        order > 0 && mode.sense == Sense::none && modes.size() > 1 && mode.n > 0 &&
        mode.n == modes[modes.size() - 2].n &&
        mode.frequency - modes[modes.size() - 2].frequency <= kPair * mode.frequency;
    mode.order = is_partner ? order : ++order;
  }
  return modes;
}

}  // namespace latsch::fe_tire
