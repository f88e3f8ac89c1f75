// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/loaded_limits.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch {
namespace {

DiscretizationRow limit(const std::string& name, double value, double uncertainty = 0.0) {
  DiscretizationRow row;
  row.name = name;
  row.unit = "Hz";
  row.converged = value;
  row.uncertainty = uncertainty;
  return row;
}

DiscretizationRow values(const std::string& name, std::vector<double> on_meshes) {
  DiscretizationRow row;
  row.name = name;
  row.unit = name.starts_with("Fz") ? "N" : "Hz";
  row.values = std::move(on_meshes);
  return row;
}

/// Values on the mesh, with halved sectors, with everything halved: sectors have the error `around`
/// and second order, the section has the error `coarse` and, halved, `fine`, as shares of the
/// limit.
std::vector<double> few(double limit, double around, double coarse, double fine) {
  return {limit * (1.0 + around + coarse),
          limit * (1.0 + around / 4.0 + coarse),
          limit * (1.0 + around / 4.0 + fine)};
}

DiscretizationRow extrapolated(const Missed& missed, DiscretizationRow row) {
  missed.extrapolate(row);
  return row;
}

TEST(LoadedLimits, SectorsErrByThemselvesAndTheSectionAsItDoesUnloaded) {
  // Much of the section's error remains when it is halved; sectors are wider at the top.
  const Missed missed({limit("radial n=2", 100.0)},
                      {values("radial n=2", few(100.0, 0.001, -0.010, -0.006))},
                      few_meshes());
  const auto row = extrapolated(missed, values("radial n=2 a", few(90.0, 0.004, -0.010, -0.006)));
  EXPECT_NEAR(row.converged, 90.0, 90.0 * 1e-4);
  EXPECT_LT(std::abs(row.converged - 90.0), row.uncertainty);
}

// Rows of a smeared section behave like this: halved, their error has the opposite sign. An
// extrapolation by order would lead away from the limit.
TEST(LoadedLimits, WhereHalvingGoesBeyondTheLimitItIsKnownFromTheUnloadedTire) {
  const Missed missed({limit("radial n=2", 100.0), limit("lateral n=1", 40.0)},
                      {values("radial n=2", few(100.0, 0.0, -0.006, 0.003)),
                       values("lateral n=1", few(40.0, 0.0, -0.004, 0.002))},
                      few_meshes());
  EXPECT_NEAR(extrapolated(missed, values("radial n=2 s", few(97.0, 0.0, -0.006, 0.003))).converged,
              97.0,
              1e-3);
  const auto Fz = extrapolated(missed, values("Fz at 10 mm", few(2500.0, 0.0, -0.012, 0.006)));
  EXPECT_NEAR(Fz.converged, 2500.0, 1e-2 * 2500.0 * 0.012);
  EXPECT_EQ(Fz.order, 0.0);
}

TEST(LoadedLimits, TheUncertaintyIsThatOfTheUnloadedLimitAndOfWhatTheGroundChanges) {
  const Missed missed({limit("radial n=1", 60.0, 0.03)},
                      {values("radial n=1", few(60.0, 0.0, -0.006, -0.002))},
                      few_meshes());
  const auto alike = extrapolated(missed, values("radial n=1 s", few(64.0, 0.0, -0.006, -0.002)));
  EXPECT_NEAR(alike.uncertainty, 0.03 / 60.0 * 64.0, 1e-3);
  // The section's error is half as large again.
  const auto unlike = extrapolated(missed, values("radial n=1 a", few(60.0, 0.0, -0.009, -0.003)));
  EXPECT_GT(std::abs(unlike.converged - 60.0), 0.03);
  EXPECT_LT(std::abs(unlike.converged - 60.0), unlike.uncertainty);
}

TEST(LoadedLimits, WithoutUnloadedModesTheSecondOrderIsTakenAndTheFirstIsWithinTheUncertainty) {
  const Missed missed({}, {}, few_meshes());
  const auto row = extrapolated(missed, values("n", {104.0, 104.0, 101.0}));
  EXPECT_NEAR(row.converged, 100.0, 1e-9);
  EXPECT_FALSE(row.asymptotic());
  EXPECT_GE(row.uncertainty, 2.0);  // an order of 1 would give 98
}

// Sectors and columns have second order; rows, halved once, keep the error that they keep in the
// unloaded tire.
TEST(LoadedLimits, ThoroughlySectorsAndColumnsAreExtrapolatedAndRowsAsTheyAreUnloaded) {
  const auto on_meshes = [](double v, double c, double coarse, double fine) {
    return std::vector{v * (1.0 + c + coarse),
                       v * (1.0 + c + coarse),  // only sectors refined: not used
                       v * (1.0 + c / 4.0 + coarse),
                       v * (1.0 + c / 16.0 + coarse),
                       v * (1.0 + c / 4.0 + fine)};
  };
  const Missed missed({limit("radial n=1", 60.0)},
                      {values("radial n=1", on_meshes(60.0, 0.002, 0.004, 0.003))},
                      thorough_meshes());
  const auto row =
      extrapolated(missed, values("radial n=1 s", on_meshes(64.0, 0.012, 0.004, 0.003)));
  EXPECT_NEAR(row.converged, 64.0, 64.0 * 1e-4);
}

}  // namespace
}  // namespace latsch
