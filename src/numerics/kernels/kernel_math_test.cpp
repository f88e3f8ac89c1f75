// SPDX-License-Identifier: Apache-2.0
// Tests every function in every kernel set of the processor: against the C library in long double,
// for the same bits at every width, and for the same bits in all sets with a fused multiply-add.
#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <limits>
#include <vector>

#include "base/random.h"

namespace latsch::kernel_math_testing {

enum class Which {
  atan,
  atan_of_quotient,
  sin,
  cos,
  exp,
  log,
  cbrt,
  power,
  power_zero,
  sign,
  sign_or_one,
  fused,
  fused_both,
  rounded,
  clamped,
  chosen,
};

}  // namespace latsch::kernel_math_testing

#define LATSCH_KERNELS_IN "numerics/kernels/kernel_math_testing.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::kernel_math_testing {
namespace {

using Exact = long double (*)(long double);

/// A function, its test range, its reference, and the allowed error in units of the last place of
/// max(|f|, scale).
struct Claim {
  Which which;
  double lower, upper;
  Exact exact;
  double units, scale;
};

constexpr double kTiny = std::numeric_limits<double>::min();

const Claim kClaims[] = {
    {Which::atan, -4.0, 4.0, [](long double x) { return std::atan(x); }, 1.5, kTiny},
    {Which::atan, -1e6, 1e6, [](long double x) { return std::atan(x); }, 1.5, kTiny},
    {Which::atan_of_quotient,
     -20.0,
     20.0,
     [](long double x) { return std::atan(x / 3.0L); },
     1.5,
     kTiny},
    {Which::sin, -1.0, 1.0, [](long double x) { return std::sin(x); }, 1.5, kTiny},
    {Which::sin, -30.0, 30.0, [](long double x) { return std::sin(x); }, 1.5, 1.0},
    {Which::sin, -1e5, 1e5, [](long double x) { return std::sin(x); }, 1.5, 1.0},
    {Which::cos, -30.0, 30.0, [](long double x) { return std::cos(x); }, 1.5, 1.0},
    {Which::cos, -1e5, 1e5, [](long double x) { return std::cos(x); }, 1.5, 1.0},
    {Which::exp, -50.0, 50.0, [](long double x) { return std::exp(x); }, 2.0, kTiny},
    {Which::log, 1e-3, 5.0, [](long double x) { return std::log(x); }, 3.0, 0.1},
    {Which::log, 1.0, 1e9, [](long double x) { return std::log(x); }, 2.0, kTiny},
    {Which::cbrt, 1e-3, 8.0, [](long double x) { return std::cbrt(x); }, 1.5, kTiny},
    {Which::power, 0.0, 5.0, [](long double x) { return std::pow(x, 0.85L); }, 16.0, kTiny},
};

std::vector<double> numbers(double lower, double upper, int n = 40000) {
  RandomStream random(7, 1);
  std::vector<double> x(static_cast<std::size_t>(n));
  for (double& v : x) v = lower + (upper - lower) * random.uniform();
  return x;
}

std::vector<double> values(Which which, const std::vector<double>& x, int width = 8) {
  std::vector<double> y(x.size());
  LATSCH_KERNEL(evaluate)(which, width, static_cast<int>(x.size()), x.data(), y.data());
  return y;
}

double value(Which which, double x) { return values(which, std::vector<double>(8, x))[5]; }

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

class OfKernelSet : public testing::TestWithParam<KernelSet> {
 protected:
  WithKernelSet with_{GetParam()};
};

TEST_P(OfKernelSet, WithinTheLastUnitsOfTheCLibrary) {
  for (const Claim& claim : kClaims) {
    const std::vector<double> x = numbers(claim.lower, claim.upper), y = values(claim.which, x);
    double worst = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const long double exact = claim.exact(x[i]);
      const long double unit = std::numeric_limits<double>::epsilon() *
                               std::max<long double>(std::abs(exact), claim.scale);
      worst = std::max(worst, static_cast<double>(std::abs(y[i] - exact) / unit));
    }
    EXPECT_LT(worst, claim.units) << static_cast<int>(claim.which) << " up to " << claim.upper;
  }
}

TEST_P(OfKernelSet, EveryWidthGivesTheSameBits) {
  const std::vector<double> x = numbers(-9.0, 9.0, 4000), positive = numbers(1e-3, 9.0, 4000);
  for (int i = 0; i <= static_cast<int>(Which::chosen); ++i) {
    const Which which = static_cast<Which>(i);
    const auto& of = which == Which::log || which == Which::cbrt ? positive : x;
    EXPECT_TRUE(same_bits(values(which, of, 8), values(which, of, 4))) << i;
    EXPECT_TRUE(same_bits(values(which, of, 8), values(which, of, 1))) << i;
  }
}

TEST_P(OfKernelSet, ZerosAndSigns) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(value(Which::atan, 0.0), 0.0);
  EXPECT_TRUE(std::signbit(value(Which::atan, -0.0)));
  EXPECT_EQ(value(Which::atan, infinity), std::atan(1.0) * 2);
  EXPECT_EQ(value(Which::sin, 0.0), 0.0);
  EXPECT_EQ(value(Which::cos, 0.0), 1.0);
  EXPECT_EQ(value(Which::exp, 0.0), 1.0);
  EXPECT_GT(value(Which::exp, -infinity), 0.0);
  EXPECT_EQ(value(Which::log, 1.0), 0.0);
  EXPECT_EQ(value(Which::cbrt, 1.0), 1.0);
  EXPECT_EQ(value(Which::power, 0.0), 0.0);
  EXPECT_EQ(value(Which::power_zero, 0.0), 1.0);
  EXPECT_EQ(value(Which::sign, -0.0), 0.0);
  EXPECT_EQ(value(Which::sign, -3.0), -1.0);
  EXPECT_EQ(value(Which::sign_or_one, -0.0), 1.0);
  EXPECT_EQ(value(Which::sign_or_one, -1e-300), -1.0);
}

TEST_P(OfKernelSet, AProductAddedOnTheSpotIsRoundedOnce) {
  const bool fused = GetParam() != KernelSet::baseline;
  for (const double x : numbers(-2.0, 2.0, 800)) {
    const double square = x * x, tenth = x * 0.1;
    EXPECT_EQ(value(Which::fused, x), fused ? std::fma(x, x, -2.0) : square - 2.0);
    EXPECT_EQ(value(Which::fused_both, x), fused ? std::fma(x, 0.1, square) : tenth + square);
    EXPECT_EQ(value(Which::rounded, x), square - 2.0);
  }
}

TEST_P(OfKernelSet, LimitsAndChoices) {
  for (const double x : numbers(-5.0, 5.0, 800)) {
    EXPECT_EQ(value(Which::clamped, x), std::min(std::max(x, -1.0), 2.0));
    EXPECT_EQ(value(Which::chosen, x), x > 0.5 || x <= -3.0 ? 2.0 * x : -x);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(value(Which::clamped, nan), -1.0);  // Comparisons with NaN are false.
  EXPECT_TRUE(std::isnan(value(Which::chosen, nan)));
}

TEST_P(OfKernelSet, SumsInOneOrder) {
  RandomStream random(7, 3);
  for (int i = 0; i < 200; ++i) {
    double v[8];
    for (double& x : v) x = random.uniform() - 0.5;
    EXPECT_EQ(LATSCH_KERNEL(added)(v),
              ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])));
  }
}

TEST_P(OfKernelSet, AnyAndEvery) {
  for (int k = 0; k < 8; ++k) {
    double x[8] = {}, y[8];
    x[k] = 1.0;
    EXPECT_TRUE(LATSCH_KERNEL(any_above)(x, 0.5));
    EXPECT_FALSE(LATSCH_KERNEL(any_above)(x, 1.0));
    EXPECT_FALSE(LATSCH_KERNEL(every_above)(x, 0.0));
    EXPECT_TRUE(LATSCH_KERNEL(every_above)(x, -1.0));
    LATSCH_KERNEL(joined_halves)(x, y);
    for (int i = 0; i < 8; ++i) EXPECT_EQ(y[i], x[(i + 4) % 8]);
  }
}

INSTANTIATE_TEST_SUITE_P(KernelMath,
                         OfKernelSet,
                         testing::ValuesIn(kernel_sets()),
                         [](const auto& info) { return std::string(name(info.param)); });

TEST(KernelMath, EverySetWithAFusedMultiplyAddGivesTheSameBits) {
  if (kernel_sets().size() < 3) GTEST_SKIP() << "this processor has no AVX-512";
  const std::vector<double> x = numbers(-9.0, 9.0), positive = numbers(1e-3, 9.0);
  for (int i = 0; i <= static_cast<int>(Which::chosen); ++i) {
    const Which which = static_cast<Which>(i);
    const auto& of = which == Which::log || which == Which::cbrt ? positive : x;
    const auto by = [&](KernelSet set) {
      const WithKernelSet with(set);
      return values(which, of);
    };
    EXPECT_TRUE(same_bits(by(KernelSet::avx2), by(KernelSet::avx512))) << i;
  }
}

}  // namespace
}  // namespace latsch::kernel_math_testing
