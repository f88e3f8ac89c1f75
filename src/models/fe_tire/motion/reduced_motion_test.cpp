// SPDX-License-Identifier: Apache-2.0
// Harmonic motions of an oscillator with one Prony term, beside its closed form.
#include "models/fe_tire/motion/reduced_motion.h"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <vector>

namespace latsch::fe_tire {
namespace {

// Mass 1 kg, 40 Hz unrelaxed, g = 0.2 of the unrelaxed stiffness relaxes in 2 ms:
//   1/(k (1 - g/(1 + i w tau)) - w^2), computed with NumPy.
TEST(ReducedMotion, IsTheReceptanceOfAnOscillatorThatRelaxes) {
  constexpr double kUnrelaxed = 0.2, kTime = 2e-3;
  const double k = std::pow(2.0 * std::numbers::pi * 40.0, 2);
  const Eigen::MatrixXd relaxed = Eigen::MatrixXd::Constant(1, 1, k * (1.0 - kUnrelaxed));
  const PronyTerms terms = *from_unrelaxed({{kUnrelaxed, kTime}});
  const ReducedMotion body{relaxed, {{relaxed, terms}}};
  struct Listed {
    double frequency;                 // Hz
    std::complex<double> receptance;  // m/N
  };
  const std::vector<Listed> list = {{20.0, {2.797761e-5, -2.354150e-6}},
                                    {38.0, {-1.002646e-4, -1.192978e-4}},
                                    {40.0, {-7.915717e-5, -3.978874e-5}},
                                    {60.0, {-1.143707e-5, -7.982321e-7}}};
  for (const Listed& at : list) {
    const auto q =
        body.motions(2.0 * std::numbers::pi * at.frequency, Eigen::MatrixXcd::Ones(1, 1))(0, 0);
    EXPECT_LT(std::abs(q - at.receptance), 1e-6 * std::abs(at.receptance)) << at.frequency;
  }
}

// With Rayleigh's damping alone: 1/(k (1 + i w b) + i w a - w^2).
TEST(ReducedMotion, DampsByMassAndStiffness) {
  const double k = 4e4, w = 150.0, a = 20.0, b = 1e-4;
  const ReducedMotion body{Eigen::MatrixXd::Constant(1, 1, k), {}, {a, b}};
  const std::complex<double> expected = 1.0 / std::complex<double>(k - w * w, w * (a + b * k));
  const auto q = body.motions(w, Eigen::MatrixXcd::Ones(1, 1))(0, 0);
  EXPECT_LT(std::abs(q - expected), 1e-12 * std::abs(expected));
}

}  // namespace
}  // namespace latsch::fe_tire
