// SPDX-License-Identifier: Apache-2.0
#include "measurement/pulse_speed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"

namespace latsch {
namespace {

constexpr double kRate = 5000.0, kPitch = 0.1;                 // Hz, m
constexpr double kMean = 12.0, kSway = 1.5, kFrequency = 0.8;  // m/s, m/s, Hz

double speed_at(double t) {
  return kMean + kSway * std::sin(2.0 * std::numbers::pi * kFrequency * t);
}
/// Returns the integral of the speed until time t, m.
double way_at(double t) {
  const double w = 2.0 * std::numbers::pi * kFrequency;
  return kMean * t + kSway * (1.0 - std::cos(w * t)) / w;
}

/// Returns the signal of a sensor at a toothed wheel: a smooth wave, one period for each pitch,
/// with noise of this standard deviation.
std::vector<double> wave(double noise, double seconds = 5.0) {
  RandomStream chance(7, 0);
  std::vector<double> signal;
  for (int i = 0; i < static_cast<int>(seconds * kRate); ++i)
    signal.push_back(2.0 + std::sin(2.0 * std::numbers::pi * way_at(i / kRate) / kPitch) +
                     noise * chance.normal());
  return signal;
}

/// Returns the largest relative error of the mean speed over any 0.2 s.
double worst_mean(const std::vector<double>& speed) {
  constexpr int kWindow = static_cast<int>(0.2 * kRate);
  double worst = 0.0;
  for (std::size_t i = 100; i + kWindow + 100 < speed.size(); i += 50) {
    double mean = 0.0;
    for (std::size_t k = i; k < i + kWindow; ++k) mean += speed[k] / kWindow;
    const double from = (static_cast<double>(i) - 0.5) / kRate, to = from + kWindow / kRate;
    worst = std::max(worst, std::abs(mean - (way_at(to) - way_at(from)) / (to - from)));
  }
  return worst;
}

// Between pulses the distance has an error of v' T^2 / 8 with T = 8 ms and v' = 7.5 m/s^2: 6e-5 m,
// at both ends of a window of 0.2 s.
TEST(PulseSpeed, IsTheSpeedOfTheTeeth) {
  const auto speed = speed_of_pulses(wave(0.0), kRate, kPitch, "tooth", "run.csv");
  EXPECT_LT(worst_mean(speed), 2.0 * 6.2e-5 / 0.2);
  for (std::size_t i = 100; i + 100 < speed.size(); ++i)
    EXPECT_NEAR(speed[i], speed_at(static_cast<double>(i) / kRate), 0.5 * 7.6 * 0.0096);
}

// With five samples per interval the times of the pulses scatter by a tenth of an interval; this
// does not bias the mean.
TEST(PulseSpeed, CoarseSamplesDoNotBiasIt) {
  constexpr double kSpeed = 22.0, kFine = 0.06, kCoarse = 1900.0;
  std::vector<double> signal;
  for (int i = 0; i < 20000; ++i)
    signal.push_back(
        std::tanh(4.0 * std::sin(2.0 * std::numbers::pi * kSpeed * i / kCoarse / kFine)));
  const auto speed = speed_of_pulses(signal, kCoarse, kFine, "tooth", "run.csv");
  double mean = 0.0;
  for (std::size_t i = 100; i < 19900; ++i) mean += speed[i] / 19800.0;
  EXPECT_NEAR(mean, kSpeed, 1e-4 * kSpeed);
}

// The time of a pulse has an error of sigma / slope, so the distance has the corresponding error at
// both ends of a window.
TEST(PulseSpeed, NoiseOnAFlankIsNoPulse) {
  const auto noisy = wave(0.05);
  EXPECT_EQ(pulses_of(noisy).size(), pulses_of(wave(0.0)).size());
  const double deviation = 0.05 / (2.0 * std::numbers::pi) * kPitch * std::numbers::sqrt2 / 0.2;
  EXPECT_LT(worst_mean(speed_of_pulses(noisy, kRate, kPitch, "tooth", "run.csv")),
            5.0 * deviation + 2.0 * 6.2e-5 / 0.2);
}

TEST(PulseSpeed, AWheelThatRestsIsNotTakenToTurn) {
  std::vector<double> signal(static_cast<std::size_t>(2 * kRate), 1.0);
  const auto turning = wave(0.0, 1.0);
  signal.insert(signal.end(), turning.begin(), turning.end());
  const auto speed = speed_of_pulses(signal, kRate, kPitch, "tooth", "run.csv");
  EXPECT_LE(speed[1000], kPitch / 2.0 + 1e-3);  // there is no pulse for 2 s
}

std::string refusal(const std::vector<double>& signal) {
  try {
    speed_of_pulses(signal, kRate, kPitch, "tooth", "run.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PulseSpeed, RefusesWhatAreNoPulses) {
  EXPECT_NE(refusal(std::vector<double>(100, 1.0)).find("channel \"tooth\" has 0 pulses"),
            std::string::npos);
  std::vector<double> fast;
  for (int i = 0; i < 100; ++i) fast.push_back(i % 2);
  EXPECT_NE(refusal(fast).find("2.0 samples apart"), std::string::npos) << refusal(fast);
  EXPECT_EQ(refusal({}).find("accepted"), std::string::npos);
}

}  // namespace
}  // namespace latsch
