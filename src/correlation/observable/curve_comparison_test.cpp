// SPDX-License-Identifier: Apache-2.0
// Compared properties of two curves in closed form.
#include "correlation/observable/curve_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include "base/error.h"
#include "base/scratch_folder_testing.h"
#include "correlation/study/study.h"
#include "correlation/target/study_trials.h"

namespace latsch::correlation {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr int kSamples = 200;
constexpr double kRate = 100.0;

/// A study of a program whose only output is a curve that the test supplies.
class ComparedCurves : public testing::Test {
 protected:
  /// Writes y(t) at kSamples times as the measurement.
  void measure(const std::function<double(double)>& y) {
    std::ofstream out(folder_ / "measured.csv");
    out << "t [s],y [N]\n";
    out.precision(17);
    for (int i = 0; i < kSamples; ++i) out << i / kRate << ',' << y(i / kRate) << '\n';
  }
  Study study(const std::string& settings) {
    std::ofstream(folder_ / "in.txt") << "{k}";
    std::ofstream(folder_ / "study.toml") << R"(
[simulator]
command = ["/bin/true"]
inputs = ["in.txt"]
[simulator.output.out]
file = "out.csv"
reader = "table"
quantities = ["t [s]", "y [N]"]
[variable.k]
lower = 1
upper = 9
initial = 2
[experiment.e]
kind = "curve"
x = "out/t"
y = "out/y"
measurement = "measured.csv"
exponent = 2
)" << settings;
    return read_study(folder_ / "study.toml", experiment::language());
  }
  static Channels simulated(const std::function<double(double)>& y) {
    Channel t{"out/t", "s", {}}, values{"out/y", "N", {}};
    for (int i = 0; i < kSamples; ++i) {
      t.values.push_back(i / kRate);
      values.values.push_back(y(i / kRate));
    }
    Channels channels;
    channels.add(t);
    channels.add(values);
    return channels;
  }
  static Score score(const Study& study, const Channels& channels) {
    const auto score = objective(study)(channels);
    if (!score) throw std::runtime_error(score.failure().reason);
    return *score;
  }
  void refused(const std::string& settings, const std::string& part) {
    try {
      study(settings);
      FAIL() << settings;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  ScratchFolder folder_;
};

double sine(double t) { return 3.0 * std::sin(kTwoPi * 10.0 * t); }

// The RMS of a difference of 0.6 at a scale of 3 gives T = 0.04.
TEST_F(ComparedCurves, TimeSeriesHaveTheirRootMeanSquare) {
  measure(sine);
  const auto s = study("scale = \"3 N\"\n");
  EXPECT_NEAR(score(s, simulated([](double t) { return sine(t) + 0.6; })).value, 0.04, 1e-12);
}

TEST_F(ComparedCurves, AConstantOffsetDoesNotCountAboutTheMean) {
  measure(sine);
  const auto s = study("compare = \"about_mean\"\n");
  EXPECT_LT(score(s, simulated([](double t) { return sine(t) + 50.0; })).value, 1e-24);
}

// In the objective of the thesis neither offset nor phase matters. Twice the amplitude is four
// times the density: at the highest line d = -3 in units of the measured peak.
TEST_F(ComparedCurves, DensitiesCountNeitherOffsetNorPhase) {
  measure(sine);
  const auto s = study("compare = \"psd\"\nsegment = \"1 s\"\nband = [\"5 Hz\", \"20 Hz\"]\n");
  ASSERT_EQ(score(s, simulated(sine)).residuals.size(), 16u);  // at 5, 6 ... 20 Hz
  const auto moved = [](double t) { return 7.0 + 3.0 * std::sin(kTwoPi * 10.0 * t + 1.0); };
  EXPECT_LT(score(s, simulated(moved)).value, 1e-20);
  const auto twice = score(s, simulated([](double t) { return 2.0 * sine(t); }));
  EXPECT_NEAR(twice.residuals[5], -3.0 / std::sqrt(16.0), 1e-9);
}

// Twice the amplitude gives 6.02 dB more in the bands with power, which is 0.602 of the scale of 10
// dB.
TEST_F(ComparedCurves, LevelsCountRatios) {
  measure([](double t) { return sine(t) + 0.01 * std::sin(kTwoPi * 25.0 * t); });
  const auto s =
      study("compare = \"band_levels\"\nsegment = \"1 s\"\nband = [\"9 Hz\", \"11 Hz\"]\n");
  const auto twice = score(s, simulated([](double t) { return 2.0 * sine(t); }));
  ASSERT_EQ(twice.residuals.size(), 1u);  // the band around 10 Hz
  EXPECT_NEAR(twice.residuals[0], -2.0 * std::log10(2.0), 1e-6);
}

TEST_F(ComparedCurves, AProgramWithoutPowerStillHasALevel) {
  measure(sine);
  const auto s = study("compare = \"band_levels\"\n");
  for (const double r : score(s, simulated([](double) { return 0.0; })).residuals) {
    EXPECT_TRUE(std::isfinite(r));
  }
}

// The curve is force over slip, simulated there and back. A slope of 10 in scaled axes, shifted by
// 0.01 in x, has an error of 0.0995 in y, but a distance of 0.00995 from the path.
TEST_F(ComparedCurves, APathMayTurnBackAndSteepPartsAreNotWeighedTwice) {
  std::ofstream out(folder_ / "measured.csv");
  out << "t [s],y [N]\n0.2,2\n0.5,5\n";
  out.close();
  const auto s = study("compare = \"path\"\nx_scale = \"1 s\"\nscale = \"1 N\"\n");
  Channels channels;
  channels.add({"out/t", "s", {0.01, 1.01, 2.0, 0.01}});
  channels.add({"out/y", "N", {0.0, 10.0, 30.0, 30.0}});
  const auto found = score(s, channels);
  ASSERT_EQ(found.residuals.size(), 2u);
  for (const double r : found.residuals) {
    EXPECT_NEAR(r, std::sqrt(0.5) * 0.1 / std::hypot(1.0, 10.0), 1e-12);
  }
}

TEST_F(ComparedCurves, WhatMakesNoSenseIsRefusedInWords) {
  measure(sine);
  refused("compare = \"psdd\"\n", "did you mean \"psd\"");
  refused("compare = \"psd\"\nband = [\"20 Hz\", \"5 Hz\"]\n", "two rising frequencies");
  refused("compare = \"psd\"\nband = [\"10.1 Hz\", \"10.2 Hz\"]\n", "holds no frequency");
  refused("compare = \"psd\"\nsegment = \"1 ms\"\n", "expected 8 at least");
  for (const char* longer : {"1e3 s", "4294968 s", "1e17 s"})
    refused("compare = \"psd\"\nsegment = \"" + std::string(longer) + "\"\n",
            "expected a part of it");
  refused("compare = \"psd\"\nx_scale = \"1 s\"\n", "x_scale");
  std::ofstream(folder_ / "measured.csv")
      << "t [s],y [N]\n0,1\n1,2\n2,3\n3,3\n4,1\n5,1\n6,1\n7.5,1\n";
  refused("compare = \"psd\"\n", "is not sampled at a constant rate");
}

}  // namespace
}  // namespace latsch::correlation
