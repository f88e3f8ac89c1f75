// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/history/prony.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace latsch::fe_tire {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

std::string fault_of(const PronyTerms& terms) {
  const Status status = check(terms);
  return status.ok() ? "" : status.failure().reason;
}

TEST(Prony, RefusesTermsThatAreNone) {
  EXPECT_EQ(fault_of({{0.2, 1e-3}, {0.1, 1e-2}}), "");
  EXPECT_EQ(fault_of({}), "");
  EXPECT_NE(fault_of({{-0.1, 1e-3}}).find("below 0"), std::string::npos);
  EXPECT_NE(fault_of({{std::nan(""), 1e-3}}).find("below 0"), std::string::npos);
  EXPECT_NE(fault_of({{0.1, 0.0}}).find("relaxation time"), std::string::npos);
  EXPECT_NE(fault_of({{0.1, -1e-3}}).find("relaxation time"), std::string::npos);
  EXPECT_NE(fault_of({{0.1, std::numeric_limits<double>::infinity()}}).find("relaxation time"),
            std::string::npos);
  EXPECT_NE(fault_of({{0.1, 1e-3}, {0.2, 1e-3}}).find("same relaxation time"), std::string::npos);
  EXPECT_NE(fault_of({{30.0, 1e-3}, {30.0, 1e-2}}).find("sum to 60"), std::string::npos);
}

TEST(Prony, SharesOfTheUnrelaxedModulusAreConverted) {
  // With g = 0.2 the relaxed modulus is 0.8, and beta = 0.2/0.8.
  const auto terms = from_unrelaxed({{0.2, 2e-3}});
  ASSERT_TRUE(terms.ok());
  EXPECT_DOUBLE_EQ((*terms)[0].beta, 0.25);
  EXPECT_NEAR(0.8 * relative_modulus(*terms, 1e12).real(), 1.0, 1e-12);
  EXPECT_FALSE(from_unrelaxed({{0.6, 1e-3}, {0.4, 1e-2}}).ok());
  EXPECT_FALSE(from_unrelaxed({{-0.6, 1e-3}}).ok());
}

TEST(Prony, OscillatorHasTheRootsAndReceptanceOfItsCubicEquation) {
  // A mass of 1 kg, 40 Hz unrelaxed, g = 0.2, tau = 2 ms. Multiplied by 1 + p tau, the equation of
  // motion p^2 + k_0 (1 + beta p tau/(1 + p tau)) = 0 is a cubic with the roots
  // -10.81595 +- 229.56584 i and -478.3681, found by an independent program.
  const auto terms = *from_unrelaxed({{0.2, 2e-3}});
  const double unrelaxed = std::pow(kTwoPi * 40.0, 2), relaxed = 0.8 * unrelaxed;
  const auto equation = [&](std::complex<double> p) {
    const std::complex<double> turned = p * terms[0].tau;
    return p * p + relaxed * (1.0 + terms[0].beta * turned / (1.0 + turned));
  };
  EXPECT_LT(std::abs(equation({-10.81595, 229.56584})), 5e-8 * unrelaxed);
  EXPECT_LT(std::abs(equation({-478.3681, 0.0})), 2e-6 * unrelaxed);
  struct Row {
    double f, real, imaginary;
  };
  for (const Row& row : {Row{20.0, 2.797761e-5, -2.354150e-6},
                         Row{38.0, -1.002646e-4, -1.192978e-4},
                         Row{40.0, -7.915717e-5, -3.978874e-5},
                         Row{60.0, -1.143707e-5, -7.982321e-7}}) {
    const double omega = kTwoPi * row.f;
    const std::complex<double> receptance =
        1.0 / (relaxed * relative_modulus(terms, omega) - omega * omega);
    const std::complex<double> published(row.real, row.imaginary);
    EXPECT_LT(std::abs(receptance - published), 1e-6 * std::abs(published)) << row.f;
  }
}

TEST(Prony, LossFactorIsNearlyConstantOverItsBand) {
  for (const double loss_factor : {0.02, 0.15, 0.5}) {
    const auto terms = constant_loss_factor(loss_factor, 0.1, 1000.0);
    ASSERT_TRUE(terms.ok());
    EXPECT_EQ(terms->size(), 5u);
    double largest = 0.0;
    for (double f = 0.1; f <= 1000.0; f *= 1.05) {
      const std::complex<double> modulus = relative_modulus(*terms, kTwoPi * f);
      largest = std::max(largest, std::abs(modulus.imag() / modulus.real() / loss_factor - 1.0));
    }
    // One term a decade ripples: a row of Debye peaks a decade apart by 5 % about its mean.
    EXPECT_LT(largest, 0.13) << loss_factor;
  }
}

TEST(Prony, LossStiffensByThePowerOfTheFrequencyThatCausalityRequires) {
  // Kramers and Kronig: a constant loss angle delta means a modulus that grows as
  // f^(2 delta/pi). With tan delta = 0.15 this is a factor of 1.246 a decade.
  const auto terms = *constant_loss_factor(0.15, 0.1, 1000.0);
  const double growth = std::abs(relative_modulus(terms, kTwoPi * 100.0)) /
                        std::abs(relative_modulus(terms, kTwoPi * 1.0));
  EXPECT_NEAR(growth, std::pow(10.0, 2.0 * 2.0 / std::numbers::pi * std::atan(0.15)), 0.02);
}

TEST(Prony, OtherBandsAreCoveredToo) {
  EXPECT_EQ(constant_loss_factor(0.1, 10.0, 100.0)->size(), 2u);
  EXPECT_EQ(constant_loss_factor(0.1, 10.0, 30.0)->size(), 2u);
  EXPECT_EQ(constant_loss_factor(0.1, 1.0, 1e6)->size(), 7u);
  EXPECT_TRUE(constant_loss_factor(0.0, 1.0, 10.0)->empty());
}

TEST(Prony, RefusesLossFactorsThatAreNone) {
  const auto reason = [](double loss, double lowest, double highest) {
    const auto terms = constant_loss_factor(loss, lowest, highest);
    return terms.ok() ? std::string() : terms.failure().reason;
  };
  EXPECT_NE(reason(-0.1, 1.0, 10.0).find("expected 0 to 1"), std::string::npos);
  EXPECT_NE(reason(1.5, 1.0, 10.0).find("expected 0 to 1"), std::string::npos);
  EXPECT_NE(reason(0.1, 0.0, 10.0).find("band"), std::string::npos);
  EXPECT_NE(reason(0.1, 10.0, 10.0).find("band"), std::string::npos);
  // A loss angle of 45 degrees over eight decades stiffens by a factor of 10^4.
  EXPECT_NE(reason(1.0, 1.0, 1e8).find("sum to"), std::string::npos);
}

}  // namespace
}  // namespace latsch::fe_tire
