// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/posterior_words.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace latsch {
namespace {

constexpr Eigen::Index kWordDraws = 2000;

/// Returns draws of two independent normal variables of mean 0 and deviation 1, a variable a row.
Eigen::MatrixXd normal_draws() {
  Eigen::MatrixXd x(2, kWordDraws);
  RandomStream random(3, 0);
  for (double& value : x.reshaped()) value = random.normal();
  return x;
}

const std::vector<std::string> kWordNames{"a", "b"};
/// Returns the interval of a normal variable with this mean and deviation.
Interval normal_interval(double mean, double deviation) {
  return {mean - 1.96 * deviation, mean + 1.96 * deviation};
}

std::vector<std::string> words_of(const Eigen::MatrixXd& u, const std::vector<Interval>& linear) {
  std::vector<std::string> words;
  for (const PosteriorShape& shape : posterior_shapes(u, linear))
    words.push_back(in_words(shape, kWordNames));
  return words;
}

TEST(PosteriorWords, ANormalPosteriorIsAsTheLinearInterval) {
  const Eigen::MatrixXd u = (0.5 + 0.05 * normal_draws().array()).matrix();
  const auto words = words_of(u, {normal_interval(0.5, 0.05), normal_interval(0.5, 0.07)});
  EXPECT_EQ(words[0], "as the linear interval");
  EXPECT_EQ(words[1], "unlike the linear interval");
}

// The half widths of exp(0.5 x) have the ratio (e^0.98 - 1) / (1 - e^-0.98) = 2.66.
TEST(PosteriorWords, ALogNormalPosteriorIsSkewed) {
  Eigen::MatrixXd u = (0.5 + 0.05 * normal_draws().array()).matrix();
  u.row(1) = 0.1 * (0.5 * normal_draws().row(1).array()).exp();
  const auto words = words_of(u, {normal_interval(0.5, 0.05), normal_interval(0.1, 0.05)});
  EXPECT_EQ(words[1], "skewed");
}

// b = x^2 + e with var x^2 = 2 and var e = 1: the quadratic explains two thirds.
TEST(PosteriorWords, AQuadraticInAnotherVariableIsABanana) {
  const Eigen::MatrixXd x = normal_draws();
  EXPECT_NEAR(bent_share(x.row(0).transpose(),
                         (x.row(0).array().square() + x.row(1).array()).matrix().transpose()),
              2.0 / 3.0,
              0.05);
  EXPECT_NEAR(bent_share(x.row(0).transpose(), x.row(1).transpose()), 0.0, 0.01);
  Eigen::MatrixXd u = (0.5 + 0.05 * x.array()).matrix();
  u.row(1).array() += 0.05 * x.row(0).array().square() - 0.05;
  const auto words = words_of(u, {normal_interval(0.5, 0.05), normal_interval(0.5, 0.05)});
  EXPECT_EQ(words[0], "as the linear interval");
  EXPECT_NE(words[1].find("banana with a"), std::string::npos) << words[1];
}

TEST(PosteriorWords, TwoHeapsAreTwoModesAndOneFlatHeapIsNot) {
  Eigen::MatrixXd u = (0.5 + 0.02 * normal_draws().array()).matrix();
  RandomStream random(4, 0);
  for (Eigen::Index k = 0; k < kWordDraws; ++k) {
    if (k % 5 == 0) u(0, k) += 0.16;
    u(1, k) = 0.4 + 0.2 * random.uniform();
  }
  const auto shapes = posterior_shapes(u, {normal_interval(0.5, 0.02), normal_interval(0.5, 0.02)});
  EXPECT_TRUE(shapes[0].two_modes);
  EXPECT_FALSE(shapes[1].two_modes);
}

TEST(PosteriorWords, TellBoundsAndOpenVariables) {
  Eigen::MatrixXd u(2, kWordDraws);
  RandomStream random(5, 0);
  for (Eigen::Index k = 0; k < kWordDraws; ++k) {
    u(0, k) = std::abs(0.05 * random.normal());
    u(1, k) = random.uniform();  // deviation 0.289
  }
  const auto shapes = posterior_shapes(u, {{-1.0, 0.1}, {-1.0, 2.0}});
  EXPECT_TRUE(shapes[0].cut);
  EXPECT_FALSE(shapes[0].open);
  EXPECT_TRUE(shapes[1].open);
  EXPECT_FALSE(shapes[1].cut);  // 1 % lies at each bound
}

}  // namespace
}  // namespace latsch
