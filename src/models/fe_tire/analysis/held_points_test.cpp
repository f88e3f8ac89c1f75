// SPDX-License-Identifier: Apache-2.0
// Tests contact with prescribed touching points (Ground::held), which define the branch of
// equilibria of a state. tire_slopes_test shows that the derivatives of a state are those of this
// branch.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {
namespace {

constexpr double kPressed = 0.02;  // m

/// Returns a small tire whose rubbers are stiffer by the given share. It is solved to nearly all
/// digits.
FeTire coarse_and_exact(double stiffer) {
  TireDescription tire = reference_tire_b();
  tire.section.meridional = 13;
  tire.section.sectors = 24;
  for (Rubber& rubber : tire.rubbers) rubber.law.C10 *= 1.0 + stiffer;
  SolverSettings settings;
  settings.tolerance = 1e-11;
  settings.mode_tolerance = 1e-9;
  return {build_mesh(tire), build_materials(tire), settings};
}

TireState pressed(FeTire& tire, const Ground& ground) {
  const auto inflated = tire.inflate(2.6e5);
  EXPECT_TRUE(inflated);
  const auto states = tire.press(*inflated, ground, {0.5 * kPressed, kPressed});
  EXPECT_TRUE(states) << states.failure().reason;
  return states->back();
}

double force(FeTire& tire, const Ground& ground) {
  return tire.stand(pressed(tire, ground)).force.z();
}

// The touching points of a state are prescribed on another path, which starts where the tire does
// not touch yet. It must lead to the same state. If a slightly stiffer tire touches in the same
// points, its prescribed points must lead to its own state, too.
TEST(HeldPoints, OfAStateAreThatState) {
  TouchingPoints touching;
  for (const double stiffer : {0.0, 0.01}) {
    FeTire tire = coarse_and_exact(stiffer);
    const TireState state = pressed(tire, {});
    if (stiffer == 0.0) touching = tire.touching(state);
    EXPECT_EQ(tire.touching(state), touching);
    EXPECT_GT(touching.points.size(), 10U);
    const TireState held = pressed(tire, {.held = touching});
    EXPECT_EQ(tire.touching(held), touching);
    EXPECT_LT((held.u - state.u).norm(), 1e-9 * state.u.norm());
    const double Fz = tire.stand(state).force.z();
    EXPECT_NEAR(tire.stand(held).force.z(), Fz, 1e-10 * Fz);
    const auto modes = tire.modes(state, 8), of_held = tire.modes(held, 8);
    ASSERT_TRUE(modes && of_held);
    for (std::size_t k = 0; k < modes->size(); ++k)
      EXPECT_NEAR((*of_held)[k].frequency, (*modes)[k].frequency, 1e-9 * (*modes)[k].frequency);
  }
}

// Second differences of a smooth force are of second order in the step. A kink, caused by points
// that leave the ground, would make them larger.
TEST(HeldPoints, GoOnSmoothlyWhereOthersWouldTouch) {
  constexpr double kMiddle = -0.40, kStep = 0.05;
  FeTire tire = coarse_and_exact(0.0);
  const TouchingPoints touching = tire.touching(pressed(tire, {}));
  std::array<double, 5> held, free;
  bool left = false;
  for (int k = 0; k < 5; ++k) {
    FeTire softer = coarse_and_exact(kMiddle + (k - 2) * kStep);
    held[k] = force(softer, {.held = touching});
    const TireState state = pressed(softer, {});
    free[k] = softer.stand(state).force.z();
    left = left || softer.touching(state).points.size() < touching.points.size();
  }
  const auto ratio = [](const std::array<double, 5>& f) {
    return (f[0] - 2.0 * f[2] + f[4]) / (f[1] - 2.0 * f[2] + f[3]);
  };
  EXPECT_TRUE(left);
  EXPECT_NEAR(ratio(held), 4.0, 0.1);
  EXPECT_GT(std::abs(ratio(free) - 4.0), 1.0);
}

TEST(HeldPoints, AreRefusedWhereThereIsMoreThanFlatGround) {
  FeTire tire = coarse_and_exact(0.0);
  const auto inflated = tire.inflate(2.6e5);
  ASSERT_TRUE(inflated);
  const TouchingPoints some{1, {0}};
  for (const Ground& ground :
       {Ground{.mu = 0.5, .held = some}, Ground{.bar = Bar{.height = 1e-3}, .held = some}}) {
    const auto states = tire.press(*inflated, ground, {0.005});
    ASSERT_FALSE(states);
    EXPECT_NE(states.failure().reason.find("points are held"), std::string::npos);
  }
  const auto of_another = tire.press(*inflated, {.held = TouchingPoints{0, {1 << 20}}}, {0.005});
  ASSERT_FALSE(of_another);
  EXPECT_NE(of_another.failure().reason.find("not those of this tire"), std::string::npos);
}

}  // namespace
}  // namespace latsch::fe_tire
