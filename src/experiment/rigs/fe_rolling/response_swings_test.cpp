// SPDX-License-Identifier: Apache-2.0
// Swings over which the response of tire B with few columns holds.
#include "experiment/rigs/fe_rolling/response_swings.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "models/fe_tire/description/reference_tires.h"

namespace latsch::experiment {
namespace {

/// Tire B with 13 columns, of which two points at the rear of the shoulders slide at 4 kN.
class SwingingTire {
 public:
  SwingingTire() : tire_(description()), rig_(tire_, 2.6e5) {}
  std::vector<std::string> remarks(double friction,
                                   const std::vector<std::string>& names = {"alpha"}) {
    RollingResponseTest test{.frequencies = {0.4}};
    test.states.friction = friction;
    test.states.rows = {{.load = 4000.0, .speed = 5.0}};
    for (const ResponseSlip& slip : response_slips())
      for (const std::string& name : names)
        if (name == slip.name) test.slips.push_back(slip);
    std::vector<std::string> found;
    const auto channels = rolling_response(rig_, test, &found);
    EXPECT_TRUE(channels) << channels.failure().reason;
    return found;
  }

 private:
  static fe_tire::TireDescription description() {
    fe_tire::TireDescription tire = fe_tire::reference_tire_b();
    tire.element = fe_tire::ElementKind::solid_shell;
    tire.section.meridional = 13;
    return tire;
  }
  fe_tire::FeTire tire_;
  TireRig rig_;
};

TEST(ResponseSwings, AreNotToldWhereSteadyStatesHaveTheSlope) {
  for (const std::string& words : SwingingTire().remarks(1.0, {"alpha", "kappa", "phit"}))
    ADD_FAILURE() << words;
}

// The mesh is coarse: over 0.2 deg of camber points come down and lift off.
TEST(ResponseSwings, AreToldOfEachSlip) {
  const std::vector<std::string> found = SwingingTire().remarks(1.0, {"alpha", "gamma"});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("state 1, Fy by camber: "), std::string::npos) << found[0];
}

TEST(ResponseSwings, AreToldWhereFewSlidingPointsRuleTheSlope) {
  const std::vector<std::string> found = SwingingTire().remarks(5.0);
  ASSERT_EQ(found.size(), 1u);
  for (const char* part : {"state 1, Fy by slip angle: -7.27e+04 N/rad at 0 Hz",
                           "0.1 deg to both sides",
                           "2 of 87 points slide",
                           "friction 5",
                           "up to 0.0063 deg both agree within 5 %",
                           "slip_history"})
    EXPECT_NE(found[0].find(part), std::string::npos) << part << " in " << found[0];
}

}  // namespace
}  // namespace latsch::experiment
