// SPDX-License-Identifier: Apache-2.0
// The lag is compared with the closed forms of a first-order delay.
#include "experiment/rigs/slip/slip_lag.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "experiment/kinds/sparse_tir_testing.h"
#include "experiment/rigs/slip/slip_states.h"
#include "formats/tire/tir_file.h"

namespace latsch {
namespace {

using magic_formula::MagicFormula;
using magic_formula::Parameters;
using magic_formula::State;

constexpr double kSpeed = 10.0, kStep = 0.01, kLoad = 4000.0;

Parameters lagging_tire() {
  const ScratchFolder folder;
  write_text_file(
      folder / "tire.tir",
      experiment::sparse_tir(std::string("[STRUCTURAL]\nLONGITUDINAL_STIFFNESS = 300000\n"
                                         "LATERAL_STIFFNESS = 110000\n") +
                             experiment::kLongitudinalForce + experiment::kSideForce));
  return formats::read_tir(folder / "tire.tir").parameters;
}

struct History {
  std::vector<State> states;
  std::vector<double> times;
};

/// Slip ratio `kappa` and slip angle `tangent` as functions of time, at constant load and speed.
template <class Kappa, class Tangent>
History history(int count, Kappa kappa, Tangent tangent) {
  History all;
  for (int i = 0; i < count; ++i) {
    const double t = kStep * i;
    all.times.push_back(t);
    all.states.push_back({kLoad, kappa(t), std::atan(tangent(t)), 0.0, 0.0, kSpeed, 2.2e5});
  }
  return all;
}

// x = r (t - T (1 - exp(-t/T))),  T = sigma / V
TEST(SlipLag, ARampIsFollowedBehindByARelaxationLength) {
  const MagicFormula formula(lagging_tire());
  const auto ramps = history(
      80, [](double t) { return 0.1 * t; }, [](double t) { return -0.2 * t; });
  const Channels found = lagging_answers(formula, ramps.states, ramps.times);
  const auto [sigma_x, sigma_y] = std::pair(found["sigma_x"][0], found["sigma_y"][0]);
  EXPECT_NEAR(sigma_x, found["Kxk"][0] / 300000, 1e-12);
  EXPECT_GT(sigma_y, 0.1);
  const auto behind = [](double t, double sigma) {
    const double T = sigma / kSpeed;
    return t - T * (1.0 - std::exp(-t / T));
  };
  for (std::size_t i = 0; i < ramps.times.size(); ++i) {
    const double t = ramps.times[i];
    EXPECT_NEAR(found["kappa"][i], 0.1 * behind(t, sigma_x), 1e-14);
    EXPECT_NEAR(std::tan(found["alpha"][i]), -0.2 * behind(t, sigma_y), 1e-14);
    const State lagging{kLoad, found["kappa"][i], found["alpha"][i], 0.0, 0.0, kSpeed, 2.2e5};
    EXPECT_EQ(found["Fy"][i], formula.evaluate(lagging).Fy);
  }
}

// The ledger of a record must report gaps and samples that are too far apart.
TEST(SlipLag, GapsAndCoarseSamplesAreTold) {
  const MagicFormula formula(lagging_tire());
  const auto ramp = [](double t) { return 0.02 * t; };
  const auto told = [&](const History& record) {
    std::string all;
    for (const std::string& one : lag_limits(formula, record.states, record.times)) all += one;
    return all;
  };
  History fine = history(50, ramp, ramp);
  EXPECT_EQ(told(fine), "");
  History jump = fine;
  for (std::size_t i = 20; i < 50; ++i) jump.times[i] += 1000.0;
  EXPECT_NE(told(jump).find("1 step of time is backward, repeated or more than three times the "
                            "usual one (1000 s behind sample 20)"),
            std::string::npos)
      << told(jump);
  History twice = fine;
  twice.times[30] = twice.times[29];
  EXPECT_NE(told(twice).find("0 s behind sample 30"), std::string::npos) << told(twice);
  History coarse = fine;
  for (double& time : coarse.times) time *= 50.0;
  EXPECT_NE(told(coarse).find("samples are 5 m of road apart, but kappa lags"), std::string::npos)
      << told(coarse);
  EXPECT_NE(told(coarse).find("alpha lags by a relaxation length"), std::string::npos);
}

TEST(SlipLag, WithoutRelaxationLengthsNothingLags) {
  Parameters p = lagging_tire();
  p.LATERAL_STIFFNESS = 0.0;
  const History record = history(
      10, [](double) { return 0.0; }, [](double t) { return t; });
  const auto told = lag_limits(MagicFormula(p), record.states, record.times);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told.front(),
            "alpha does not lag: the tire has no relaxation length for it (LATERAL_STIFFNESS)");
}

TEST(SlipLag, ARecordFromItsEndToItsBeginIsNone) {
  std::size_t sample = 0;
  EXPECT_EQ(no_record({0.0, 0.1, 0.2, 0.05, 0.3}, sample), "");
  EXPECT_NE(no_record({0.3, 0.2, 0.1}, sample).find("does not rise in 2 of 2 steps"),
            std::string::npos);
  EXPECT_EQ(sample, 1u);
  EXPECT_NE(no_record({0.0, 0.0, 0.0, 0.1}, sample), "");
  EXPECT_NE(no_record({0.0}, sample).find("single sample"), std::string::npos);
}

// During a gap in time a tire has rolled far, so it behaves like a tire that starts there.
TEST(SlipLag, AGapBeginsAnew) {
  const MagicFormula formula(lagging_tire());
  const auto slip = [](double t) { return 0.05 * std::sin(20.0 * t); };
  auto whole = history(60, slip, slip);
  History behind{{whole.states.begin() + 30, whole.states.end()},
                 {whole.times.begin() + 30, whole.times.end()}};
  for (std::size_t i = 30; i < 60; ++i) whole.times[i] += 5.0;
  const Channels all = lagging_answers(formula, whole.states, whole.times);
  const Channels part = lagging_answers(formula, behind.states, behind.times);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_NEAR(all["Fy"][30 + i], part["Fy"][i], 1e-9);
  EXPECT_EQ(part["alpha"][0], behind.states[0].alpha);
}

TEST(SlipLag, WithoutStiffnessInTheRoadNothingLags) {
  Parameters stiff = lagging_tire();
  stiff.LONGITUDINAL_STIFFNESS = stiff.LATERAL_STIFFNESS = 0.0;
  const auto slip = [](double t) { return 0.05 * std::sin(20.0 * t); };
  const auto one = history(40, slip, slip);
  const Channels lagging = lagging_answers(MagicFormula(stiff), one.states, one.times);
  const Channels steady = answers(MagicFormula(stiff), one.states);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_NEAR(lagging["Fy"][i], steady["Fy"][i], 1e-9);
}

// (f(p + h) - f(p - h)) / 2h, with an error of h^2 f''' / 6 and eps f / h
TEST(SlipLag, SlopesAreThoseOfTheAnswers) {
  const Parameters truth = lagging_tire();
  const auto one = history(
      50,
      [](double t) { return 0.03 * std::sin(9.0 * t); },
      [](double t) { return 0.06 * std::cos(12.0 * t); });
  const std::vector<std::string> names = {
      "PKY1", "PDY1", "LATERAL_STIFFNESS", "LONGITUDINAL_STIFFNESS", "PKX1"};
  const std::vector<double Parameters::*> members = {&Parameters::PKY1,
                                                     &Parameters::PDY1,
                                                     &Parameters::LATERAL_STIFFNESS,
                                                     &Parameters::LONGITUDINAL_STIFFNESS,
                                                     &Parameters::PKX1};
  const std::vector<std::string> channels = {"Fx", "Fy", "Mz"};
  const Channels found =
      lagging_answers(MagicFormula(truth), one.states, one.times, channels, names);
  for (const char* channel : {"Fx", "Fy"}) {
    const auto& slopes = found.find(channel)->slopes;
    ASSERT_EQ(slopes.size(), 50 * names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      const double h = 1e-5 * std::abs(truth.*members[k]);
      Parameters up = truth, down = truth;
      up.*members[k] += h;
      down.*members[k] -= h;
      const auto above = lagging_answers(MagicFormula(up), one.states, one.times)[channel];
      const auto below = lagging_answers(MagicFormula(down), one.states, one.times)[channel];
      double largest = 0.0, worst = 0.0;
      for (std::size_t i = 0; i < 50; ++i) {
        const double difference = (above[i] - below[i]) / (2.0 * h);
        largest = std::max(largest, std::abs(difference));
        worst = std::max(worst, std::abs(slopes[50 * k + i] - difference));
      }
      EXPECT_LE(worst, 1e-7 * largest + 1e-9) << channel << " by " << names[k];
    }
  }
}

}  // namespace
}  // namespace latsch
