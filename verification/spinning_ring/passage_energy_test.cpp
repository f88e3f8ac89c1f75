// SPDX-License-Identifier: Apache-2.0
#include "passage_energy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/fe_tire/description/reference_tires.h"

namespace latsch::verification {
namespace {

fe_tire::TireDescription elastic_tire() {
  fe_tire::TireDescription tire = fe_tire::reference_tire_b();
  tire.element = fe_tire::ElementKind::solid_shell;
  tire.section.meridional = 13;
  return tire;
}

// The vibration that a low cleat leaves keeps its energy, and the default of rho takes from it.
TEST(PassageEnergy, IsKeptWithoutDampingAndFallsWithIt) {
  const EnergyPassage passage{.height = 2e-3};
  const PassageEnergy kept = energy_after_cleat(elastic_tire(), passage);
  EXPECT_GT(kept.H.front(), 0.5);
  EXPECT_LT(std::abs(drift(kept)), 2e-3);
  EnergyPassage damped = passage;
  damped.rho = 0.7;
  EXPECT_LT(drift(energy_after_cleat(elastic_tire(), damped)), -0.02);
}

}  // namespace
}  // namespace latsch::verification
