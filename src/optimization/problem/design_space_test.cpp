// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/design_space.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimization/design/full_factorial.h"

namespace latsch {
namespace {

DesignVariable linear(std::string name, double lower, double upper, double initial) {
  return {.name = std::move(name), .lower = lower, .upper = upper, .initial = initial};
}

DesignVariable logarithmic(std::string name, double lower, double upper, double initial) {
  DesignVariable v = linear(std::move(name), lower, upper, initial);
  v.scale = Scale::logarithmic;
  return v;
}

std::string complaint(std::vector<DesignVariable> variables) {
  try {
    DesignSpace space(std::move(variables));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(DesignSpace, MapsLinearAndLogarithmicScalesToTheUnitCube) {
  const DesignSpace space({linear("angle", -1.0, 3.0, 0.0), logarithmic("E", 1e6, 1e8, 1e7)});
  const std::vector<double> u = space.to_unit(space.initial());
  EXPECT_DOUBLE_EQ(u[0], 0.25);
  EXPECT_DOUBLE_EQ(u[1], 0.5);  // the value is the geometric mean of its bounds
  const DesignPoint back = space.from_unit(u);
  EXPECT_DOUBLE_EQ(back.values[0], 0.0);
  EXPECT_NEAR(back.values[1], 1e7, 1e-8);  // tolerance for one rounding of pow, 1e-15 relative
}

TEST(DesignSpace, FacesOfTheCubeGiveTheBitsOfTheBounds) {
  const DesignSpace space({logarithmic("E", 0.1, 0.7, 0.3), linear("x", 0.1, 0.7, 0.3)});
  EXPECT_EQ(space.from_unit({0.0, 0.0}).values, (std::vector<double>{0.1, 0.1}));
  EXPECT_EQ(space.from_unit({1.0, 1.0}).values, (std::vector<double>{0.7, 0.7}));
  EXPECT_EQ(space.from_unit({-3.0, 2.0}).values, (std::vector<double>{0.1, 0.7}));
}

TEST(DesignSpace, RejectsWhatCannotBeSearched) {
  EXPECT_NE(complaint({linear("E", 2.0, 1.0, 1.5)}).find("lower bound 2 is not below"),
            std::string::npos);
  EXPECT_NE(complaint({linear("E", 1.0, 2.0, 3.0)}).find("initial value 3 is outside"),
            std::string::npos);
  EXPECT_NE(complaint({logarithmic("E", 0.0, 2.0, 1.0)}).find("logarithmic"), std::string::npos);
  EXPECT_NE(complaint({linear("E", 0.0, INFINITY, 1.0)}).find("not finite"), std::string::npos);
  EXPECT_NE(complaint({linear("E", 0.0, 1.0, NAN)}).find("outside"), std::string::npos);
  EXPECT_NE(complaint({linear("E", 0.0, 1.0, 0.5), linear("E", 0.0, 1.0, 0.5)}).find("twice"),
            std::string::npos);
  EXPECT_NE(complaint({}).find("no design variable"), std::string::npos);
}

TEST(DesignSpace, ComplaintsNameThePlaceInTheStudy) {
  DesignVariable v = linear("E", 2.0, 1.0, 1.5);
  v.place = {"study.toml", 12};
  EXPECT_EQ(complaint({v}).find("study.toml:12:"), 0u);
}

TEST(DesignSpace, ComplaintsNameBoundsInTheUnitTheyWereWrittenIn) {
  DesignVariable v = linear("k", 10e3, 60e3, 70e3);
  v.unit = "N/mm";
  EXPECT_NE(complaint({v}).find("initial value 70 N/mm is outside its bounds 10 N/mm to 60 N/mm"),
            std::string::npos)
      << complaint({v});
}

TEST(DesignSpace, TightenedBoundsStayInsideTheOldOnesAndHoldThePoint) {
  const DesignSpace space({linear("a", 0.0, 10.0, 5.0), logarithmic("E", 1.0, 1e4, 10.0)});
  const DesignPoint best{{9.9, 100.0}};
  const DesignSpace narrow = space.tightened(best, 0.2);
  EXPECT_DOUBLE_EQ(narrow[0].lower, 8.0);
  EXPECT_DOUBLE_EQ(narrow[0].upper, 10.0);
  EXPECT_NEAR(narrow[1].lower, std::pow(10.0, 1.6), 1e-12);
  EXPECT_NEAR(narrow[1].upper, std::pow(10.0, 2.4), 1e-12);
  EXPECT_EQ(narrow.initial(), best);
}

TEST(DesignPoint, BitsTellNeighboringNumbersApart) {
  EXPECT_EQ(DesignPoint{{1.0}}.bits(), DesignPoint{{1.0}}.bits());
  EXPECT_NE(DesignPoint{{1.0}}.bits(), DesignPoint{{std::nextafter(1.0, 2.0)}}.bits());
}

TEST(FullFactorial, HasEveryCombinationOfTheLevels) {
  const DesignSpace space({linear("a", 0.0, 2.0, 1.0), logarithmic("E", 1.0, 100.0, 10.0)});
  const SamplingPlan plan = full_factorial(space, {3, 2});
  ASSERT_EQ(plan.points.size(), 6u);
  EXPECT_EQ(plan.points[0], (DesignPoint{{0.0, 1.0}}));
  EXPECT_EQ(plan.points[1], (DesignPoint{{0.0, 100.0}}));
  EXPECT_EQ(plan.points[5], (DesignPoint{{2.0, 100.0}}));
}

TEST(FullFactorial, LevelsAreGeometricOnALogarithmicScale) {
  const DesignSpace space({logarithmic("E", 1.0, 16.0, 2.0)});
  const SamplingPlan plan = full_factorial(space, {5});
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(plan.points[i].values[0], std::pow(2.0, i), 1e-14);
}

TEST(FullFactorial, OneLevelIsTheInitialValue) {
  const DesignSpace space({linear("a", 0.0, 2.0, 0.3), linear("b", 0.0, 1.0, 0.0)});
  const SamplingPlan plan = full_factorial(space, {1, 2});
  ASSERT_EQ(plan.points.size(), 2u);
  EXPECT_EQ(plan.points[1], (DesignPoint{{0.3, 1.0}}));
}

TEST(FullFactorial, RejectsPlansThatMakeNoSense) {
  const DesignSpace space({linear("a", 0.0, 2.0, 0.3), linear("b", 0.0, 1.0, 0.0)});
  EXPECT_THROW(full_factorial(space, {3}), InputError);
  EXPECT_THROW(full_factorial(space, {3, 0}), InputError);
  EXPECT_THROW(full_factorial(space, {2000, 2000}), InputError);
}

TEST(DesignSpace, RefusesBoundsWhoseDistanceOverflows) {
  EXPECT_THROW(DesignSpace({{.name = "x", .lower = -1e308, .upper = 1e308, .initial = 0.0}}),
               InputError);
  EXPECT_THROW(DesignSpace({{.name = "x",
                             .lower = 1e-300,
                             .upper = 1e300,
                             .initial = 1.0,
                             .scale = Scale::logarithmic}}),
               InputError);
}

TEST(DesignSpace, SaysWhereForeignPointsLie) {
  const DesignSpace space(
      {{.name = "x", .lower = 0.0, .upper = 2.0, .initial = 1.0},
       {.name = "y", .lower = 1.0, .upper = 100.0, .initial = 10.0, .scale = Scale::logarithmic}});
  const auto outside = space.place({{3.0, 10.0}});
  ASSERT_TRUE(outside);
  EXPECT_DOUBLE_EQ((*outside)[0], 1.5);
  EXPECT_DOUBLE_EQ((*outside)[1], 0.5);
  EXPECT_FALSE(space.place({{std::nan(""), 10.0}}));
  EXPECT_FALSE(space.place({{1.0, 0.0}}));
  EXPECT_FALSE(space.place({{1.0, -3.0}}));
  EXPECT_THROW(space.place({{1.0}}), InputError);
}

/// Returns a score whose residuals r and derivatives dr/dx are given in closed form.
Score with_jacobian(const std::vector<double>& x) {
  return {.residuals = {x[0] * x[1], std::sin(x[0]), x[1] * x[1]},
          .jacobian = {x[1], x[0], std::cos(x[0]), 0.0, 0.0, 2.0 * x[1]}};
}

// Central differences of h = 1e-5 of the range have an error of h^2 / 6 times the third derivative,
// which for E^2 is (2 ln 160)^2 times the first: 2e-9 of the first. Rounding adds 1e-11.
TEST(DesignSpace, BringsAJacobianIntoTheUnitCube) {
  const DesignSpace space({linear("a", -1.0, 3.0, 0.5), logarithmic("E", 0.5, 80.0, 7.0)});
  const DesignPoint point = space.initial();
  const Eigen::MatrixXd J = space.unit_jacobian(point, with_jacobian(point.values));
  ASSERT_EQ(J.rows(), 3);
  ASSERT_EQ(J.cols(), 2);
  constexpr double kStep = 1e-5;
  for (int j = 0; j < 2; ++j) {
    std::vector<double> up = space.to_unit(point), down = up;
    up[j] += kStep;
    down[j] -= kStep;
    const Score a = with_jacobian(space.from_unit(up).values);
    const Score b = with_jacobian(space.from_unit(down).values);
    for (int i = 0; i < 3; ++i) {
      const double difference = (a.residuals[i] - b.residuals[i]) / (2.0 * kStep);
      EXPECT_NEAR(J(i, j), difference, 3e-9 * std::max(1.0, std::abs(J(i, j)))) << i << ' ' << j;
    }
  }
}

TEST(DesignSpace, HasNoUnitJacobianOfAScoreWithoutOrWithABrokenOne) {
  const DesignSpace space({linear("a", -1.0, 3.0, 0.5), linear("b", 0.0, 1.0, 0.5)});
  Score score = with_jacobian(space.initial().values);
  score.jacobian[3] = std::nan("");
  EXPECT_EQ(space.unit_jacobian(space.initial(), score).size(), 0);
  score.jacobian.pop_back();
  EXPECT_EQ(space.unit_jacobian(space.initial(), score).size(), 0);
  score.jacobian.clear();
  EXPECT_EQ(space.unit_jacobian(space.initial(), score).size(), 0);
}

}  // namespace
}  // namespace latsch
