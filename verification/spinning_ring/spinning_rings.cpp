// SPDX-License-Identifier: Apache-2.0
#include "spinning_rings.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "models/fe_tire/motion/damped_tire.h"
#include "models/fe_tire/motion/spin.h"
#include "numerics/sparse/gyroscopic.h"
#include "ring_mesh.h"

namespace latsch::verification {
namespace {

using namespace fe_tire;

constexpr double kTwoPi = 2.0 * std::numbers::pi;

template <class T>
T value_of(Result<T> result) {
  if (!result) throw std::runtime_error(result.failure().reason);
  return *std::move(result);
}

/// Returns the relative difference between a listed frequency and the nearest computed one with the
/// same n and sense of rotation.
double nearest(const std::vector<SpinningMode>& modes,
               const ListedMode& listed,
               double wanted,
               double SpinningMode::*frequency) {
  double least = 1.0;
  for (const SpinningMode& mode : modes) {
    const bool is_meant = mode.n == std::abs(listed.n) &&
                          (listed.n == 0 || (mode.sense == Sense::with) == (listed.n > 0));
    if (is_meant) least = std::min(least, std::abs(mode.*frequency / wanted - 1.0));
  }
  return least;
}

/// Returns the displacement, m, in the frame of the sector, of the node on the outer edge of the
/// ring at y = 0.01 m.
Eigen::Vector3d crown_displacement(const FeTire& tire, const Inflated& state) {
  for (int k = 0; k < tire.mesh().nodes_per_sector(); ++k) {
    const Eigen::Vector3d X = tire.mesh().X.col(k);
    if (std::abs(X.z() + 0.30) < 1e-9 && std::abs(X.y() - 0.01) < 1e-9) return state.u.col(k);
  }
  throw std::runtime_error("the ring has no node at its crown");
}

FeTire free_ring(int sectors) { return FeTire(free_ring_mesh(sectors), free_ring_materials(0.3)); }

/// Computes the lowest angular frequency, rad/s, of the radial modes with wave number n and one
/// sense of rotation.
using Frequency = std::function<double(FeTire&, const Inflated&, int n, int sign)>;

SplitErrors split_errors(int sectors, const Frequency& frequency) {
  constexpr double kSpeed = 20.0;  // rad/s
  FeTire ring = free_ring(sectors);
  const Inflated at_rest = value_of(ring.inflate(0.0));
  const Inflated spinning = value_of(SpinningTire(ring).inflate(at_rest, kSpeed));
  SplitErrors errors;
  for (int n = 2; n <= 5; ++n) {
    const double kappa = n * (n * n - 1.0) / (n * n + 1.0);
    const double with = frequency(ring, spinning, n, 1), against = frequency(ring, spinning, n, -1);
    const double rest = frequency(ring, at_rest, n, 1);
    errors.split =
        std::max(errors.split, std::abs((with - against) / (2.0 * kappa * kSpeed) - 1.0));
    errors.product = std::max(errors.product, std::abs(with * against / (rest * rest) - 1.0));
  }
  return errors;
}

}  // namespace

const std::vector<ListedMode>& gyro_ring_modes() {
  using enum ModeType;
  static const std::vector<ListedMode> modes = {
      {2, lateral, 35.30543, 35.3022, 67.1332},    {1, lateral, 37.13526, 37.1335, 53.0490},
      {-1, lateral, 38.35025, 38.3499, 22.4344},   {-2, lateral, 38.91299, 38.9093, 7.0783},
      {0, lateral, 40.93675, 40.9355, 40.9355},    {3, lateral, 56.84152, 56.8329, 104.5794},
      {-3, lateral, 63.49434, 63.4839, 15.7374},   {0, torsional, 68.87417, 68.8730, 68.8730},
      {1, torsional, 89.51153, 89.5108, 105.4263}, {4, radial, 98.24166, 98.2215, 161.8835},
      {-4, lateral, 107.62030, 107.5974, 43.9354}, {-1, torsional, 114.09780, 114.0964, 98.1809},
      {2, radial, 117.10880, 117.1040, 148.9350},  {3, radial, 133.80750, 133.7935, 181.5400},
      {0, radial, 140.91410, 140.7864, 140.7864},  {1, radial, 142.80640, 142.6880, 158.6035},
      {-1, radial, 143.80120, 143.6787, 127.7632}, {-2, radial, 147.12710, 147.1194, 115.2884},
      {5, radial, 149.71580, 149.6795, 229.2570},  {4, radial, 151.58980, 151.5377, 215.1997},
      {2, radial, 152.76460, 152.6644, 184.4954},  {-2, radial, 153.21360, 153.1074, 121.2764},
      {-3, radial, 156.92280, 156.9032, 109.1567}, {-5, radial, 160.82070, 160.7796, 81.2021}};
  return modes;
}

FeTire gyro_ring(int sectors) {
  return FeTire(
      gyro_ring_mesh(sectors), gyro_ring_materials(), {.element = ElementKind::full_integration});
}

std::vector<double> frequencies_by_flow(
    const FeTire& tire, ElementKind kind, const Inflated& state, int n, int sign) {
  const Ring ring(tire.mesh(), kind);
  const RingElements elements(ring, tire.materials());
  const SectorFlow flow(elements);
  SectorBlocks K(ring);
  Eigen::VectorXd f, alpha = state.alpha;
  if (!assemble_sector(elements, ring.compress(state.u), state.pressure, alpha, f, &K, nullptr))
    throw std::runtime_error("the state has no tangent");
  using numerics::BorderedHermitian;
  numerics::GyroscopicProblem problem{BorderedHermitian(K.harmonic(n)),
                                      BorderedHermitian(flow.G.harmonic_of_skew(n)),
                                      BorderedHermitian(flow.M.harmonic(n))};
  problem.K.banded.lower() -= state.spin * state.spin * flow.W.harmonic(n).lower();
  problem.G.banded.lower() *= state.spin;
  numerics::BorderedCholesky factor;
  if (!factor.factorize(problem.K)) throw std::runtime_error("a wave is not held");
  const auto modes = numerics::gyroscopic_modes(problem, factor, sign, 3, 1e-9);
  std::vector<double> frequencies;
  for (const double omega : modes.omega) frequencies.push_back(std::abs(omega) / kTwoPi);
  return frequencies;
}

GyroRingErrors gyro_ring_errors() {
  FeTire tire = gyro_ring();
  SpinningTire spinning(tire);
  const Inflated at_rest = value_of(tire.inflate(0.0));
  const Inflated state = value_of(spinning.inflate(at_rest, kGyroSpeed));
  const auto modes = value_of(spinning.modes(state, {}, 60));
  GyroRingErrors errors;
  const auto take = [](double& worst, double error) { worst = std::max(worst, std::abs(error)); };
  for (const ListedMode& listed : gyro_ring_modes()) {
    take(errors.calculix,
         nearest(modes, listed, listed.calculix, &SpinningMode::frequency_on_tire));
    take(errors.independent,
         nearest(modes, listed, listed.independent, &SpinningMode::frequency_on_tire));
    take(errors.hub, nearest(modes, listed, listed.hub, &SpinningMode::frequency));
  }
  // Frequencies in axes that do not rotate, equation (W.1), on the same elements, by the
  // independent program.
  struct ByFlow {
    int n;
    double hub;  // Hz
  };
  for (const auto& [n, hub] :
       {ByFlow{-2, 7.0651}, {-1, 22.3975}, {0, 40.8826}, {1, 53.0101}, {2, 67.1143}, {3, 104.4534}})
    take(errors.by_flow,
         frequencies_by_flow(
             tire, ElementKind::full_integration, state, std::abs(n), n < 0 ? -1 : 1)[0] /
                 hub -
             1.0);
  // Reference value of the radial growth, m, of the outer node at y = 0.01 m, which both programs
  // give.
  errors.growth = std::abs(-crown_displacement(tire, state).z() / 2.18728e-3 - 1.0);
  errors.standing_wave = std::abs(value_of(spinning.standing_wave(at_rest)).speed / 170.4 - 1.0);
  return errors;
}

SplitErrors bryan_errors(int sectors) {
  return split_errors(sectors, [](FeTire& ring, const Inflated& state, int n, int sign) {
    const auto modes = value_of(SpinningTire(ring).modes(state, {}, 40));
    for (const SpinningMode& mode : modes) {
      const bool is_meant = mode.sense == Sense::none || (mode.sense == Sense::with) == (sign > 0);
      if (mode.n == n && mode.type == ModeType::radial && is_meant) return kTwoPi * mode.frequency;
    }
    throw std::runtime_error("a free ring lacks a mode");
  });
}

SplitErrors bryan_errors_by_flow(int sectors) {
  return split_errors(sectors, [](FeTire& ring, const Inflated& state, int n, int sign) {
    // The list also contains modes out of the plane, so the frequency nearest to that of the ring's
    // in-plane mode is taken.
    const auto found = frequencies_by_flow(ring, ElementKind::solid_shell, state, n, sign);
    const auto modes = value_of(SpinningTire(ring).modes(state, {}, 40));
    for (const SpinningMode& mode : modes) {
      const bool is_meant = mode.sense == Sense::none || (mode.sense == Sense::with) == (sign > 0);
      if (mode.n != n || mode.type != ModeType::radial || !is_meant) continue;
      const auto near = std::ranges::min_element(
          found, {}, [&](double hertz) { return std::abs(hertz - mode.frequency); });
      return kTwoPi * *near;
    }
    throw std::runtime_error("a free ring lacks a mode");
  });
}

namespace {

using Complex = std::complex<double>;

/// Returns the damped mode in the plane with these waves and this sense.
const DecayingWave& wave_in_plane(const std::vector<DecayingWave>& waves, int n, int sign) {
  for (const DecayingWave& wave : waves) {
    const SpinningMode& mode = wave.mode;
    const bool is_meant = (mode.sense == Sense::with) == (sign > 0);
    if (mode.n == n && mode.type == ModeType::radial && is_meant) return wave;
  }
  throw std::runtime_error("a damped free ring lacks a mode");
}

/// Returns the square of the bending frequency, rad/s, of an inextensible thin ring.
double bending_squared(int n) {
  constexpr double kRadius = 0.3, kThickness = 0.002;  // m, of free_ring_mesh()
  const double by_number = n * n * (n * n - 1.0) * (n * n - 1.0) / (n * n + 1.0);
  return by_number * kFreeRingModulus * kThickness * kThickness /
         (12.0 * kFreeRingDensity * std::pow(kRadius, 4));
}

}  // namespace

DampedRingErrors damped_ring_errors(int sectors) {
  constexpr double kSpeed = 20.0, kPoisson = 0.3;
  constexpr int kCount = 40, kSteps = 60;
  const double shear = kFreeRingModulus / (2.0 * (1.0 + kPoisson));
  const double bulk = kFreeRingModulus / (3.0 * (1.0 - 2.0 * kPoisson));
  const PronyTerm term{0.3, 1e-3};
  LossMaterials losses{{{"rubber.ring"}}, {{}, {{term}, 0, shear, {}}}, {}};
  FeTire ring = free_ring(sectors);
  const Inflated at_rest = value_of(ring.inflate(0.0));
  const Inflated spinning = value_of(SpinningTire(ring).inflate(at_rest, kSpeed));
  const auto waves = value_of(DampedTire(ring, losses).modes(spinning, Rim{}, kCount));
  const auto resting = value_of(SpinningTire(ring).modes(at_rest, {}, kCount));
  DampedRingErrors errors;
  for (int n = 2; n <= 5; ++n) {
    const auto rest = std::ranges::find_if(resting, [&](const SpinningMode& mode) {
      return mode.n == n && mode.type == ModeType::radial;
    });
    if (rest == resting.end()) throw std::runtime_error("a free ring lacks a mode");
    const double omega_n = kTwoPi * rest->frequency;
    const double kappa = n * (n * n - 1.0) / (n * n + 1.0), g = 2.0 * n * kSpeed / (n * n + 1.0);
    for (const int sign : {1, -1}) {
      Complex sigma = sign * omega_n - g;
      for (int step = 0; step < kSteps; ++step) {
        const Complex s = Complex(0.0, 1.0) * sigma;
        const Complex G = shear * (1.0 + term.beta * s * term.tau / (1.0 + s * term.tau));
        const Complex E = 9.0 * bulk * G / (3.0 * bulk + G);
        const Complex held = omega_n * omega_n + bending_squared(n) * (E / kFreeRingModulus - 1.0);
        sigma = double(sign) * std::sqrt(held + kappa * kappa * kSpeed * kSpeed) - g;
      }
      const Complex omega = sigma + n * kSpeed;
      const DecayingWave& wave = wave_in_plane(waves, n, sign);
      errors.frequency = std::max(errors.frequency,
                                  std::abs(kTwoPi * wave.mode.frequency / std::abs(omega) - 1.0));
      errors.damping =
          std::max(errors.damping, std::abs(wave.damping * std::abs(omega) / omega.imag() - 1.0));
    }
  }
  return errors;
}

}  // namespace latsch::verification
