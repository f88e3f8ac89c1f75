// SPDX-License-Identifier: Apache-2.0
// Tests of the fitted delay of a recording: closed forms, and the scatter that statistics predicts.
#include "correlation/observable/curve_delay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "base/error.h"
#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "correlation/study/study.h"

namespace latsch::correlation {
namespace {

constexpr int kDelayedSamples = 201;
constexpr double kDelayedRate = 200.0;  // Hz; one second is measured

/// A study of a program whose curve the test supplies, simulated from -0.5 to 1.5 s.
class Delays : public testing::Test {
 protected:
  using Curve = std::function<double(double)>;

  void measure(const Curve& y) {
    std::ofstream out(folder_ / "measured.csv");
    out << "t [s],y [N]\n";
    out.precision(17);
    for (int i = 0; i < kDelayedSamples; ++i)
      out << i / kDelayedRate << ',' << y(i / kDelayedRate) << '\n';
  }
  Study study(const std::string& settings, const std::string& x = "out/t") {
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
y = "out/y"
measurement = "measured.csv"
exponent = 2
scale = "2 N"
)" << (x.empty() ? "" : "x = \"" + x + "\"\n")
                                          << settings;
    return read_study(folder_ / "study.toml", experiment::language());
  }
  static Channels simulated(const Curve& y,
                            double from = -0.5,
                            double to = 1.5,
                            double step = 1e-3) {
    Channel t{"out/t", "s", {}}, values{"out/y", "N", {}};
    const long steps = std::lround((to - from) / step);
    for (long i = 0; i <= steps; ++i) {
      t.values.push_back(from + static_cast<double>(i) * step);
      values.values.push_back(y(t.values.back()));
    }
    Channels channels;
    channels.add(t);
    channels.add(values);
    return channels;
  }
  Comparison compared(const Study& study, const Channels& channels) {
    return compare(study.experiments[0], study.experiments, channels);
  }
  void refused(const std::string& settings,
               const std::string& part,
               const std::string& x = "out/t") {
    try {
      study(settings, x);
      FAIL() << settings;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }

  ScratchFolder folder_;
};

constexpr const char* kFree = "nuisance = {delay = \"free\"}\n";

/// The curve is straight between samples of the simulation, so that interpolation between them is
/// exact.
double hit(double t) { return std::max(0.0, 3.0 - 30.0 * std::abs(t - 0.4)); }

TEST_F(Delays, ARecordingThatBeganLaterIsAlignedToTheLastDigit) {
  measure([](double t) { return hit(t - 0.0173); });
  const Study s = study(kFree);
  const Comparison found = compared(s, simulated(hit));
  ASSERT_TRUE(found.delay);
  EXPECT_NEAR(found.delay->value, 0.0173, 1e-9);
  EXPECT_FALSE(found.delay->at_end);
  EXPECT_LT(found.value, 1e-12);
}

TEST_F(Delays, ARecordingThatBeganEarlierHasANegativeDelay) {
  measure([](double t) { return hit(t + 0.041); });
  EXPECT_NEAR(compared(study(kFree), simulated(hit)).delay->value, -0.041, 1e-9);
}

TEST_F(Delays, AnOffsetDoesNotCountAboutTheMean) {
  measure([](double t) { return 100.0 + hit(t - 0.0173); });
  const Comparison found =
      compared(study(std::string("compare = \"about_mean\"\n") + kFree), simulated(hit));
  EXPECT_NEAR(found.delay->value, 0.0173, 1e-9);
}

TEST_F(Delays, NoneIsFittedUnlessAskedFor) {
  measure([](double t) { return hit(t - 0.0173); });
  const Comparison found = compared(study(""), simulated(hit));
  EXPECT_FALSE(found.delay);
  EXPECT_GT(found.value, 1e-3);
}

TEST_F(Delays, TheEndOfTheRangeIsTold) {
  // a quarter of the record, which exceeds the limit of a tenth
  measure([](double t) { return hit(t - 0.25); });
  const Comparison found = compared(study(kFree), simulated(hit));
  EXPECT_TRUE(found.delay->at_end);
}

TEST_F(Delays, ASimulationAsLongAsTheRecordLeavesNoRoom) {
  measure(hit);
  const Study s = study(kFree);
  try {
    compared(s, simulated(hit, 0.0, 1.0));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no room for the delay"), std::string::npos);
  }
}

// In linear theory the variance of the delay is that of a difference over the sum of squared
// slopes.
TEST_F(Delays, ItsScatterIsWhatItsStiffnessSays) {
  const auto wave = [](double t) { return 3.0 * std::exp(-t * t) * std::sin(40.0 * t); };
  constexpr double kNoise = 0.2, kTrue = 0.012;  // N, s
  constexpr int kSets = 300;
  const Channels trial = simulated(wave);
  RandomStream chance(7, 0);
  double sum = 0.0, promised = 0.0;
  for (int k = 0; k < kSets; ++k) {
    measure([&](double t) { return wave(t - kTrue) + kNoise * chance.normal(); });
    const Comparison found = compared(study(kFree), trial);
    sum += std::pow(found.delay->value - kTrue, 2.0);
    promised += std::pow(kNoise / 2.0, 2.0) / found.delay->stiffness;  // the scale is 2 N
  }
  // three standard deviations of a variance that is estimated from 300 draws
  EXPECT_NEAR(sum / promised, 1.0, 0.25);
}

// The derivatives of differences at the fitted delay are compared with central differences at an
// exact fit, where Kaufman's formula is complete. Between samples 0.1 ms apart the curve is
// straight, so its steepness is wrong by up to y'' h / 2 = 450 N/s^2 0.1 ms / 2 = 0.023 N/s, which
// the derivative of the delay, 0.23 s, turns into 2.6e-3 of the scale of 2 N.
TEST_F(Delays, SlopesHaveNoPartAlongTheDelay) {
  const auto wave = [](double t, double k) { return k * std::sin(30.0 * t / k); };
  measure([&](double t) { return wave(t - 0.01, 2.0); });
  const Study s = study(kFree);
  constexpr double kStep = 1e-4;
  const auto at = [&](double k) {
    return compared(s, simulated([&](double t) { return wave(t, k); }, -0.5, 1.5, 1e-4));
  };
  Channels trial = simulated([&](double t) { return wave(t, 2.0); }, -0.5, 1.5, 1e-4), with;
  for (Channel channel : trial.all()) {
    channel.slopes.assign(channel.values.size(), 0.0);
    if (channel.name == "out/y")
      for (std::size_t i = 0; i < channel.values.size(); ++i) {
        const double phase = 30.0 * trial["out/t"][i] / 2.0;
        channel.slopes[i] = std::sin(phase) - phase * std::cos(phase);
      }
    with.add(channel);
  }
  const Comparison found = compared(s, with), up = at(2.0 + kStep), down = at(2.0 - kStep);
  ASSERT_EQ(found.slopes.size(), found.differences.size());
  for (std::size_t i = 0; i < found.slopes.size(); ++i)
    EXPECT_NEAR(found.slopes[i], (up.differences[i] - down.differences[i]) / (2.0 * kStep), 3e-3);
  EXPECT_NEAR(found.delay->slopes[0], (up.delay->value - down.delay->value) / (2.0 * kStep), 1e-4);
}

TEST_F(Delays, WithoutAMeaningTheyAreRefused) {
  measure(hit);
  refused(std::string("compare = \"psd\"\n") + kFree, "a delay makes no");
  refused(kFree, "needs a curve over time", "");
  refused("nuisance = {delay = \"2 ms\"}\n", "weighed against the measured values");
  refused("nuisance = {delai = \"free\"}\n", "did you mean \"delay\"");
}

}  // namespace
}  // namespace latsch::correlation
