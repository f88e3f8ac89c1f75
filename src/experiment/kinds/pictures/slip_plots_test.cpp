// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/pictures/slip_plots.h"

#include <gmock/gmock.h>

#include <fstream>

#include "base/scratch_folder_testing.h"
#include "experiment/kinds/sparse_tir_testing.h"
#include "experiment/kinds/tir_numbers.h"

namespace latsch::experiment {
namespace {

std::vector<std::string> plots_of(const std::string& coefficients) {
  const ScratchFolder folder;
  std::ofstream(folder / "tire.tir") << experiment::sparse_tir(coefficients);
  const auto parameters =
      experiment::parameters_of(experiment::read_tir_numbers(folder / "tire.tir"));
  std::vector<std::string> names;
  for (const auto& plot : slip_plots(magic_formula::MagicFormula(parameters))) {
    names.push_back(plot.description);
  }
  return names;
}

// A file of pure cornering has no Fx, so a plot from -1 N to 1 N would show nothing.
TEST(SlipPlots, ShowNoForceThatTheTireDoesNotHave) {
  using testing::Contains;
  using testing::HasSubstr;
  using testing::Not;
  const auto cornering = plots_of(experiment::kSideForce);
  EXPECT_THAT(cornering, Contains("Fy over alpha, by load"));
  EXPECT_THAT(cornering, Not(Contains(HasSubstr("Fx"))));
  const auto braking = plots_of(experiment::kLongitudinalForce);
  EXPECT_THAT(braking, Contains("Fx over kappa, by load"));
  EXPECT_THAT(braking, Not(Contains(HasSubstr("Fy over alpha"))));
}

// A force whose coefficients are neither fitted nor stated is marked as assumed, and slips beyond
// the data are shaded.
TEST(SlipPlots, TellAssumedFromKnownAndDataFromBeyond) {
  const ScratchFolder folder;
  std::ofstream(folder / "tire.tir") << experiment::sparse_tir(std::string(experiment::kSideForce) +
                                                               experiment::kLongitudinalForce);
  const magic_formula::MagicFormula tire(
      experiment::parameters_of(experiment::read_tir_numbers(folder / "tire.tir")));
  const double load = tire.parameters().FNOMIN;
  const SlipKnowledge knowledge{{"PDY1", "PDY2", "QSX1"}, [&](const std::string& condition) {
                                  if (condition == "Fz") return std::vector{0.9 * load, 2.0 * load};
                                  if (condition == "alpha") return std::vector{-0.1, 0.2};
                                  return std::vector<double>{};
                                }};
  int seen = 0;
  for (const auto& plot : slip_plots(tire, &knowledge)) {
    if (plot.description == "Fy over alpha, by load") {
      ++seen;
      ASSERT_TRUE(plot.data);
      EXPECT_NEAR(plot.data->first, -0.1 * 180.0 / 3.14159265358979, 1e-9);
      EXPECT_NEAR(plot.data->second, 0.2 * 180.0 / 3.14159265358979, 1e-9);
      EXPECT_FALSE(plot.lines[0].is_dashed);
      EXPECT_TRUE(plot.lines[0].name.ends_with(", outside")) << plot.lines[0].name;
      EXPECT_FALSE(plot.lines[1].name.ends_with(", outside")) << plot.lines[1].name;
    } else if (plot.description == "Fx over kappa, by load") {  // QSX1 belongs to Mx
      ++seen;
      ASSERT_TRUE(plot.data);
      // no slip was measured, so the whole plot is marked as outside of the data
      EXPECT_EQ(plot.data->first, plot.data->second);
      for (const auto& line : plot.lines) {
        EXPECT_TRUE(line.is_dashed);
        EXPECT_TRUE(line.name.ends_with(", assumed")) << line.name;
      }
    }
  }
  EXPECT_EQ(seen, 2);
  for (const auto& plot : slip_plots(tire)) EXPECT_FALSE(plot.data);
}

// If camber has no effect in the model, the plot must not show three coinciding lines, which would
// suggest that its effect is known.
TEST(SlipPlots, ShowNothingVariedThatChangesNothing) {
  using testing::Contains;
  using testing::HasSubstr;
  using testing::Not;
  const std::string side = experiment::kSideForce;
  EXPECT_THAT(plots_of(side), Not(Contains(HasSubstr("by camber"))));
  EXPECT_THAT(plots_of(side), Not(Contains(HasSubstr("by pressure"))));
  EXPECT_THAT(plots_of(side + "PDY3 = 5\n"), Contains("Fy over alpha, by camber"));
}

}  // namespace
}  // namespace latsch::experiment
