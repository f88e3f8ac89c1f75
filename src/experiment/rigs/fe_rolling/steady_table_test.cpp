// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/steady_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "experiment/rigs/fe_rolling/rolling_slopes.h"
#include "experiment/rigs/fe_tire/rolling_rig.h"
#include "experiment/rigs/slip/slip_states.h"
#include "formats/tire/tir_file.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/magic_formula/magic_formula.h"

namespace latsch::experiment {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLoad = 3000.0;

fe_tire::TireDescription few_columns() {
  fe_tire::TireDescription tire = fe_tire::reference_tire_b();
  tire.element = fe_tire::ElementKind::solid_shell;
  tire.section.meridional = 13;
  return tire;
}

formats::CsvTable table_of(const std::string& text) {
  return formats::CsvTable::parse(text, "states.csv");
}

class SteadyTable : public testing::Test {
 protected:
  SteadyTable() : tire_(few_columns()), rig_(tire_, 2.6e5) {}

  Channels roll(const std::string& text, const SteadyConditions& conditions = {}) {
    const auto channels = roll_table(rig_, table_of(text), conditions);
    EXPECT_TRUE(channels) << channels.failure().reason;
    return channels ? *channels : Channels();
  }
  std::string refusal(const std::string& text, const SteadyConditions& conditions = {}) {
    try {
      (void)roll_table(rig_, table_of(text), conditions);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  bool remarks(const std::string& text,
               const std::string& words,
               SteadyConditions conditions = {}) {
    for (const std::string& one : remarks_on_table(rig_, table_of(text), conditions))
      if (one.find(words) != std::string::npos) return true;
    return false;
  }

  fe_tire::FeTire tire_;
  TireRig rig_;
};

// A Magic Formula and the finite elements agree in the direction of every force that a slip, a slip
// angle or a camber causes.
TEST_F(SteadyTable, ForcesHaveTheDirectionsOfAMagicFormula) {
  const std::string states =
      "Fz [N],kappa,alpha [deg],gamma [deg],Vx [km/h]\n"
      "3000,0,1,0,60\n3000,0,-1,0,60\n3000,0,0,2,60\n3000,0,0,-2,60\n"
      "3000,0.01,0,0,60\n3000,-0.01,0,0,60\n";
  auto parameters = formats::read_tir(std::string(LATSCH_SOURCE_DIR) +
                                      "/studies/tire_model_comparison/magic_formula.tir")
                        .parameters;
  parameters.PKY6 = -1.0;  // camber, of which the file has none: -1.001 in MFeval's sample of 6.1
  const Channels formula = answers(magic_formula::MagicFormula(parameters, {}),
                                   slip_states(table_of(states), parameters).states);
  const Channels elements = roll(states);
  const auto by = [](const Channels& of, const char* channel, int pair) {
    const auto at = static_cast<std::size_t>(2 * pair);
    return of[channel][at] - of[channel][at + 1];
  };
  struct Effect {
    const char* channel;
    int pair;      // 0: slip angle, 1: camber, 2: slip
    double least;  // N or N m, of a passenger tire under this load
  };
  for (const auto& [channel, pair, least] : {Effect{"Fy", 0, 500.0},
                                             Effect{"Mz", 0, 5.0},
                                             Effect{"Fy", 1, 20.0},
                                             Effect{"Fx", 2, 500.0}}) {
    const double expected = by(formula, channel, pair), found = by(elements, channel, pair);
    EXPECT_GT(std::abs(expected), 1e-3 * kLoad) << channel << pair;
    EXPECT_GT(std::abs(found), least) << channel << pair;
    EXPECT_GT(expected * found, 0.0) << channel << pair << " " << expected << " " << found;
  }
  EXPECT_NEAR(elements["omega"][0] * elements["R_e"][0], 60.0 / 3.6, 1e-9);
  EXPECT_NEAR(elements["omega"][5] * elements["R_e"][5], 0.99 * 60.0 / 3.6, 1e-9);
}

// The ground resists turning: to the left, with phit < 0, its moment is to the right.
TEST_F(SteadyTable, TurnSlipIsResisted) {
  const std::string states = "Fz [N],phit [1/m]\n3000,0.02\n3000,-0.02\n";
  SteadyConditions with_turn_slip;
  with_turn_slip.conventions.turn_slip = true;
  const Channels turning = roll(states, with_turn_slip);
  EXPECT_GT(turning["Mz"][0], 1.0);
  EXPECT_LT(turning["Mz"][1], -1.0);
  const Channels straight = roll(states);  // turn_slip = "off" leaves the column out
  EXPECT_EQ(straight["Mz"][0], straight["Mz"][1]);
}

TEST_F(SteadyTable, StatesAreThoseOfTheTestRolling) {
  // In SI with all digits, so that no conversion rounds.
  const Channels steady = roll(fmt::format("Fz [N],kappa,alpha [rad],gamma [rad],Vx [m/s],p [Pa]\n"
                                           "3000,0,{0},0,{1},260000\n3000,-0.01,0,{0},{1},260000\n"
                                           "2000,0,0,0,{2},220000\n",
                                           kDegree,
                                           60.0 / 3.6,
                                           80.0 / 3.6),
                               {.friction = 0.9});
  RollingTest test{.friction = 0.9, .rows = {}};
  test.rows = {{3000.0, 60.0 / 3.6, 0.0, kDegree, 0.0, 0.0, 2.6e5},
               {3000.0, 60.0 / 3.6, -0.01, 0.0, kDegree, 0.0, 2.6e5},
               {2000.0, 80.0 / 3.6, 0.0, 0.0, 0.0, 0.0, 2.2e5}};
  const auto rolled = experiment::roll(rig_, test);
  ASSERT_TRUE(rolled) << rolled.failure().reason;
  for (const char* name : {"Fx", "Fy", "Fz", "Mx", "My", "Mz", "R_l", "length", "width", "omega"})
    EXPECT_EQ(steady[name], (*rolled)[name]) << name;
}

// Slopes are differences of states, and tire B is its own mirror image, so that halves of a pair
// differ in sign alone.
TEST_F(SteadyTable, SlopesAreThoseOfItsStates) {
  const RollingStiffnessTest test{.speed = kAssumedSpeed, .load = kLoad};
  const auto slopes = rolling_slopes(rig_, test, {});
  ASSERT_TRUE(slopes) << slopes.failure().reason;
  const Channels states =
      roll(fmt::format("Fz [N],kappa,alpha [rad]\n3000,{},0\n3000,0,{}\n", test.slip, test.angle));
  const double free = roll("Fz [N]\n3000\n")["Fx"][0];
  EXPECT_NEAR(slopes->slip, (states["Fx"][0] - free) / test.slip, 0.02 * slopes->slip);
  EXPECT_NEAR(slopes->cornering, -states["Fy"][1] / test.angle, 1e-3 * slopes->cornering);
  EXPECT_NEAR(slopes->trail, -states["Mz"][1] / states["Fy"][1], 1e-3 * slopes->trail);
  // A brush with a parabolic pressure has a trail of a sixth of the patch, here some 0.1 m long.
  EXPECT_GT(slopes->trail, 0.01);
  EXPECT_LT(slopes->trail, 0.05);
  EXPECT_GT(slopes->camber, 0.0);
}

TEST_F(SteadyTable, TheOrderOfTheTableDoesNotMatter) {
  const Channels one = roll("Fz [N],alpha [deg]\n3000,0\n3000,1\n3000,3\n2000,2\n");
  const Channels other = roll("Fz [N],alpha [deg]\n2000,2\n3000,3\n3000,0\n3000,1\n");
  const std::size_t place[] = {2, 3, 1, 0};
  for (std::size_t k = 0; k < 4; ++k)
    for (const char* name : {"Fx", "Fy", "Fz"})
      EXPECT_NEAR(one[name][k], other[name][place[k]], 1e-5 * kLoad) << name << k;
}

// A missing slip is 0 against the free wheel, which at a slip angle is not the slip of a free wheel
// there.
TEST_F(SteadyTable, AMissingSlipIsZeroAndNotFree) {
  const std::string without = "Fz [N],alpha [deg]\n3000,3\n";
  const Channels missing = roll(without);
  EXPECT_EQ(missing["Fx"], roll("Fz [N],alpha [deg],kappa\n3000,3,0\n")["Fx"]);
  RollingTest free{.friction = kAssumedFriction, .rows = {{3000.0, kAssumedSpeed}}};
  free.rows[0].alpha = 3.0 * kDegree;
  const auto rolled = experiment::roll(rig_, free);
  ASSERT_TRUE(rolled) << rolled.failure().reason;
  EXPECT_GT(std::abs((*rolled)["kappa"][0]), 1e-4);
  EXPECT_GT(std::abs((*rolled)["Fx"][0] - missing["Fx"][0]), 1.0);
  EXPECT_TRUE(remarks(without, "kappa = 0"));
  EXPECT_TRUE(remarks(without, "Vx = 16.67 m/s"));
  EXPECT_TRUE(remarks(without, "p = 2.6 bar"));
}

TEST_F(SteadyTable, ATireOnTheOtherSideIsItsMirrorImage) {
  SteadyConditions other;
  other.conventions.mirrored = true;
  const Channels mirrored = roll("Fz [N],alpha [deg],gamma [deg]\n3000,1,2\n", other);
  const Channels as_described = roll("Fz [N],alpha [deg],gamma [deg]\n3000,-1,-2\n");
  for (const char* name : {"Fy", "Mx", "Mz"})
    EXPECT_EQ(mirrored[name][0], -as_described[name][0]) << name;
  for (const char* name : {"Fx", "Fz", "My"}) EXPECT_EQ(mirrored[name], as_described[name]) << name;
}

TEST_F(SteadyTable, FrictionIsThatOfTheTestElseOfTheTireElseAssumed) {
  const std::string sliding = "Fz [N],kappa\n3000,-1\n";  // a locked wheel has the force mu Fz
  EXPECT_TRUE(remarks(sliding, "friction 1 is taken"));
  EXPECT_NEAR(roll(sliding)["Fx"][0], -kAssumedFriction * kLoad, 1e-5 * kLoad);
  rig_.set_friction(fe_tire::RollingFriction{.at_rest = 0.6});
  EXPECT_TRUE(remarks(sliding, "friction 0.6 is that of the tire's file"));
  EXPECT_NEAR(roll(sliding)["Fx"][0], -0.6 * kLoad, 1e-5 * kLoad);
  EXPECT_NEAR(roll(sliding, {.friction = 0.8})["Fx"][0], -0.8 * kLoad, 1e-5 * kLoad);
  EXPECT_FALSE(remarks(sliding, "friction", {.friction = 0.8}));
  // A law over the pressure has less grip under more load.
  rig_.set_friction(fe_tire::RollingFriction{.at_rest = 0.9, .p_0 = 2e5, .a = 0.3});
  EXPECT_TRUE(remarks(sliding, "friction 0.9 at 2 bar, less by the power 0.3 of the pressure"));
  const Channels loads = roll("Fz [N],kappa\n2000,-1\n4000,-1\n");
  EXPECT_GT(-loads["Fx"][0] / 2000.0, -loads["Fx"][1] / 4000.0);
}

TEST_F(SteadyTable, SaysThatSectorsAreTooLongForAPatch) {
  const double sector = tire_.mesh().outer_radius() * 2.0 * std::numbers::pi / tire_.mesh().sectors;
  EXPECT_FALSE(remarks("Fz [N]\n9000\n", "sectors at the ground"));
  EXPECT_TRUE(remarks("Fz [N]\n9000\n3000\n",
                      fmt::format("sectors at the ground are {:.0f} mm long", 1e3 * sector)));
  EXPECT_TRUE(remarks("Fz [N],p [bar]\n9000,10\n", "hardly longer than"));
}

TEST_F(SteadyTable, SaysThatRubberWithoutLossesHasNoRollingResistance) {
  const std::string straight = "Fz [N]\n3000\n";
  EXPECT_TRUE(remarks(straight, "no rubber of the tire has Prony terms"));
  fe_tire::LossMaterials lossy;
  lossy.solids = {{.terms = {{0.2, 0.01}}}};
  rig_.set_losses(lossy);
  EXPECT_FALSE(remarks(straight, "Prony terms"));
}

TEST_F(SteadyTable, StatesAreToldInTheOrderOfTheTable) {
  const std::string states = "Fz [N],alpha [deg]\n3000,3\n3000,0\n3000,1\n";
  std::vector<double> Fy;
  std::size_t blocks = 0;
  const Status done = roll_table(rig_, table_of(states), {}, [&](const Channels& block) {
    ++blocks;
    Fy.insert(Fy.end(), block["Fy"].begin(), block["Fy"].end());
  });
  ASSERT_TRUE(done.ok()) << done.failure().reason;
  EXPECT_EQ(Fy, roll(states)["Fy"]);
  EXPECT_GE(blocks, 1u);
}

TEST_F(SteadyTable, AStateThatIsNotFoundIsAFailureWithItsNumber) {
  const auto crushed = roll_table(rig_, table_of("Fz [N]\n3000\n3e6\n"), {});
  ASSERT_FALSE(crushed);
  EXPECT_NE(crushed.failure().reason.find("state 2 of 2"), std::string::npos)
      << crushed.failure().reason;
}

TEST_F(SteadyTable, StatesThatNoSuchTireHasAreRefusedWithTheirLine) {
  const struct {
    const char *states, *says;
  } cases[] = {{"Fz [N]\n3000\n-5\n", "states.csv:3: Fz (N) is -5, expected a load above 0"},
               {"Fz [N],Vx [km/h]\n3000,-60\n", "states.csv:2: Vx (m/s)"},
               {"Fz [N],alpha [deg]\n3000,85\n", "states.csv:2: alpha (rad)"},
               {"Fz [N],gamma [deg]\n3000,40\n", "states.csv:2: gamma (rad)"},
               {"Fz [N],kappa\n3000,-1.2\n", "states.csv:2: kappa"},
               {"Fz [N],p [bar]\n3000,0\n", "states.csv:2: p (Pa)"},
               {"Fz [N]\n", "no row follows"},
               {"kappa\n0\n", "no column Fz"}};
  for (const auto& one : cases)
    EXPECT_NE(refusal(one.states).find(one.says), std::string::npos)
        << one.says << ": " << refusal(one.states);
  std::string long_table = "Fz [N]\n";
  for (int k = 0; k < 2001; ++k) long_table += "3000\n";
  EXPECT_NE(refusal(long_table).find("2001 states, expected at most 2000"), std::string::npos);
}

TEST_F(SteadyTable, ConditionsWithoutMeaningAreRefusedOrNamed) {
  const std::string straight = "Fz [N]\n3000\n", slipping = "Fz [N],alpha [deg]\n3000,1\n";
  SteadyConditions tangent;
  tangent.conventions.angles = magic_formula::Angles::tangent;
  EXPECT_NE(refusal(straight, tangent).find("expected angles = \"direct\""), std::string::npos);
  EXPECT_NE(
      refusal(slipping, {.friction = 0.0}).find("states.csv:2: the friction of the test is 0"),
      std::string::npos);
  const Channels smooth = roll(straight, {.friction = 0.0});
  EXPECT_NEAR(smooth["Fx"][0], 0.0, 1e-6 * kLoad);
  SteadyConditions without_limits;
  without_limits.conventions.limits = false;
  EXPECT_TRUE(remarks(straight, "limits = \"off\" has no effect", without_limits));
  EXPECT_TRUE(remarks("Fz [N],humidity [%]\n3000,5\n", "column \"humidity\" is not used"));
}

}  // namespace
}  // namespace latsch::experiment
