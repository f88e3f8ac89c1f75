// SPDX-License-Identifier: Apache-2.0
// Every function against the C library, whose results are within one unit in the last place.
#include "numerics/lane_math.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "base/random.h"

namespace latsch::lane_math {
namespace {

constexpr double kUnit = std::numeric_limits<double>::epsilon();

double uniform(RandomStream& random, double lower, double upper) {
  return lower + (upper - lower) * random.uniform();
}

/// The largest error in units of the last place of max(|f|, scale).
double worst(double lower,
             double upper,
             double scale,
             const std::function<double(double)>& ours,
             const std::function<double(double)>& theirs) {
  RandomStream random(7, 1);
  double error = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double x = uniform(random, lower, upper);
    const double expected = theirs(x);
    error = std::max(error,
                     std::abs(ours(x) - expected) / (kUnit * std::max(std::abs(expected), scale)));
  }
  return error;
}

TEST(LaneMath, WithinAFewUnitsOfTheCLibrary) {
  using std::function;
  const double tiny = std::numeric_limits<double>::min();
  const auto atan_c = [](double x) { return std::atan(x); };
  EXPECT_LT(worst(
                -4, 4, tiny, [](double x) { return atan(x); }, atan_c),
            4.0);
  EXPECT_LT(worst(
                -1e6, 1e6, tiny, [](double x) { return atan(x); }, atan_c),
            4.0);
  for (const double range : {1.0, 30.0, 1e4}) {
    EXPECT_LT(worst(
                  -range,
                  range,
                  1.0,
                  [](double x) { return sin(x); },
                  [](double x) { return std::sin(x); }),
              2.0);
    EXPECT_LT(worst(
                  -range,
                  range,
                  1.0,
                  [](double x) { return cos(x); },
                  [](double x) { return std::cos(x); }),
              2.0);
  }
  EXPECT_LT(
      worst(
          -50, 50, tiny, [](double x) { return exp(x); }, [](double x) { return std::exp(x); }),
      4.0);
  EXPECT_LT(
      worst(
          1e-3, 5, 0.1, [](double x) { return log(x); }, [](double x) { return std::log(x); }),
      4.0);
  EXPECT_LT(worst(
                0.0,
                5,
                tiny,
                [](double x) { return power(x, 0.85); },
                [](double x) { return std::pow(x, 0.85); }),
            16.0);
}

TEST(LaneMath, ZerosAndSigns) {
  EXPECT_EQ(atan(0.0), 0.0);
  EXPECT_TRUE(std::signbit(atan(-0.0)));
  EXPECT_EQ(sin(0.0), 0.0);
  EXPECT_EQ(cos(0.0), 1.0);
  EXPECT_EQ(exp(0.0), 1.0);
  EXPECT_EQ(log(1.0), 0.0);
  EXPECT_EQ(power(0.0, 0.85), 0.0);
  EXPECT_EQ(power(0.0, 0.0), 1.0);
  EXPECT_EQ(sign(-0.0), 0.0);
  EXPECT_EQ(sign_or_one(0.0), 1.0);
  EXPECT_EQ(atan(std::numeric_limits<double>::infinity()), std::atan(1.0) * 2);
}

TEST(LaneMath, EightSideBySideGiveWhatEachGivesAlone) {
  RandomStream random(7, 2);
  for (int i = 0; i < 1000; ++i) {
    double x[8];
    for (double& v : x) v = uniform(random, -9.0, 9.0);
    const Lanes all_eight = lanes(x);
    const Lanes a = atan(all_eight), s = sin(all_eight), e = exp(all_eight), r = log(e);
    for (int k = 0; k < 8; ++k) {
      EXPECT_EQ(a[k], atan(x[k]));
      EXPECT_EQ(s[k], sin(x[k]));
      EXPECT_EQ(e[k], exp(x[k]));
      EXPECT_NEAR(r[k], x[k], 20 * kUnit);
    }
  }
}

// Side by side or one after the other, a chain is made of the functions of the standard library.
TEST(LaneMath, ChainsAreTheirFunctions) {
  const double x[3] = {-2.5, 0.3, 40.0}, C[3] = {1.3, 0.9, 1.6}, E[3] = {-3.0, 0.4, 0.99};
  double sine[3], cosine[3];
  magic_all(x, C, E, sine, cosine);
  const double factor[2] = {1.5, -0.8};
  double arc[3], turned_sine[3], turned_cosine[3];
  sin_cos_of_atan_all(x, factor, 0.2, arc, turned_sine, turned_cosine);
  for (int i = 0; i < 3; ++i) {
    const double angle = C[i] * std::atan(x[i] - E[i] * (x[i] - std::atan(x[i])));
    EXPECT_NEAR(sine[i], std::sin(angle), 1e-14);
    EXPECT_NEAR(cosine[i], std::cos(angle), 1e-14);
    EXPECT_NEAR(arc[i], std::atan(x[i]), 1e-15);
    const double turn = i < 2 ? factor[i] * std::atan(x[i]) : 0.2;
    EXPECT_NEAR(turned_sine[i], std::sin(turn), 1e-15);
    EXPECT_NEAR(turned_cosine[i], std::cos(turn), 1e-15);
  }
  const double base[2] = {0.3, 2.0}, power[2] = {0.85, -0.4}, exponent[1] = {0.7};
  double raised[2], exps[1];
  powers_and_exps(base, power, exponent, raised, exps);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(raised[i], std::pow(base[i], power[i]), 1e-15);
  EXPECT_NEAR(exps[0], std::exp(0.7), 1e-15);
}

}  // namespace
}  // namespace latsch::lane_math
