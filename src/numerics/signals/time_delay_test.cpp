// SPDX-License-Identifier: Apache-2.0
// Tests delays between samples against signals whose delay is known in closed form.
#include "numerics/signals/time_delay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/signals/bilinear.h"
#include "numerics/signals/welch.h"

namespace latsch::numerics {
namespace {

/// Returns a Gaussian pulse 6 samples wide, whose spectrum is below 1e-30 at half the rate.
std::vector<double> pulse(double center, int count) {
  std::vector<double> x(count);
  for (int i = 0; i < count; ++i) x[i] = std::exp(-0.5 * std::pow((i - center) / 6.0, 2));
  return x;
}

TEST(TimeDelay, OfABandLimitedPulseIsExact) {
  const auto x = pulse(200.0, 500);
  for (const double d : {0.0, 0.25, 0.5, -0.371, 17.203, -40.9}) {
    const Delay found = delay_between(x, pulse(200.0 + d, 500), -60, 60);
    EXPECT_NEAR(found.samples, d, 1e-9) << d;
    EXPECT_NEAR(found.likeness, 1.0, 1e-12) << d;
  }
}

TEST(TimeDelay, StaysWithinTheLagsAllowed) {
  EXPECT_LE(std::abs(delay_between(pulse(200.0, 500), pulse(230.0, 500), -10, 10).samples), 10.0);
}

TEST(TimeDelay, ShiftMovesAPulseAsItsFormulaDoes) {
  for (const int count : {400, 401}) {
    const auto moved = shifted(pulse(150.0, count), 12.345);
    const auto exact = pulse(162.345, count);
    for (int i = 0; i < count; ++i) ASSERT_NEAR(moved[i], exact[i], 1e-12) << i;
  }
}

TEST(TimeDelay, ValuesBetweenSamplesAreThoseOfTheSine) {
  const double omega = 0.7 * std::numbers::pi;  // 0.7 of half the sampling rate
  std::vector<double> x(400), places;
  for (int i = 0; i < 400; ++i) x[i] = std::sin(omega * i);
  const auto between = values_between(x, 100.321, 50);
  for (int i = 0; i < 50; ++i) {
    ASSERT_NEAR(between[i], std::sin(omega * (100.321 + i)), 2e-6);
    places.push_back(100.0 + 1.0371 * i);
  }
  const auto at = values_at(x, places);
  for (int i = 0; i < 50; ++i) ASSERT_NEAR(at[i], std::sin(omega * places[i]), 2e-6);
  EXPECT_NEAR(values_between(x, 100.0, 1)[0], x[100], 1e-13);
}

// The estimate H1 of a noise-free delay is exp(-i omega delay), so its magnitude is 1. Each segment
// is cut from a transient, which causes leakage, so the tolerance is one percent.
TEST(Welch, ResponseOfAPureDelayHasItsPhase) {
  std::vector<double> x(20000), y(20000, 0.0);
  for (int i = 0; i < 20000; ++i) x[i] = std::sin(0.001 * i * i);  // x sweeps over all frequencies
  for (int i = 3; i < 20000; ++i) y[i] = 2.0 * x[i - 3];
  const auto s = densities(x, y, 1.0, welch_settings(Convention::scipy, 20000, 512));
  const auto H = response_h1(s);
  for (int k = 20; k < 236; ++k) {
    const std::complex<double> exact =
        2.0 * std::polar(1.0, -2.0 * std::numbers::pi * 3.0 * k / 512.0);
    EXPECT_LT(std::abs(H[k] - exact), 0.03) << k;
    EXPECT_LT(std::abs(response_h2(s)[k] - exact), 0.03) << k;
  }
}

// The mean square of a record is the sum of its density over the bins (Parseval).
TEST(Welch, DensityAddsUpToTheMeanSquare) {
  std::vector<double> x(4096);
  for (int i = 0; i < 4096; ++i) x[i] = std::sin(2.0 * std::numbers::pi * i / 32.0);
  const auto density = power_density(x, 100.0, welch_settings(Convention::scipy, 4096, 1024));
  double sum = 0.0;
  for (const double value : density.value) sum += value * 100.0 / 1024.0;
  EXPECT_NEAR(sum, 0.5, 1e-12);
}

// The response at `exact_at` equals that of the function of s.
TEST(Bilinear, IsExactAtTheFrequencyAskedFor) {
  const double rate = 2000.0, f = 2.0 * std::numbers::pi * 92.0, zeta = 0.06;
  const ContinuousFilter analog{{0.55 * f * f + 0.55 * f * f, 1.1 * zeta * f, 0.55},
                                {f * f, 2.0 * zeta * f, 1.0}};
  const RationalFilter digital = bilinear(analog, rate, f);
  const auto value = [](const std::vector<double>& c, std::complex<double> q) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = c.size(); i-- > 0;) sum = sum * q + c[i];
    return sum;
  };
  const std::complex<double> s(0.0, f), q = std::polar(1.0, -f / rate);
  const auto exact = value(analog.b, s) / value(analog.a, s);
  EXPECT_LT(std::abs(value(digital.b, q) / value(digital.a, q) - exact), 1e-12);
  EXPECT_TRUE(is_stable(digital));
}

}  // namespace
}  // namespace latsch::numerics
