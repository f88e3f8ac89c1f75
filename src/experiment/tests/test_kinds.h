// SPDX-License-Identifier: Apache-2.0
// The kinds of tests that the program knows, each defined in the file of its name.
#pragma once

#include "experiment/language/test.h"

namespace latsch::experiment {

extern const TestKind kDrumCleatTest, kSlipSweepTest, kRollingStiffnessTest, kUniformityTest,
    kStaticStiffnessTest, kFootprintTest, kModesTest, kSteadyStatesTest, kSlipHistoryTest,
    kLoadDeflectionTest, kKcTest, kKinematicsTest, kFourPostTest, kKerbTest, kAxleKcTest,
    kMassPropertiesTest, kInflationTest, kRollingTest, kRollingFootprintTest, kRollingChainTest,
    kResponseTest, kRollingResponseTest;

}  // namespace latsch::experiment
