// SPDX-License-Identifier: Apache-2.0
// Free vibrations with Prony terms against roots of polynomials that NumPy computed.
#include "models/fe_tire/history/free_vibrations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace latsch::fe_tire {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

// An oscillator of 1 kg, 40 Hz unrelaxed, one term g = 0.2 of the unrelaxed stiffness, tau = 2 ms.
// The roots of m s^2 (1 + s tau) + k (1 - g) + k s tau: -10.81595 +- 229.56584 i, -478.3681.
TEST(FreeVibrations, AnOscillatorHasTheRootsOfItsPolynomial) {
  const double unrelaxed = std::pow(kTwoPi * 40.0, 2), relaxed = 0.8 * unrelaxed;
  const Eigen::MatrixXd K = Eigen::MatrixXd::Constant(1, 1, relaxed);
  const std::vector<RelaxingStiffness> parts = {
      {Eigen::MatrixXd::Constant(1, 1, relaxed), *from_unrelaxed({{0.2, 2e-3}})}};
  const auto found = free_vibration(K, parts, 0);
  ASSERT_TRUE(found) << found.failure().reason;
  EXPECT_NEAR(found->s.real(), -10.81595, 1e-5);
  EXPECT_NEAR(found->s.imag(), 229.56584, 1e-5);
  EXPECT_NEAR(found->damping(), 10.81595 / std::hypot(10.81595, 229.56584), 1e-7);
}

// Two masses of 1 kg: K = [[3, -1], [-1, 2]] * 1e4 N/m, of which the spring of 2e4 N/m from the
// first mass to the ground relaxes with beta = 0.5, tau = 3 ms. Roots of
// (1 + s tau)[(s^2 + 3e4)(s^2 + 2e4) - 1e8] + 1e4 s tau (s^2 + 2e4) by numpy.roots.
TEST(FreeVibrations, TwoMassesMoveAsTheRootsOfTheirDeterminant) {
  Eigen::Matrix2d K;
  K << 3e4, -1e4, -1e4, 2e4;
  // Modes of K: eigenvalues (5 -+ sqrt 5)/2 * 1e4.
  const double low = (5.0 - std::sqrt(5.0)) / 2.0 * 1e4, high = (5.0 + std::sqrt(5.0)) / 2.0 * 1e4;
  Eigen::Matrix2d modes;
  modes.col(0) = Eigen::Vector2d(1e4, 3e4 - low).normalized();
  modes.col(1) = Eigen::Vector2d(1e4, 3e4 - high).normalized();
  Eigen::Matrix2d spring = Eigen::Matrix2d::Zero();
  spring(0, 0) = 2e4;
  const std::vector<RelaxingStiffness> parts = {
      {modes.transpose() * spring * modes, {{0.5, 3e-3}}}};
  const Eigen::MatrixXd relaxed = Eigen::Vector2d(low, high).asDiagonal();
  for (int start = 0; start < 2; ++start) {
    const auto found = free_vibration(relaxed, parts, start);
    ASSERT_TRUE(found) << found.failure().reason;
    const std::complex<double> expected = start == 0 ? std::complex(-3.4704742, 119.17426036)
                                                     : std::complex(-8.93827537, 194.74313092);
    EXPECT_LT(std::abs(found->s - expected), 1e-7);
  }
}

TEST(FreeVibrations, NothingRelaxesWithoutTerms) {
  const Eigen::Vector3d omega_squared(1e4, 1e4, 9e4);
  const Eigen::MatrixXd K = omega_squared.asDiagonal();
  for (int start = 0; start < 3; ++start) {
    const auto found = free_vibration(K, {}, start);
    ASSERT_TRUE(found);
    EXPECT_DOUBLE_EQ(found->damping(), 0.0);
    EXPECT_NEAR(found->frequency(), std::sqrt(omega_squared[start]) / kTwoPi, 1e-12);
    EXPECT_NEAR(std::abs(found->q[start]), 1.0, 1e-12);
  }
}

// The two modes of a pair stay two: their vibrations have the same s and perpendicular shapes.
TEST(FreeVibrations, APairStaysAPair) {
  const Eigen::MatrixXd relaxed = Eigen::Vector3d(1e5, 1e5, 4e5).asDiagonal(),
                        K = Eigen::Vector3d(6e4, 6e4, 1e5).asDiagonal();
  const std::vector<RelaxingStiffness> parts = {{K, {{0.3, 1e-3}}}};
  const auto a = free_vibration(relaxed, parts, 0), b = free_vibration(relaxed, parts, 1);
  ASSERT_TRUE(a && b);
  EXPECT_LT(std::abs(a->s - b->s), 1e-9 * std::abs(a->s));
  EXPECT_LT(std::abs((a->q.transpose() * b->q).value()), 1e-9);
}

// s^2 + 1 + 1e6 s tau/(1 + s tau) with tau = 1e-5 s has the roots -0.1, -9.9 and -1e5.
TEST(FreeVibrations, AnOverdampedMotionIsAFailure) {
  const std::vector<RelaxingStiffness> parts = {
      {Eigen::MatrixXd::Constant(1, 1, 1.0), {{1e6, 1e-5}}}};
  const auto found = free_vibration(Eigen::MatrixXd::Constant(1, 1, 1.0), parts, 0);
  ASSERT_FALSE(found);
  EXPECT_NE(found.failure().reason.find("overdamped"), std::string::npos) << found.failure().reason;
}

}  // namespace
}  // namespace latsch::fe_tire
