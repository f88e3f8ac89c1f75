// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/history/free_vibrations.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace latsch::fe_tire {
namespace {

using Complex = std::complex<double>;

constexpr int kMostSteps = 60;
constexpr double kSame = 1e-12;   // relative change of s in the last step
constexpr double kReal = 1e-6;    // Im s/|s| below which s counts as real
constexpr double kShift = 1e-10;  // keeps A - mu from being exactly singular

/// Returns K + sum of K_r times what relaxes of it at s.
Eigen::MatrixXcd stiffness_at(const Eigen::MatrixXd& K,
                              const std::vector<RelaxingStiffness>& parts,
                              Complex s) {
  Eigen::MatrixXcd A = K.cast<Complex>();
  for (const RelaxingStiffness& part : parts) {
    Complex share = 0.0;
    for (const PronyTerm& term : part.terms)
      share += term.beta * s * term.tau / (1.0 + s * term.tau);
    A += share * part.K;
  }
  return A;
}

/// Returns x^T A x/(x^T x), without conjugation: A is complex symmetric.
Complex rayleigh(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& x) {
  return (x.transpose() * A * x).value() / (x.transpose() * x).value();
}

}  // namespace

double FreeVibration::frequency() const { return std::abs(s) / (2.0 * std::numbers::pi); }
double FreeVibration::damping() const { return -s.real() / std::abs(s); }

Result<FreeVibration> free_vibration(const Eigen::MatrixXd& K,
                                     const std::vector<RelaxingStiffness>& parts,
                                     int start) {
  Eigen::VectorXcd x = Eigen::VectorXcd::Unit(K.rows(), start);
  Complex s(0.0, std::sqrt(K(start, start)));
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXcd A = stiffness_at(K, parts, s);
    const Complex mu = rayleigh(A, x);
    const Complex next = Complex(0.0, 1.0) * std::sqrt(mu);  // the root with Im s >= 0
    const bool is_settled = std::abs(next - s) <= kSame * std::abs(next);
    s = next;
    if (is_settled && !(s.imag() > kReal * std::abs(s)))
      return Failure{fmt::format("mode {} is overdamped: it does not vibrate", start + 1)};
    if (is_settled) return FreeVibration{s, x / std::sqrt((x.transpose() * x).value())};
    // One step of inverse iteration turns x toward the vector of mu.
    Eigen::MatrixXcd shifted = A;
    shifted.diagonal().array() -= mu * (1.0 + kShift);
    x = shifted.partialPivLu().solve(x);
    x.normalize();
  }
  return Failure{
      fmt::format("the damped frequency of mode {} was not found in {} steps; it is "
                  "near {:.5g} Hz",
                  start + 1,
                  kMostSteps,
                  std::abs(s) / (2.0 * std::numbers::pi))};
}

}  // namespace latsch::fe_tire
