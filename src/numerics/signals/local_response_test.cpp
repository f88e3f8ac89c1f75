// SPDX-License-Identifier: Apache-2.0
// Tests the response of a mass on a spring, driven by a sweep from below to above its natural
// frequency, against its closed form; the response of a delay; and the effect of noise on the
// coherence.
#include "numerics/signals/local_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace latsch::numerics {
namespace {

constexpr double kRate = 1000.0, kPi = std::numbers::pi;

/// Returns a sweep of 20 s from 0.5 to 30 Hz, faded in and out over 1 s, followed by 3 s of zeros.
std::vector<double> sweep() {
  std::vector<double> x;
  const double grows = std::log(60.0) / 20.0;
  for (int i = 0; i < 23000; ++i) {
    const double t = i / kRate, f = 0.5 * std::exp(grows * t);
    const double fade = std::clamp(std::min(t, 20.0 - t), 0.0, 1.0);
    x.push_back(fade * fade * (3.0 - 2.0 * fade) * std::sin(2.0 * kPi * (f - 0.5) / grows));
  }
  return x;
}

std::vector<double> lines() {
  std::vector<double> f;
  for (int i = 2; i <= 100; ++i) f.push_back(0.25 * i);
  return f;
}

/// Solves y'' + 2 ζ w y' + w² y = w² x for x that is linear between samples.
std::vector<double> oscillator(const std::vector<double>& x, double w, double zeta) {
  // The classical Runge-Kutta method with 20 steps per sample has an error of 1e-10.
  std::vector<double> y;
  double q = 0.0, v = 0.0;
  const double h = 1.0 / kRate / 20.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    y.push_back(q);
    if (i + 1 == x.size()) break;
    for (int s = 0; s < 20; ++s) {
      const auto u = [&](double part) { return x[i] + (x[i + 1] - x[i]) * (s + part) / 20.0; };
      const auto a = [&](double p, double r, double part) {
        return w * w * (u(part) - p) - 2.0 * zeta * w * r;
      };
      const double k1 = a(q, v, 0.0), v1 = v + 0.5 * h * k1, k2 = a(q + 0.5 * h * v, v1, 0.5),
                   v2 = v + 0.5 * h * k2, k3 = a(q + 0.5 * h * v1, v2, 0.5), v3 = v + h * k3,
                   k4 = a(q + h * v2, v3, 1.0);
      q += h / 6.0 * (v + 2.0 * v1 + 2.0 * v2 + v3);
      v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
  }
  return y;
}

TEST(LocalResponse, OfAnOscillatorItIsItsClosedForm) {
  const std::vector<double> x = sweep(), f = lines();
  for (const auto& [frequency, zeta] : {std::pair{1.25, 0.25}, {4.0, 0.1}, {12.0, 0.05}}) {
    const double w = 2.0 * kPi * frequency;
    const LocalResponse found = local_response(x, oscillator(x, w, zeta), kRate, f);
    for (std::size_t i = 0; i < f.size(); ++i) {
      const double r = f[i] / frequency;
      const std::complex<double> expected = 1.0 / std::complex<double>(1.0 - r * r, 2.0 * zeta * r);
      EXPECT_LT(std::abs(found.response[i] - expected), 0.01 * std::abs(expected))
          << frequency << ": " << f[i];
      EXPECT_GT(found.coherence[i], 0.999) << frequency << ": " << f[i];
    }
  }
}

// The record rests at one level at its start and at another level at its end. Neither level may
// change the response.
TEST(LocalResponse, WhereARecordRestsDoesNotCount) {
  std::vector<double> x = sweep(), y(x.size());
  const std::vector<double> f = lines();
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] += 7.0 + 2.0 * std::min(1.0, static_cast<double>(i) / 15000.0);
    y[i] = -3.0 * x[i] + 40.0;
  }
  const LocalResponse found = local_response(x, y, kRate, f);
  for (const std::complex<double>& h : found.response) EXPECT_LT(std::abs(h + 3.0), 1e-9);
}

// The response of a body that oscillates for a long time is represented less well by a fit of the
// same order without a delay.
TEST(LocalResponse, ADelayFollowsWhatRingsLonger) {
  const std::vector<double> x = sweep(), f = lines();
  const double frequency = 1.25, zeta = 0.1;
  const std::vector<double> y = oscillator(x, 2.0 * kPi * frequency, zeta);
  const auto error_of = [&](const LocalSettings& settings) {
    const LocalResponse found = local_response(x, y, kRate, f, settings);
    double worst = 0.0;
    for (std::size_t i = 0; i < f.size(); ++i) {
      const double r = f[i] / frequency;
      const std::complex<double> expected = 1.0 / std::complex<double>(1.0 - r * r, 2.0 * zeta * r);
      worst = std::max(worst, std::abs(found.response[i] - expected) / std::abs(expected));
    }
    return worst;
  };
  const double at_once = error_of({.order = 6}), delayed = error_of({.order = 6, .delay = 0.8});
  EXPECT_LT(delayed, 0.01);
  EXPECT_LT(delayed, at_once);
}

// The square of a sweep is not a linear response to the sweep. In narrow bands of frequency it
// nevertheless appears coherent with it, unless the fit is told that the square has no linear
// relation to the sweep.
TEST(LocalResponse, WhatIsKnownNotToFollowLowersTheCoherence) {
  const std::vector<double> x = sweep();
  std::vector<double> squares(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) squares[i] = x[i] * x[i];
  const LocalResponse found = local_response(x, x, kRate, lines(), {}, squares);
  for (std::size_t i = 4; i < 60; ++i) {
    EXPECT_LT(std::abs(found.response[i] - 1.0), 1e-9);
    EXPECT_GT(found.coherence[i], 0.3);
    EXPECT_LT(found.coherence[i], 0.95);
  }
}

TEST(LocalResponse, CoherenceIsTheShareThatFollows) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> x(40000), y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = normal(random);
    y[i] = 2.0 * x[i] + 2.0 * normal(random);  // half of the power of y is coherent with x
  }
  const LocalResponse found = local_response(x, y, kRate, lines(), {.width = 0.5});
  double mean = 0.0;
  for (const double c : found.coherence) mean += c / static_cast<double>(found.coherence.size());
  EXPECT_NEAR(mean, 0.5, 0.05);
  const std::vector<double> still(x.size(), 1.0);
  EXPECT_EQ(local_response(still, y, kRate, lines()).coherence[3], 0.0);
}

}  // namespace
}  // namespace latsch::numerics
