// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/history/streamlines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace latsch::fe_tire {
namespace {

using Complex = std::complex<double>;
constexpr double kAround = 2.0 * std::numbers::pi;
constexpr Complex kI(0.0, 1.0);

std::vector<double> equal_angles(int m) {
  std::vector<double> theta(m);
  for (int k = 0; k < m; ++k) theta[k] = kAround * k / m;
  return theta;
}

/// Angles of a zoned ring: two points a sector at Gauss points, sectors near the bottom narrower.
std::vector<double> zoned_angles() {
  std::vector<double> planes{0.0}, theta;
  while (planes.back() < kAround - 1e-9) {
    const double from_bottom = std::min(planes.back(), kAround - planes.back());
    planes.push_back(planes.back() + kAround / (from_bottom < 0.5 ? 240 : 60));
  }
  const double gauss = 0.5 / std::sqrt(3.0);
  for (std::size_t s = 0; s + 1 < planes.size(); ++s) {
    const double scale = kAround / planes.back(), width = planes[s + 1] - planes[s];
    for (const double at : {0.5 - gauss, 0.5 + gauss})
      theta.push_back(scale * (planes[s] + at * width));
  }
  return theta;
}

Eigen::MatrixXd cosine(const std::vector<double>& theta, int n, double phase = 0.0) {
  Eigen::MatrixXd S(1, std::ssize(theta));
  for (std::size_t k = 0; k < theta.size(); ++k)
    S(0, static_cast<Eigen::Index>(k)) = std::cos(n * theta[k] + phase);
  return S;
}

constexpr double kOmega = 50.0;  // rad/s

/// Loss modulus over beta: the part of the history of cos(n theta) that leads by a quarter wave.
double loss_by_amplitude(const std::vector<double>& theta, double Omega_tau, int n) {
  const Eigen::MatrixXd h =
      Streamline(theta).history({1.0, Omega_tau / kOmega}, kOmega, cosine(theta, n));
  const Eigen::MatrixXd quarter = cosine(theta, n, -0.5 * std::numbers::pi);
  return 2.0 * h.cwiseProduct(quarter).sum() / static_cast<double>(h.cols());
}

/// Loss modulus over beta by the power that is lost, E'' n Omega/2 a unit of volume.
double loss_by_power(const std::vector<double>& theta, double Omega_tau, int n) {
  const Streamline line(theta);
  const Eigen::MatrixXd S = cosine(theta, n);
  return line.power(kOmega, line.history({1.0, Omega_tau / kOmega}, kOmega, S), S) /
         (n * kOmega * std::numbers::pi);
}

TEST(Streamline, ForwardRollingCarriesMaterialTowardDecreasingTheta) {
  // The first trap of the theory: a wrong sign exchanges leading and trailing edge.
  const Streamline line({0.1, 3.0, 1.0, -0.2});
  EXPECT_EQ(line.order(), (std::vector<int>{3, 1, 2, 0}));
  EXPECT_NEAR(line.steps()[0], kAround - 3.2, 1e-12);
  EXPECT_NEAR(line.steps()[1], 2.0, 1e-12);
  EXPECT_NEAR(line.steps()[3], 0.3, 1e-12);
  EXPECT_NEAR(line.steps().sum(), kAround, 1e-12);
}

TEST(Streamline, StressLagsBehindTheStrainInTheDirectionOfFlow) {
  // The stress of a strain that peaks at the bottom leads in material time, so the peak of S + H is
  // passed before the bottom: at theta > 0 in forward rolling, at theta < 0 in backward rolling.
  const auto theta = equal_angles(240);
  const Streamline line(theta);
  const PronyTerm term{0.25, 4e-3};
  for (const double Omega : {50.0, -50.0}) {
    const Eigen::MatrixXd S = cosine(theta, 1), h = line.history(term, Omega, S);
    double sine = 0.0;
    for (int k = 0; k < 240; ++k) sine += h(0, k) * std::sin(theta[k]);
    EXPECT_GT(sine * Omega, 0.0);
  }
}

TEST(Streamline, LossModulusConvergesWithSecondOrder) {
  // Exact: x/(1 + x^2) with x = n Omega tau. The errors with 60, 120 and 240 points at n = 5 and
  // Omega tau = 0.05 are those that an independent program found: -2.7, -0.6, -0.15 %.
  const double x = 5.0 * 0.05, exact = x / (1.0 + x * x);
  const auto error = [&](int m) {
    return loss_by_amplitude(equal_angles(m), 0.05, 5) / exact - 1.0;
  };
  EXPECT_NEAR(error(60), -0.027, 0.0005);
  EXPECT_NEAR(error(120), -0.006, 0.0005);
  EXPECT_NEAR(error(240), -0.0015, 0.0001);
  EXPECT_NEAR(std::log2(error(120) / error(240)), 2.0, 0.1);
  EXPECT_NEAR(std::log2(error(240) / error(480)), 2.0, 0.05);
}

TEST(Streamline, PowerConvergesWithSecondOrder) {
  // Trapezoids see differences of E between points, sin(x/2)/(x/2) with x = n Delta theta of its
  // derivative at them; their error comes on top of that of the history.
  const double x = 5.0 * 0.05, exact = x / (1.0 + x * x);
  for (const int m : {60, 120, 240}) {
    const double half = 5.0 * std::numbers::pi / m;
    const double seen = std::sin(2.0 * half) / (2.0 * half);
    EXPECT_NEAR(loss_by_power(equal_angles(m), 0.05, 5),
                seen * loss_by_amplitude(equal_angles(m), 0.05, 5),
                1e-12);
    EXPECT_NEAR(seen, 1.0, 4.0 * half * half / 6.0);
  }
  const auto error = [&](int m) { return loss_by_power(equal_angles(m), 0.05, 5) / exact - 1.0; };
  EXPECT_NEAR(std::log2(error(120) / error(240)), 2.0, 0.05);
}

TEST(Streamline, HistoryIsExactForStressLinearBetweenPoints) {
  // A triangle of strain on an uneven chain: h' + h/tau = beta S' in closed form between corners.
  const std::vector<double> theta{0.2, 0.5, 0.6, 1.5, 3.0, 3.1, 5.0};
  const double Omega = 30.0, tau = 0.02, beta = 0.4;
  const Streamline line(theta);
  Eigen::MatrixXd S(1, 7);
  S << 1.0, -2.0, 0.5, 3.0, -1.0, 0.0, 2.0;
  const Eigen::MatrixXd h = line.history({beta, tau}, Omega, S);
  // Integrate over many turns with many small exact steps of a constant slope.
  double value = 0.0;
  const auto& order = line.order();
  for (int turn = 0; turn < 40; ++turn) {
    for (int k = 0; k < 7; ++k) {
      if (turn == 39) {
        EXPECT_NEAR(h(0, order[k]), value, 1e-12);
      }
      const double dt = line.steps()[k] / Omega;
      const double slope = (S(0, order[(k + 1) % 7]) - S(0, order[k])) / dt;
      value = value * std::exp(-dt / tau) + beta * slope * tau * (1.0 - std::exp(-dt / tau));
    }
  }
}

TEST(Streamline, LimitsOfSpeedAreRelaxedAndUnrelaxed) {
  const auto theta = zoned_angles();
  const Streamline line(theta);
  Eigen::MatrixXd S = 1e6 * cosine(theta, 3, 0.4);
  S.array() += 7e6;
  const PronyTerm term{0.25, 1e-2};
  EXPECT_EQ(line.history(term, 0.0, S).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(line.history(term, 1e-320, S).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LT(line.history(term, 1e-9, S).cwiseAbs().maxCoeff(), 1.0);
  // At infinite speed h = beta (S - mean of S over the flow).
  double mean = 0.0;
  for (int k = 0; k < line.points(); ++k) {
    const int next = line.order()[(k + 1) % line.points()];
    mean += line.steps()[k] * 0.5 * (S(0, line.order()[k]) + S(0, next)) / kAround;
  }
  const Eigen::MatrixXd expected = 0.25 * (S.array() - mean);
  for (const double Omega : {1e11, 1e16, std::numeric_limits<double>::infinity()}) {
    const double error = (line.history(term, Omega, S) - expected).cwiseAbs().maxCoeff();
    EXPECT_LT(error, 1e6 * (10.0 / (Omega * term.tau) + 1e-13)) << Omega;
  }
}

TEST(Streamline, HistoryDependsSmoothlyOnTheSpeedWhereFormulasChange) {
  // The closure changes its formula at a turn of half a relaxation time, its steps where a step is
  // half of one.
  const auto theta = equal_angles(7);
  const Streamline line(theta);
  const Eigen::MatrixXd S = cosine(theta, 1);
  for (const double Omega_tau : {kAround / 0.5, kAround / 7 / 0.5}) {
    const auto at = [&](double factor) {
      return line.history({0.25, 1e-2}, factor * Omega_tau / 1e-2, S);
    };
    EXPECT_LT((at(1.0 + 1e-12) - at(1.0 - 1e-12)).cwiseAbs().maxCoeff(), 1e-11);
  }
}

TEST(Streamline, UnloadedSpinningChainHasNoLoss) {
  // A stress that is the same all around has no history, on unequal steps too, at any speed.
  const auto theta = zoned_angles();
  const Streamline line(theta);
  const Eigen::MatrixXd S = Eigen::MatrixXd::Constant(6, line.points(), 3.1e6);
  for (const double Omega : {1e-3, 1.0, 50.0, 1e9}) {
    EXPECT_EQ(line.history({0.25, 1e-3}, Omega, S).cwiseAbs().maxCoeff(), 0.0);
    const Eigen::MatrixXcd h = line.history({0.25, 1e-3}, Omega, 0.0, S.cast<Complex>());
    EXPECT_EQ(h.cwiseAbs().maxCoeff(), 0.0);
  }
}

TEST(Streamline, ElasticStressLosesNothing) {
  // Closed chains of S = dW/dE give zero but for rounding if S is linear in E, as trapezoids are
  // then exact.
  const auto theta = zoned_angles();
  const Streamline line(theta);
  const Eigen::MatrixXd E = cosine(theta, 4, 0.3);
  EXPECT_NEAR(line.power(50.0, 3.0 * E, E), 0.0, 1e-11);
}

TEST(Streamline, PowerIsTheSameInBothSensesOfRotation) {
  const auto theta = zoned_angles();
  const Streamline line(theta);
  const Eigen::MatrixXd S = cosine(theta, 2), mirrored = cosine(theta, -2);
  const PronyTerm term{0.25, 4e-3};
  const double forward = line.power(50.0, line.history(term, 50.0, S), S);
  const double backward = line.power(-50.0, line.history(term, -50.0, mirrored), mirrored);
  EXPECT_GT(forward, 0.0);
  EXPECT_NEAR(backward, forward, 1e-3 * forward);
}

TEST(Streamline, HarmonicHistoryAtRestIsTheComplexModulus) {
  const auto theta = zoned_angles();
  const Streamline line(theta);
  const Eigen::MatrixXcd S = cosine(theta, 3, 0.2).cast<Complex>() + kI * cosine(theta, 1);
  const PronyTerm term{0.4, 3e-3};
  for (const double omega : {0.0, 10.0, 333.0, 1e5}) {
    const Complex modulus = relative_modulus(term, omega);
    for (const double Omega : {0.0, 1e-7}) {
      const Eigen::MatrixXcd h = line.history(term, Omega, omega, S);
      EXPECT_LT((h - modulus * S).cwiseAbs().maxCoeff(), 1e-5 * (Omega > 0.0) + 1e-14)
          << omega << " " << Omega;
    }
  }
}

TEST(Streamline, HarmonicWavesSeeTheFrequencyOfTheirMaterial) {
  // A wave e^(i (omega t + n s)), s along the flow, reaches the material at omega + n Omega; a
  // harmonic motion at omega = 0 is (H.2).
  const int m = 960, n = 3;
  const auto theta = equal_angles(m);
  const Streamline line(theta);
  const PronyTerm term{0.4, 3e-3};
  for (const double Omega : {20.0, 80.0}) {
    for (const double omega : {0.0, 60.0, -150.0}) {
      Eigen::MatrixXcd S(1, m);
      for (int k = 0; k < m; ++k) S(0, k) = std::exp(-kI * (n * theta[k]));
      const Complex expected = relative_modulus(term, omega + n * Omega);
      const Eigen::MatrixXcd h = line.history(term, Omega, omega, S);
      const double largest = (h - expected * S).cwiseAbs().maxCoeff();
      EXPECT_LT(largest, 2e-4 * std::abs(term.beta)) << Omega << " " << omega;
    }
    const Eigen::MatrixXd real = cosine(theta, n);
    const Eigen::MatrixXcd both = line.history(term, Omega, 0.0, real.cast<Complex>());
    EXPECT_LT((both - line.history(term, Omega, real).cast<Complex>()).cwiseAbs().maxCoeff(),
              1e-14);
  }
}

TEST(Streamline, LocalTangentIsTheChangeOfHistoryWithUpstreamHeld) {
  const auto theta = zoned_angles();
  const Streamline line(theta);
  const PronyTerm term{0.3, 2e-3};
  const double Omega = 40.0;
  const int m = line.points(), k = 17, at = line.order()[k], before = line.order()[k - 1];
  // One step of (H.2) with h and S held at the point upstream.
  Eigen::MatrixXd S = cosine(theta, 2);
  const double a = line.steps()[k - 1] / Omega / term.tau, c = -std::expm1(-a) / a;
  const auto one_step = [&](double moved) {
    const Eigen::MatrixXd h = line.history(term, Omega, S);
    return std::exp(-a) * h(0, before) + c * term.beta * (S(0, at) + moved - S(0, before));
  };
  EXPECT_NEAR(one_step(1e-3) - one_step(0.0), 1e-3 * line.local_tangent(term, Omega)[at], 1e-15);
  EXPECT_NEAR(one_step(0.0), line.history(term, Omega, S)(0, at), 1e-14);
  EXPECT_EQ(line.local_tangent(term, 0.0), Eigen::VectorXd::Zero(m));
  EXPECT_NEAR(line.local_tangent(term, 1e12).maxCoeff(), term.beta, 1e-9);
}

}  // namespace
}  // namespace latsch::fe_tire
