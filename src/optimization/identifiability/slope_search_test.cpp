// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/slope_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch {
namespace {

using Model = std::function<std::optional<Eigen::VectorXd>(double)>;

struct Found {
  SlopeSearch search;
  int evaluations = 0;
};

Found slope(const Model& model, double felt, double below = -0.5, double above = 0.5) {
  Found found{SlopeSearch([=](double offset) { return below <= offset && offset <= above; }, 0.01)};
  while (!found.search.wanted().empty()) {
    std::vector<std::optional<Eigen::VectorXd>> r;
    for (const double offset : found.search.wanted()) r.push_back(model(offset));
    found.evaluations += static_cast<int>(r.size());
    found.search.observe(*model(0.0), felt, r);
  }
  return found;
}

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

TEST(SlopeSearch, OfAParabolaIsItsDerivativeAlsoAtABound) {
  const Model parabola = [](double x) { return one(3 * x + 5 * x * x); };
  EXPECT_NEAR(slope(parabola, 0.0).search.slope()[0], 3.0, 1e-10);
  EXPECT_EQ(slope(parabola, 0.0).evaluations, 2);
  EXPECT_NEAR(slope(parabola, 0.0, 0.0).search.slope()[0], 3.0, 1e-10);
  EXPECT_NEAR(slope(parabola, 0.0, -0.5, 0.0).search.slope()[0], 3.0, 1e-10);
}

// The model is a line of slope 1 with a ripple of amplitude 0.02 and wavelength 0.013. A difference
// over 0.01 gives the slope of the ripple. An interval that ends where the residuals change by 0.2
// is 20 times as long.
TEST(SlopeSearch, GrowsBeyondRippleToTheLengthOfTheInterval) {
  const Model rippled = [](double x) {
    return one(x + 0.02 * std::sin(2 * M_PI * x / 0.013 + 0.4));
  };
  const double short_step = ((*rippled(0.01))[0] - (*rippled(0.0))[0]) / 0.01;
  EXPECT_GT(std::abs(short_step - 1.0), 1.0);
  const Found found = slope(rippled, 0.2);
  EXPECT_NEAR(found.search.slope()[0], 1.0, 0.25);
  EXPECT_EQ(found.search.quality(), SlopeQuality::straight);
}

// The model has a ripple, and the data are exact: the length grows because of the ripple alone.
TEST(SlopeSearch, GrowsOutOfRippleThatNoNoiseHides) {
  Eigen::VectorXd waves = Eigen::VectorXd::LinSpaced(40, 0.011, 0.017);
  const Model rippled = [=](double x) -> std::optional<Eigen::VectorXd> {
    const Eigen::ArrayXd phase = 2 * M_PI * x / waves.array() + 9.0 * waves.array() / 0.011;
    return Eigen::VectorXd(x + 0.02 * phase.sin());
  };
  const Found found = slope(rippled, 1e-3);
  EXPECT_NEAR(found.search.slope().mean(), 1.0, 0.1);
  EXPECT_GT(found.search.length(), 0.03);
}

// The model sinh(200 x) is strongly curved within the first length of 0.01; its slope at 0 is 200.
TEST(SlopeSearch, ShrinksWhereTheModelIsCurved) {
  const Model curved = [](double x) { return one(std::exp(400 * x)); };
  const Found found = slope(curved, 1e-3);
  EXPECT_EQ(found.search.quality(), SlopeQuality::straight);
  EXPECT_NEAR(found.search.slope()[0], 400.0, 30.0);
}

TEST(SlopeSearch, GoesToTheSideThatDoesNotFail) {
  const Found found = slope(
      [](double x) -> std::optional<Eigen::VectorXd> {
        if (x > 0.0) return std::nullopt;
        return one(2 * x);
      },
      0.0);
  EXPECT_EQ(found.search.quality(), SlopeQuality::straight);
  EXPECT_NEAR(found.search.slope()[0], 2.0, 1e-12);
}

TEST(SlopeSearch, SaysWhereNoStepIsGood) {
  const Model jagged = [](double x) { return one(std::sin(1e5 * x) + std::sin(3.7e4 * x + 1)); };
  EXPECT_EQ(slope(jagged, 0.0).search.quality(), SlopeQuality::rough);
  const Model island = [](double x) -> std::optional<Eigen::VectorXd> {
    if (x != 0.0) return std::nullopt;
    return one(0.0);
  };
  EXPECT_EQ(slope(island, 0.0).search.quality(), SlopeQuality::unknown);
}

}  // namespace
}  // namespace latsch
