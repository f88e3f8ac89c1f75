// SPDX-License-Identifier: Apache-2.0
#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace latsch {
namespace {

using Words = std::array<std::uint32_t, 4>;

// The three known-answer vectors of philox4x32-10 in the authors' Random123 distribution
// (tests/kat_vectors): all zeros, all ones, digits of pi.
TEST(Random, PhiloxGivesThePublishedAnswers) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t kOnes = 0xffffffff;
  EXPECT_EQ(philox4x32({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, AStreamIsAFunctionOfSeedAndTrial) {
  std::set<double> all;
  for (std::uint64_t seed = 0; seed < 5; ++seed)
    for (std::uint64_t trial = 0; trial < 5; ++trial) {
      RandomStream a(seed, trial), b(seed, trial);
      for (int i = 0; i < 20; ++i) {
        const double u = a.uniform();
        EXPECT_EQ(u, b.uniform());
        all.insert(u);
      }
    }
  EXPECT_EQ(all.size(), 500u);  // no two streams have a number in common
}

// Mean and variance of n uniform numbers are within 5 standard errors of 1/2 and 1/12: the standard
// errors are sqrt(1/12 / n) and sqrt(1/180 / n).
TEST(Random, UniformNumbersHaveTheirMoments) {
  constexpr int n = 100000;
  RandomStream stream(1, 2);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double u = stream.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u - 0.5;
    squares += (u - 0.5) * (u - 0.5);
  }
  EXPECT_NEAR(sum / n, 0.0, 5 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(squares / n, 1.0 / 12, 5 * std::sqrt(1.0 / 180 / n));
}

// Mean 0, variance 1, fourth moment 3 within 5 standard errors: sqrt(1/n), sqrt(2/n), sqrt(96/n).
TEST(Random, NormalNumbersHaveTheirMoments) {
  constexpr int n = 100000;
  RandomStream stream(3, 4);
  double m1 = 0.0, m2 = 0.0, m4 = 0.0;
  for (int i = 0; i < n; ++i) {
    const double z = stream.normal();
    m1 += z;
    m2 += z * z;
    m4 += z * z * z * z;
  }
  EXPECT_NEAR(m1 / n, 0.0, 5 * std::sqrt(1.0 / n));
  EXPECT_NEAR(m2 / n, 1.0, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(m4 / n, 3.0, 5 * std::sqrt(96.0 / n));
}

TEST(Random, IntegersAreEquallyLikely) {
  constexpr int n = 60000;
  RandomStream stream(5, 6);
  std::vector<int> count(6);
  for (int i = 0; i < n; ++i) ++count[stream.below(6)];
  for (const int c : count) EXPECT_NEAR(c, n / 6, 5 * std::sqrt(n * 5.0 / 36));
}

}  // namespace
}  // namespace latsch
