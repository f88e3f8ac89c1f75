// SPDX-License-Identifier: Apache-2.0
#include "optimization/design/basins.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimization/design/full_factorial.h"
#include "optimization/design/sobol.h"

namespace latsch {
namespace {

/// The function of Fig. 1 of Hempel and Oertel, KGK 04/2016: a local minimum at (-0.15, 0.79), the
/// global one at (-0.15, -1.15), and a saddle between them.
double two_basins(const std::vector<double>& x) {
  const double a = 0.79, b = -1.15, y = x[1];  // df/dy = (y - a) (y - b) y
  return (x[0] + 0.15) * (x[0] + 0.15) + y * y * y * y / 4 - (a + b) * y * y * y / 3 +
         a * b * y * y / 2;
}

double one_basin(const std::vector<double>& x) {
  return (x[0] - 0.3) * (x[0] - 0.3) + 2 * (x[1] + 0.4) * (x[1] + 0.4) + x[0] * x[1];
}

const DesignSpace kSpace({{.name = "x", .lower = -2, .upper = 2, .initial = 0},
                          {.name = "y", .lower = -2, .upper = 2, .initial = 0}});

template <class Function>
std::vector<double> values_at(const std::vector<DesignPoint>& points, const Function& f) {
  std::vector<double> values;
  for (const DesignPoint& point : points) values.push_back(f(point.values));
  return values;
}

TEST(Basins, OfThePapersFigureOne6x6ShowsOneMinimumAndWarns) {
  const auto values = values_at(full_factorial(kSpace, {6, 6}).points, two_basins);
  EXPECT_EQ(find_basins(values, grid_neighbors({6, 6})).size(), 1u);
  EXPECT_NE(grid_doubt(values, {6, 6}), "");
}

TEST(Basins, OfThePapersFigureOne17x17ShowsTwoAndDoesNotWarn) {
  const auto points = full_factorial(kSpace, {17, 17}).points;
  const auto values = values_at(points, two_basins);
  const auto basins = find_basins(values, grid_neighbors({17, 17}));
  ASSERT_EQ(basins.size(), 2u);
  // The lowest points are within half the grid spacing of 0.25 of the minima; the global minimum
  // comes first.
  EXPECT_NEAR(points[basins[0].lowest].values[1], -1.15, 0.125);
  EXPECT_NEAR(points[basins[1].lowest].values[1], 0.79, 0.125);
  EXPECT_EQ(basins[0].points + basins[1].points, 17 * 17);
  EXPECT_EQ(grid_doubt(values, {17, 17}), "");
}

// A parabola has no fourth difference, so five levels suffice for it.
TEST(Basins, AGridThatIsFineEnoughDoesNotWarn) {
  const auto values = values_at(full_factorial(kSpace, {5, 5}).points, one_basin);
  EXPECT_EQ(find_basins(values, grid_neighbors({5, 5})).size(), 1u);
  EXPECT_EQ(grid_doubt(values, {5, 5}), "");
}

TEST(Basins, FourLevelsDoNotTell) {
  const auto values = values_at(full_factorial(kSpace, {4, 6}).points, one_basin);
  EXPECT_NE(grid_doubt(values, {4, 6}), "");
}

TEST(Basins, FailedPointsAreHolesThatHaveNoBasin) {
  auto values = values_at(full_factorial(kSpace, {5, 5}).points, one_basin);
  values[0] = NAN;
  const auto basins = find_basins(values, grid_neighbors({5, 5}));
  ASSERT_EQ(basins.size(), 1u);
  EXPECT_EQ(basins[0].points, 24);
}

// In a grid of 2^16 points in 16 variables only the 16 neighbors along the axes count; 3^16
// diagonal neighbors would take too long.
TEST(Basins, OfManyVariablesNeighborsLieOnTheAxes) {
  const std::vector<int> levels(16, 2);
  const Neighbors neighbors = grid_neighbors(levels);
  EXPECT_EQ(neighbors.size(), 65536u);
  EXPECT_EQ(neighbors[12345].size(), 16u);
  // The point in the middle of a grid in which one variable is not varied.
  EXPECT_EQ(grid_neighbors({3, 1, 3})[4].size(), 8u);
}

struct Scattered {
  std::vector<DesignPoint> points;
  std::vector<Eigen::VectorXd> u;
};

Scattered scattered(int count) {
  Scattered s{sobol(kSpace, count).points, {}};
  for (const DesignPoint& point : s.points) {
    const auto u = kSpace.to_unit(point);
    s.u.push_back(Eigen::Map<const Eigen::VectorXd>(u.data(), 2));
  }
  return s;
}

TEST(Basins, ScatteredPointsShowBothAsWell) {
  const Scattered s = scattered(256);
  const auto values = values_at(s.points, two_basins);
  const auto basins = find_basins(values, nearest_neighbors(s.u, 8));
  ASSERT_GE(basins.size(), 2u);
  EXPECT_NEAR(s.points[basins[0].lowest].values[1], -1.15, 0.25);
  EXPECT_NEAR(s.points[basins[1].lowest].values[1], 0.79, 0.25);
  EXPECT_EQ(scatter_doubt(values, s.u), "");
}

TEST(Basins, AFewScatteredPointsOfAWavyFunctionAreTooThin) {
  const Scattered s = scattered(32);
  const auto wavy = [](const std::vector<double>& x) {
    return std::sin(9 * x[0]) * std::sin(9 * x[1]);
  };
  EXPECT_NE(scatter_doubt(values_at(s.points, wavy), s.u), "");
}

}  // namespace
}  // namespace latsch
