// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/sobol.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

namespace latsch {
namespace {

constexpr const char* kPython = "/usr/bin/python3";

DesignSpace cube(int n) {
  std::vector<DesignVariable> variables;
  for (int i = 0; i < n; ++i) variables.push_back({.name = fmt::format("x{}", i)});
  return DesignSpace(variables);
}

// SciPy's scipy.stats.qmc.Sobol has these direction numbers and this order of points. All
// coordinates are multiples of 2^-32, so they agree to the last bit.
TEST(Sobol, AgreesWithSciPyInAllVariables) {
  const std::string ask = fmt::format("{} -c 'import scipy.stats.qmc' 2>/dev/null", kPython);
  if (std::system(ask.c_str()) != 0)
    GTEST_SKIP() << "SciPy is not installed (Debian: python3-scipy)";
  const auto file = std::filesystem::temp_directory_path() / fmt::format("sobol_{}", getpid());
  const std::string script = fmt::format(
      "{} -c \"import numpy as np; from scipy.stats import qmc; "
      "np.savetxt('{}', qmc.Sobol({}, scramble=False, bits=32).random(256), fmt='%.17g')\"",
      kPython,
      file.string(),
      kMostSobolVariables);
  ASSERT_EQ(std::system(script.c_str()), 0);
  std::ifstream in(file);
  for (const DesignPoint& point : sobol(cube(kMostSobolVariables), 256).points) {
    for (double ours : point.values) {
      double theirs = -1.0;
      in >> theirs;
      ASSERT_EQ(ours, theirs);
    }
  }
  std::filesystem::remove(file);
}

// The first points agree with Joe and Kuo's notes on their sequence, dimensions 1 to 3.
TEST(Sobol, BeginsAsPublished) {
  const auto points = sobol(cube(3), 5).points;
  EXPECT_EQ(points[0].values, (std::vector{0.0, 0.0, 0.0}));
  EXPECT_EQ(points[1].values, (std::vector{0.5, 0.5, 0.5}));
  EXPECT_EQ(points[2].values, (std::vector{0.75, 0.25, 0.25}));
  EXPECT_EQ(points[3].values, (std::vector{0.25, 0.75, 0.75}));
  EXPECT_EQ(points[4].values, (std::vector{0.375, 0.375, 0.625}));
}

// The defining property of the sequence: if the range of a variable is divided into 2^k equal
// shares, each share holds one of the first 2^k points. A digital shift preserves this property.
TEST(Sobol, HoldsEveryShareOfEveryVariableOnceAlsoShifted) {
  for (std::uint64_t seed : {0, 3}) {
    const auto points = sobol(cube(kMostSobolVariables), 64, seed).points;
    for (int v = 0; v < kMostSobolVariables; ++v) {
      std::set<int> shares;
      for (const DesignPoint& point : points) shares.insert(static_cast<int>(64 * point.values[v]));
      EXPECT_EQ(shares.size(), 64u);
    }
  }
}

TEST(Sobol, EnlargedKeepsItsPoints) {
  const auto few = sobol(cube(4), 10, 1).points, many = sobol(cube(4), 20, 1).points;
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
}

TEST(Sobol, RejectsMoreVariablesThanItsTableHas) {
  EXPECT_THROW((void)sobol(cube(kMostSobolVariables + 1), 8), InputError);
}

}  // namespace
}  // namespace latsch
