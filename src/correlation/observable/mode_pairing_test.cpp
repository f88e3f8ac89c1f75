// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/mode_pairing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::correlation {
namespace {

using fe_tire::ModeType;

ModeRecord labeled(double frequency, int n, ModeType type, char phase = ' ') {
  return {frequency, n, type, phase, {}};
}

/// cos(n theta - phi) at 12 points of a ring: shapes of one n at phases pi/2/n apart are
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
  // The simulated pair is turned by 45 degrees of phase: vector by vector every MAC is 1/2, a coin
  // toss.
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

}  // namespace
}  // namespace latsch::correlation
