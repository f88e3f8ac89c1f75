// SPDX-License-Identifier: Apache-2.0
#include "correlation/doe/doe_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "correlation/doe/doe_basins.h"
#include "optimization/design/full_factorial.h"

namespace latsch::correlation {
namespace {

/// A study of three variables with invented trials.
Study doe_study() {
  DesignVariable a{"a", {"a"}, 0.0, 4.0, 1.0};
  DesignVariable b{"b", {"b"}, 1.0, 100.0, 10.0, Scale::logarithmic};
  DesignVariable c{"c", {"c"}, -1.0, 1.0, 0.0};
  return {"study.toml",
          "made up",
          "tire.toml",
          Document::parse("a = 1", "tire.toml"),
          DesignSpace({a, b, c}),
          {},
          {},
          100,
          {},
          {}};
}

/// Returns the target, which is least at a = 2, b = 10, c = 1.
double target_at(const DesignPoint& p) {
  return std::abs(p.values[0] - 2.0) + std::abs(std::log10(p.values[1]) - 1.0) + 1.0 - p.values[2];
}

std::vector<RatedTrial> grid(const Study& study, const std::vector<int>& levels) {
  std::vector<RatedTrial> trials;
  for (const DesignPoint& point : full_factorial(study.space, levels).points) {
    trials.push_back({point, target_at(point)});
  }
  return trials;
}

const DesignPoint kFound{{2.1, 11.0, 0.9}};

TEST(DoeSurfaces, OneForEveryPairThroughTheBestPointOfTheGrid) {
  const Study s = doe_study();
  const auto surfaces = doe_surfaces(s, grid(s, {3, 3, 3}), kFound);
  ASSERT_EQ(surfaces.size(), 3u);
  const report::Surface& ab = surfaces[0];
  EXPECT_EQ(ab.x, (std::vector<double>{0.0, 2.0, 4.0}));
  EXPECT_NEAR(ab.y[1], 10.0, 1e-12);  // geometric mean of a logarithmic variable
  EXPECT_EQ(ab.held, "c = 1");
  EXPECT_NEAR(ab.target(1, 1), 0.0, 1e-12);
  EXPECT_NEAR(ab.target(2, 1), 2.0, 1e-12);
  EXPECT_EQ(*ab.found, Eigen::Vector2d(2.1, 11.0));
}

TEST(DoeSurfaces, AFailedTrialIsAHole) {
  const Study s = doe_study();
  auto trials = grid(s, {3, 3, 3});
  std::erase_if(trials, [](const RatedTrial& t) {
    return t.point.values == std::vector<double>{0.0, 1.0, 1.0};
  });
  const auto surfaces = doe_surfaces(s, trials, kFound);
  ASSERT_EQ(surfaces.size(), 3u);
  EXPECT_TRUE(std::isnan(surfaces[0].target(0, 0)));
}

TEST(DoeSurfaces, AVariableThatWasNotVariedHasNone) {
  Study s = doe_study();
  s.doe = StudyDesign{.levels = {5, 4, 1}};
  const auto surfaces = doe_surfaces(s, grid(s, s.doe->levels), kFound);
  ASSERT_EQ(surfaces.size(), 1u);
  EXPECT_EQ(surfaces[0].x.size(), 5u);
  EXPECT_EQ(surfaces[0].y.size(), 4u);
}

TEST(DoeSurfaces, NoneWithoutAGrid) {
  const Study s = doe_study();
  auto trials = grid(s, {3, 3, 3});
  trials.resize(14);  // half of the grid
  EXPECT_TRUE(doe_surfaces(s, trials, kFound).empty());
}

TEST(DoeBasins, AreThoseOfTheGridThatWasEvaluated) {
  Study s = doe_study();
  const auto trials = grid(s, {5, 5, 5});
  const auto design = evaluated_design(s, trials);
  ASSERT_TRUE(design);
  EXPECT_EQ(design->levels, (std::vector<int>{5, 5, 5}));
  const auto found = doe_basins(s, *design, trials);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->basins.size(), 1u);
  EXPECT_EQ(found->basins[0].lowest.values[0], 2.0);
  EXPECT_EQ(found->basins[0].points, 125);
  EXPECT_EQ(found->design, "full factorial grid, 5 x 5 x 5");
}

TEST(DoeBasins, AreThoseOfAScatteredDesignWhereTheStudyHasOne) {
  Study s = doe_study();
  s.doe = StudyDesign{.kind = DesignKind::sobol, .points = 64};
  std::vector<RatedTrial> trials;
  for (const DesignPoint& point : plan(*s.doe, s.space).points) {
    trials.push_back({point, target_at(point)});
  }
  EXPECT_EQ(evaluated_design(s, trials)->kind, DesignKind::sobol);
  const auto found = doe_basins(s, *s.doe, trials);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->basins[0].lowest.values[0], 2.0, 0.6);
}

}  // namespace
}  // namespace latsch::correlation
