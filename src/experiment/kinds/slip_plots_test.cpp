// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/slip_plots.h"

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

// A file of cornering alone has no Fx, so an axis from -1 N to 1 N would show nothing.
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

// Three coinciding lines would wrongly suggest that the effect of camber is known.
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
