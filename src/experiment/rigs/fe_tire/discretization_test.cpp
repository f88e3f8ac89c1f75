// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/discretization.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch {
namespace {

const DiscretizationRow* find(const std::vector<DiscretizationRow>& rows, const std::string& name) {
  for (const DiscretizationRow& row : rows) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

// Returns the values of v(h) = v0 + c h^2 at h = 1, 1/2 and 1/3.
std::vector<double> of_second_order(double v0, double c) {
  return {v0 + c, v0 + c / 4, v0 + c / 9};
}

TEST(Discretization, QuantitiesAreExtrapolatedByTheirNames) {
  const std::vector<double> Fz = of_second_order(4000.0, 180.0);
  const std::vector<double> f = of_second_order(100.0, -3.6);
  const auto rows = discretization_rows({1, 2, 3},
                                        {{{"Fz at 25 mm", Fz[0]}, {"radial n=2", f[0]}},
                                         {{"radial n=2", f[1]}, {"Fz at 25 mm", Fz[1]}},
                                         {{"Fz at 25 mm", Fz[2]}, {"radial n=2", f[2]}}});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].unit, "N");
  EXPECT_EQ(rows[1].unit, "Hz");
  EXPECT_NEAR(rows[0].converged, 4000.0, 1e-3);
  EXPECT_NEAR(rows[0].error(), 180.0 / 4000.0, 1e-6);
  EXPECT_NEAR(rows[1].converged, 100.0, 1e-3);
  EXPECT_NEAR(rows[1].order, 2.0, 1e-3);
}

TEST(Discretization, AModeOfAnotherWaveNumberIsPairedByItsFrequency) {
  // The mode at 90 Hz is called n = 3 on the coarse mesh and n = 4 on the others.
  const auto rows = discretization_rows({1, 2, 3},
                                        {{{"radial n=2", 60.0}, {"radial n=3", 90.0}},
                                         {{"radial n=2", 59.5}, {"radial n=4", 89.0}},
                                         {{"radial n=2", 59.4}, {"radial n=4", 88.8}}});
  const DiscretizationRow* row = find(rows, "radial n=3");
  ASSERT_TRUE(row);
  EXPECT_EQ(row->values, (std::vector{90.0, 89.0, 88.8}));
}

TEST(Discretization, ANamesakeGoesBeforeANearerFrequency) {
  const auto rows = discretization_rows({1, 2, 3},
                                        {{{"radial n=3", 90.0}},
                                         {{"lateral n=1", 90.1}, {"radial n=3", 87.0}},
                                         {{"lateral n=1", 90.1}, {"radial n=3", 86.5}}});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].values, (std::vector{90.0, 87.0, 86.5}));
}

TEST(Discretization, AModeThatHasANameIsNotTakenForAnother) {
  // The mode at 90.5 Hz is the n = 2 of the first mesh, so n = 3 is reported as lost and not paired
  // with it.
  const auto rows = discretization_rows({1, 2, 3},
                                        {{{"radial n=2", 92.0}, {"radial n=3", 90.0}},
                                         {{"radial n=2", 90.5}, {"radial n=4", 95.0}},
                                         {{"radial n=2", 90.2}, {"radial n=4", 95.0}}});
  EXPECT_TRUE(find(rows, "radial n=2"));
  const DiscretizationRow* lost = find(rows, "radial n=3");
  ASSERT_TRUE(lost);
  EXPECT_FALSE(lost->paired);
}

TEST(Discretization, PairsByFrequencyAreWithinTwoAndAHalfPercentAndTheNearest) {
  const auto second = [](double near, double nearer) {
    return MeshQuantities{{"lateral n=5", near}, {"lateral n=6", nearer}};
  };
  const auto paired = discretization_rows(
      {1, 2, 3}, {{{"radial n=3", 100.0}}, second(102.0, 99.0), second(98.2, 101.0)});
  ASSERT_EQ(paired.size(), 1u);
  EXPECT_EQ(paired[0].values, (std::vector{100.0, 99.0, 101.0}));
  const auto far = discretization_rows(
      {1, 2, 3}, {{{"radial n=3", 100.0}}, second(102.6, 97.4), second(101.0, 101.0)});
  ASSERT_EQ(far.size(), 1u);
  EXPECT_FALSE(far[0].paired);
}

// v(h) = v0 + c h^2 + d h^4 at h = 1/2, 1/3, 1/4: the extrapolation misses the limit by the effect
// of the third term.
TEST(Discretization, TheUncertaintyCoversWhatTheExtrapolationMisses) {
  MeshQuantities meshes[3];
  for (int r : {2, 3, 4}) {
    const double h = 1.0 / r;
    meshes[r - 2] = {{"growth", 1.0 + 0.2 * h * h + 0.2 * h * h * h * h}};
  }
  const auto rows = discretization_rows({2, 3, 4}, {meshes[0], meshes[1], meshes[2]});
  EXPECT_TRUE(rows[0].asymptotic());
  EXPECT_GT(rows[0].uncertainty, 0.0);
  EXPECT_LT(std::abs(rows[0].converged - 1.0), rows[0].uncertainty);
}

// Growth of a tire with crossed steel belts in two rows, on meshes refined 1, 2, 4 and, as its
// limit, 16 times through the wall (regression values of this program): the changes grow.
TEST(Discretization, WhereChangesGrowNothingIsAsymptoticAndTheLimitIsWithinTheUncertainty) {
  const auto rows = discretization_rows(
      {1, 2, 4}, {{{"growth", 1.1954e-3}}, {{"growth", 1.2143e-3}}, {{"growth", 1.2572e-3}}});
  EXPECT_FALSE(rows[0].asymptotic());
  EXPECT_LT(std::abs(rows[0].converged - 1.3308e-3), rows[0].uncertainty);
}

}  // namespace
}  // namespace latsch
