// SPDX-License-Identifier: Apache-2.0
// Tests of the rig's response (3-3): its inverse in closed form, its filters, and its four numbers
// identified from tests whose truth is known.
#include "measurement/rig_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "measurement/band_level.h"
#include "measurement/bootstrap.h"
#include "measurement/hammer.h"
#include "measurement/order_tracking.h"
#include "measurement/synthetic_rig.h"
#include "numerics/signals/digital_filter.h"
#include "numerics/signals/fft.h"
#include "numerics/signals/time_delay.h"
#include "numerics/signals/welch.h"

namespace latsch {
namespace {

const RigResponse kTruth = RigResponse::of(0.55, kTwoPi * 92.0, 0.06, 0.55);

std::complex<double> answer(const numerics::RationalFilter& filter, double omega, double rate) {
  const auto value = [&](const std::vector<double>& c) {
    std::complex<double> sum = 0.0;
    for (std::size_t k = 0; k < c.size(); ++k) {
      sum += c[k] * std::polar(1.0, -omega / rate * static_cast<double>(k));
    }
    return sum;
  };
  return value(filter.b) / value(filter.a);
}

TEST(RigResponse, ItsInverseIsOfTheSameForm) {
  const auto back = inverse(kTruth);
  ASSERT_TRUE(back);
  for (const double f : {0.0, 30.0, 92.0, 120.0, 700.0}) {
    EXPECT_LT(std::abs(kTruth.at(kTwoPi * f) * back->at(kTwoPi * f) - 1.0), 1e-12) << f;
  }
  EXPECT_FALSE(inverse(RigResponse::of(1.0, 500.0, 0.1, 0.0)));
  EXPECT_FALSE(inverse(RigResponse::of(1.0, 500.0, 0.1, -0.5)));  // f^2 + A/c < 0
}

TEST(RigResponse, ItsFilterAnswersExactlyAtRestAndAtTheResonance) {
  const auto filter = filter_of(kTruth, 2000.0);
  ASSERT_TRUE(filter.ok());
  EXPECT_LT(std::abs(answer(*filter, 0.0, 2000.0) - 1.1), 1e-12);
  EXPECT_LT(std::abs(answer(*filter, kTruth.f, 2000.0) - kTruth.at(kTruth.f)), 1e-10);
  EXPECT_FALSE(filter_of(RigResponse::of(1.0, 500.0, -0.1, 1.0), 2000.0).ok());
  EXPECT_FALSE(filter_of(RigResponse::of(1.0, 9000.0, 0.1, 1.0), 2000.0).ok());
}

// The inverse with a low-pass: the product of response and inverse is 1 in the pass band and 3 dB
// down at the low-pass, even if c is 0 and there is no inverse without the low-pass.
TEST(RigResponse, TheRegularizedInverseUndoesItUpToTheLowPass) {
  for (const double c : {0.55, 0.0}) {
    const RigResponse r = RigResponse::of(1.0 - c, kTruth.f, 0.06, c);
    const auto filter = inverse_filter(r, 8000.0, 400.0);
    ASSERT_TRUE(filter.ok()) << filter.failure().reason;
    EXPECT_TRUE(numerics::is_stable(*filter));
    for (const double f : {5.0, 30.0, 60.0}) {
      const auto product = answer(*filter, kTwoPi * f, 8000.0) * r.at(kTwoPi * f);
      EXPECT_NEAR(std::abs(product), 1.0, 0.01) << c << " " << f;
    }
    const auto edge = answer(*filter, kTwoPi * 400.0, 8000.0) * r.at(kTwoPi * 400.0);
    EXPECT_NEAR(std::abs(edge), std::sqrt(0.5), 0.05) << c;
  }
  // Near half the rate, too, where the transform compresses frequencies by a third.
  const RigResponse r = RigResponse::of(0.45, kTruth.f, 0.06, 0.55);
  const auto with = inverse_filter(r, 1000.0, 300.0), without = inverse_filter(r, 1000.0, {});
  ASSERT_TRUE(with.ok() && without.ok());
  const double omega = kTwoPi * 300.0;
  EXPECT_NEAR(std::abs(answer(*with, omega, 1000.0) / answer(*without, omega, 1000.0)),
              std::sqrt(0.5),
              1e-9);
  EXPECT_FALSE(inverse_filter(RigResponse::of(1.0, 500.0, 0.1, 0.0), 2000.0).ok());
  const auto unstable = inverse_filter(RigResponse::of(1.0, 500.0, 0.1, -0.5), 2000.0);
  ASSERT_FALSE(unstable.ok());
  EXPECT_NE(unstable.failure().reason.find("differ in sign"), std::string::npos);
}

SyntheticRig hammered_rig() { return {2000.0, 6.0, kTruth, 11}; }

// 20 noisy hits give values within three standard deviations of the truth, and these deviations are
// small.
TEST(HammerTest, FindsTheFourNumbersAgain) {
  const Channels test = synthetic_hammer(hammered_rig(), 20, 2.0);
  const HammerSettings settings;
  const auto hits = find_hits(test["hammer"], 2000.0, settings);
  ASSERT_EQ(hits.size(), 20u);
  const auto response = hammer_response(test["hammer"], test["Fz"], 2000.0, hits, settings);
  const auto fit = fit_to_response(response, {20.0, 300.0});
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(fit.response.f, kTruth.f, std::max(3.0 * fit.sigma_f, 1e-4 * kTruth.f));
  EXPECT_NEAR(fit.response.zeta, kTruth.zeta, std::max(3.0 * fit.sigma_zeta, 1e-4));
  EXPECT_NEAR(fit.response.gain(), 0.55, std::max(3.0 * fit.sigma_gain, 1e-3));
  EXPECT_NEAR(fit.response.c, 0.55, std::max(3.0 * fit.sigma_c, 1e-3));
  EXPECT_LT(fit.sigma_f, 2e-3 * kTruth.f);
  // The scatter over redrawn hits is of the same size as that of the linear theory.
  const auto sigma = bootstrap_deviation(20, 30, 1, [&](const std::vector<int>& chosen) {
    std::vector<int> drawn;
    for (const int k : chosen) drawn.push_back(hits[k]);
    const auto H = hammer_response(test["hammer"], test["Fz"], 2000.0, drawn, settings);
    return std::vector<double>{fit_to_response(H, {20.0, 300.0}, fit.response).response.f};
  });
  EXPECT_GT(sigma[0], fit.sigma_f / 5.0);
  EXPECT_LT(sigma[0], fit.sigma_f * 5.0);
}

TEST(HammerTest, SaysWhatIsWrong) {
  EXPECT_THROW(find_hits(std::vector<double>(4000, 1.0), 2000.0, {}), InputError);
  const Channels test = synthetic_hammer(hammered_rig(), 3, 0.0);
  HammerSettings longer;
  longer.window = 60.0;
  EXPECT_THROW(find_hits(test["hammer"], 2000.0, longer), InputError);
  const auto hits = find_hits(test["hammer"], 2000.0, {});
  const auto H = hammer_response(test["hammer"], test["Fz"], 2000.0, hits, {});
  EXPECT_THROW(fit_to_response(H, {90.0, 91.0}), InputError);
}

/// Returns a periodic response of modes, and the same response distorted by the rig.
RimPair rims(int length, double delay) {
  numerics::Spectrum real(length / 2 + 1, 0.0);
  for (int k = 1; 2 * k < length; ++k) {
    const double w = kTwoPi * k * 2000.0 / length;
    for (const double f : {45.0, 92.0, 140.0}) {
      const double wm = kTwoPi * f;
      real[k] += 1e5 * wm / std::complex<double>(wm * wm - w * w, 0.1 * wm * w);
    }
    real[k] *= std::exp(-0.5 * std::pow(w * 1e-3, 2));
  }
  RimPair pair;
  auto dummy = real;
  for (int k = 1; 2 * k < length; ++k) {
    const double w = kTwoPi * k * 2000.0 / length;
    dummy[k] *= kTruth.at(w);
    real[k] *= std::polar(1.0, -w * delay);
  }
  pair.dummy = numerics::inverse_real_fft(dummy, length);
  pair.real = numerics::inverse_real_fft(real, length);
  return pair;
}

// Without noise the fitted filter is the inverse of the rig's response, and the delay is found too,
// from a start that is 10 % off.
TEST(RimFit, FindsTheInverseOfTheRigAndTheDelay) {
  const RigResponse exact = *inverse(kTruth);
  const auto start =
      RigResponse::of(0.9 * exact.gain(), 1.1 * exact.f, 1.2 * exact.zeta, 0.95 * exact.c);
  const auto fit =
      fit_to_rims({rims(1047, 0.0123), rims(800, -0.004)}, 2000.0, {10.0, 300.0}, start);
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(fit.response.f, exact.f, 1e-6 * exact.f);
  EXPECT_NEAR(fit.response.zeta, exact.zeta, 1e-7);
  EXPECT_NEAR(fit.response.gain(), exact.gain(), 1e-6);
  EXPECT_NEAR(fit.response.c, exact.c, 1e-6);
  EXPECT_NEAR(fit.delay, 0.0123, 1e-8);
}

// A sine of amplitude a has the mean square a^2/2: -3.01 dB for a = 1.
TEST(BandLevel, OfASineIsItsMeanSquare) {
  std::vector<double> x(4000), y(4000);
  for (int i = 0; i < 4000; ++i) {
    x[i] = std::sin(kTwoPi * 100.0 * i / 2000.0);
    y[i] = 2.0 * x[i];
  }
  const auto settings = numerics::welch_settings(numerics::Convention::scipy, 4000, 1000);
  const auto a = numerics::power_density(x, 2000.0, settings);
  EXPECT_NEAR(band_level(a, {80.0, 120.0}), 10.0 * std::log10(0.5), 1e-6);
  EXPECT_LT(band_level(a, {200.0, 300.0}), -200.0);
  const auto b = numerics::power_density(y, 2000.0, settings);
  EXPECT_NEAR(log_spectral_distance(a, b, {95.0, 105.0}), 20.0 * std::log10(2.0), 1e-9);
  const auto bands = third_octave_bands({50.0, 100.0});  // centers 50.1, 63.1, 79.4, 100
  ASSERT_EQ(bands.size(), 4u);
  EXPECT_NEAR(bands[1].upper, bands[2].lower, 1e-9);
  EXPECT_NEAR(std::sqrt(bands[3].lower * bands[3].upper), 100.0, 1e-9);
}

// A vibration of three periods per revolution of a drum that accelerates from 10 to 20 m/s becomes
// a single line.
TEST(OrderTracking, WhatTurnsWithTheDrumHasOneOrder) {
  const double rate = 2000.0, circumference = 5.0;
  std::vector<double> speed(40000), x(40000);
  double turned = 0.0;
  for (int i = 0; i < 40000; ++i) {
    speed[i] = 10.0 + 10.0 * i / 40000.0;
    x[i] = std::cos(kTwoPi * 3.0 * turned);
    turned += (speed[i] + 10.0 / 40000.0 / 2.0) / (rate * circumference);
  }
  const auto over = over_revolutions(x, speed, rate, circumference, 64);
  EXPECT_NEAR(static_cast<double>(over.size()), turned * 64.0, 2.0);
  const int samples = static_cast<int>(over.size());
  const auto density = numerics::power_density(
      over, 64, numerics::welch_settings(numerics::Convention::scipy, samples, 16 * 64));
  const auto peak = std::max_element(density.value.begin(), density.value.end());
  EXPECT_NEAR(density.frequency[peak - density.value.begin()], 3.0, 1e-12);
  EXPECT_NEAR(band_power(density, {2.5, 3.5}), 0.5, 1e-3);
}

}  // namespace
}  // namespace latsch
