// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/inflation.h"

#include <gtest/gtest.h>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::fe_tire {
namespace {

// With stiff walls and low pressure, rounding errors exceed a tolerance that is relative to the
// pressure. Inflation must succeed nevertheless, because a fit may try such tires.
TEST(Inflation, WallsOfEveryStiffnessAFitMayTryFindTheirEquilibrium) {
  Document document = Document::read(LATSCH_SOURCE_DIR "/studies/tires/race_16x7.5-10.toml");
  double last = 1.0;
  for (const double E : {2e6, 10e6, 40e6, 100e6, 1e9}) {
    document.set("rubber.sidewall.young_modulus", E);
    const TireDescription tire = read_tire(document.root());
    FeTire fe_tire(build_mesh(tire), build_materials(tire));
    const auto inflated = fe_tire.inflate(tire.pressure);
    ASSERT_TRUE(inflated) << E << ": " << inflated.failure().reason;
    EXPECT_GT(inflated->growth, 0.0);
    EXPECT_LT(inflated->growth, last);  // the stiffer the walls, the smaller the growth
    last = inflated->growth;
  }
}

}  // namespace
}  // namespace latsch::fe_tire
