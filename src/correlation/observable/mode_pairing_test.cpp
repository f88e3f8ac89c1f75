// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/mode_pairing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "correlation/observable/objective.h"

namespace latsch::correlation {
namespace {

using fe_tire::ModeType;

ModeRecord labeled(double frequency, int n, ModeType type, char phase = ' ') {
  return {frequency, n, type, phase, {}};
}

/// Returns cos(n theta - phi) at 12 points of a ring. Shapes of one n at phases pi/2/n apart are
/// orthogonal.
ModeRecord ring_mode(double frequency, int n, double phi) {
  ModeRecord mode;
  mode.frequency = frequency;
  mode.shape.resize(12);
  for (int i = 0; i < 12; ++i) mode.shape[i] = std::cos(n * 2.0 * M_PI * i / 12.0 - phi);
  return mode;
}

std::vector<int> partners(const ModePairing& pairing) {
  std::vector<int> simulated;
  for (const ModePair& pair : pairing.pairs) simulated.push_back(pair.simulated);
  return simulated;
}

TEST(PairModes, FollowsLabelsThroughASwap) {
  const auto pairing =
      pair_modes({labeled(40, 0, ModeType::torsional), labeled(41, 1, ModeType::lateral)},
                 {labeled(39, 1, ModeType::lateral), labeled(42, 0, ModeType::torsional)});
  EXPECT_EQ(partners(pairing), (std::vector<int>{1, 0}));
  EXPECT_TRUE(pairing.missing.empty());
}

TEST(PairModes, OfOneLabelKeepsTheOrderOfFrequencies) {
  const auto pairing =
      pair_modes({labeled(80, 2, ModeType::radial), labeled(120, 2, ModeType::radial)},
                 {labeled(100, 2, ModeType::radial), labeled(150, 2, ModeType::radial)});
  EXPECT_EQ(partners(pairing), (std::vector<int>{0, 1}));
}

TEST(PairModes, KeepsSymmetricFromAntisymmetric) {
  const auto pairing =
      pair_modes({labeled(80, 2, ModeType::radial, 's'), labeled(81, 2, ModeType::radial, 'a')},
                 {labeled(80, 2, ModeType::radial, 'a'), labeled(81, 2, ModeType::radial, 's')});
  EXPECT_EQ(partners(pairing), (std::vector<int>{1, 0}));
}

TEST(PairModes, TakesAnUnknownPartOfALabelForAnything) {
  ModeRecord unknown_type{40.0, 0, std::nullopt, ' ', {}};
  const auto pairing = pair_modes(
      {unknown_type}, {labeled(41, 1, ModeType::lateral), labeled(45, 0, ModeType::torsional)});
  EXPECT_EQ(partners(pairing), std::vector<int>{1});
  EXPECT_EQ(pairing.extra, std::vector<int>{0});
}

TEST(PairModes, FollowsShapesThroughASwap) {
  const auto pairing = pair_modes({ring_mode(40, 1, 0.0), ring_mode(45, 2, 0.0)},
                                  {ring_mode(43, 2, 0.0), ring_mode(44, 1, 0.0)});
  EXPECT_EQ(partners(pairing), (std::vector<int>{1, 0}));
  EXPECT_NEAR(pairing.pairs[0].likeness, 1.0, 1e-12);
}

TEST(PairModes, ComparesADegeneratePairAsAPlane) {
  // The simulated pair is rotated by a phase of 45 degrees, so vector by vector every MAC is 1/2
  // and would not distinguish the modes.
  const double quarter = M_PI / 4.0;
  const auto pairing = pair_modes(
      {ring_mode(80, 2, 0.0), ring_mode(80, 2, M_PI / 2)},
      {ring_mode(81, 2, quarter), ring_mode(81, 2, quarter + M_PI / 2), ring_mode(82, 3, 0.0)});
  EXPECT_EQ(partners(pairing), (std::vector<int>{0, 1}));
  EXPECT_NEAR(pairing.pairs[0].likeness, 1.0, 1e-12);
  EXPECT_EQ(pairing.extra, std::vector<int>{2});
}

TEST(PairModes, FindsASplitPairInADegenerateOne) {
  const auto pairing = pair_modes({ring_mode(78, 2, 0.3), ring_mode(82, 2, 0.3 + M_PI / 2)},
                                  {ring_mode(80, 2, 0.0), ring_mode(80, 2, M_PI / 2)});
  EXPECT_EQ(pairing.pairs.size(), 2u);
  EXPECT_NEAR(pairing.pairs[1].likeness, 1.0, 1e-12);
}

TEST(PairModes, ReportsWhatHasNoPartner) {
  const auto pairing = pair_modes({ring_mode(40, 1, 0.0), ring_mode(90, 5, 0.0)},
                                  {ring_mode(40, 1, 0.0), ring_mode(90, 4, 0.0)});
  EXPECT_EQ(pairing.missing, std::vector<int>{1});
  EXPECT_EQ(pairing.extra, std::vector<int>{1});
}

TEST(PairModes, DoesNotDependOnTheOrderTheModesAreGivenIn) {
  const auto pairing =
      pair_modes({labeled(120, 2, ModeType::radial), labeled(80, 2, ModeType::radial)},
                 {labeled(150, 2, ModeType::radial), labeled(100, 2, ModeType::radial)});
  EXPECT_EQ(partners(pairing), (std::vector<int>{0, 1}));
}

// Returns a lateral and a radial mode that cross: 80 Hz + 4 p and 81.5 Hz - p, coupled by k, which
// keeps their frequencies 2 k apart. Each is named by the larger part of its energy. A share
// `other` of the energy is neither lateral nor radial, so near the crossing both are called radial.
std::vector<ModeRecord> crossing(double p, double k, double other) {
  const double a = 80.0 + 4.0 * p, b = 81.5 - p, half = 0.5 * (a - b);
  const double root = std::hypot(half, k), lateral = root > 0.0 ? 0.5 * (1.0 + half / root) : 0.5;
  const auto mode = [&](double f, double share) {
    const bool is_lateral = (1.0 - other) * share > 0.5;
    return labeled(f, 2, is_lateral ? ModeType::lateral : ModeType::radial);
  };
  return {mode(0.5 * (a + b) - root, 1.0 - lateral), mode(0.5 * (a + b) + root, lateral)};
}

TEST(CompareModes, FrequenciesAreContinuousThroughACrossingOfOneN) {
  const std::vector<ModeRecord> measured{labeled(81.4, 2, ModeType::lateral),
                                         labeled(81.7, 2, ModeType::radial)};
  constexpr double kStep = 1e-4;  // step of p; it changes a frequency by at most 4 kStep
  constexpr double kMost =
      // includes three further such steps, over 1 %, while labels become reliable
      15.0 * kStep / 81.0;
  for (const double k : {0.0, 1e-6, 0.05, 0.15, 0.35}) {
    for (const double other : {0.0, 0.1}) {
      std::vector<double> last;
      for (double p = -1.0; p < 2.0; p += kStep) {
        const Comparison now = compare_modes(measured, crossing(p, k, other));
        EXPECT_TRUE(now.pairing.missing.empty()) << "p " << p << " k " << k;
        for (std::size_t i = 0; i < last.size(); ++i)
          EXPECT_LT(std::abs(now.errors[i] - last[i]), kMost) << "p " << p << " k " << k;
        last = now.errors;
      }
    }
  }
}

// Modes farther than 2 % apart are compared by name, in whatever order.
TEST(CompareModes, ModesOfOneNThatAreFarApartAreComparedByName) {
  const auto now =
      compare_modes({labeled(81.4, 2, ModeType::lateral), labeled(84.0, 2, ModeType::radial)},
                    {labeled(81.0, 2, ModeType::radial), labeled(84.5, 2, ModeType::lateral)});
  EXPECT_NEAR(now.errors[0], (81.4 - 84.5) / 81.4, 1e-12);
  EXPECT_NEAR(now.errors[1], (84.0 - 81.0) / 84.0, 1e-12);
}

TEST(CompareModes, OfDifferentNOrPhaseNoOrderIsTaken) {
  for (const auto& [n, phase] : {std::pair(3, 's'), std::pair(2, 'a')}) {
    const auto now = compare_modes(
        {labeled(81.4, 2, ModeType::lateral, 's'), labeled(81.7, n, ModeType::radial, phase)},
        {labeled(81.5, n, ModeType::radial, phase), labeled(81.6, 2, ModeType::lateral, 's')});
    EXPECT_NEAR(now.errors[0], (81.4 - 81.6) / 81.4, 1e-12);
    EXPECT_NEAR(now.errors[1], (81.7 - 81.5) / 81.7, 1e-12);
    EXPECT_EQ(now.compared[0].beside, -1);
  }
}

// The derivatives are compared with central differences in the range in which names are partly
// reliable.
TEST(CompareModes, SlopesOfCloseModesAreThoseOfWhatIsCompared) {
  const std::vector<ModeRecord> measured{labeled(81.4, 2, ModeType::lateral),
                                         labeled(81.7, 2, ModeType::radial)};
  const auto at = [&](double p, bool with_slopes) {
    const std::vector<ModeRecord> modes{labeled(82.6 + 3.0 * p, 2, ModeType::lateral),
                                        labeled(81.4 - 2.0 * p, 2, ModeType::radial)};
    return compare_modes(
        measured, modes, {}, with_slopes ? std::vector<double>{3.0, -2.0} : std::vector<double>{});
  };
  const Comparison here = at(0.0, true);
  ASSERT_EQ(here.compared[0].beside, 1);
  constexpr double kStep = 1e-6;
  for (std::size_t i = 0; i < 2; ++i) {
    const double slope = (at(kStep, false).errors[i] - at(-kStep, false).errors[i]) / (2.0 * kStep);
    EXPECT_NEAR(here.slopes[i], slope, 1e-7);
  }
}

// The measured lateral mode is not among the simulated ones, and the double radial mode is not a
// mixture with it.
TEST(PairModes, ADoubleModeIsNoPartnerForAnotherType) {
  const auto pairing =
      pair_modes({labeled(82, 2, ModeType::radial), labeled(84, 2, ModeType::lateral)},
                 {labeled(82, 2, ModeType::radial), labeled(82, 2, ModeType::radial)});
  EXPECT_EQ(pairing.missing, std::vector<int>{1});
}

TEST(CompareModes, ShapesThatComeTooCloseAreContinuousAsWell) {
  const std::vector<ModeRecord> measured{ring_mode(81.4, 1, 0.0), ring_mode(81.7, 2, 0.0)};
  std::vector<double> last;
  constexpr double kStep = 1e-4;
  for (double f = 81.0; f < 82.4; f += kStep) {
    const Comparison now = compare_modes(measured, {ring_mode(f, 1, 0.0), ring_mode(81.7, 2, 0.0)});
    for (std::size_t i = 0; i < last.size(); ++i)
      EXPECT_LT(std::abs(now.errors[i] - last[i]), 4.0 * kStep / 81.0) << f;
    last = now.errors;
  }
}

}  // namespace
}  // namespace latsch::correlation
