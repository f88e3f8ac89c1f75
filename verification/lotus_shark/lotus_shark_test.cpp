// SPDX-License-Identifier: Apache-2.0
#include "lotus_shark/lotus_shark.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "models/suspension/kinematic_outputs.h"

namespace latsch::verification {
namespace {

using namespace suspension;

TEST(LotusShark, StaticValuesAreThePrintedOnes) {
  const CornerGeometry corner = lotus_corner();
  ASSERT_EQ(corner.fault(), "");
  const auto wheel = KinematicCorner(corner, TravelOf::wheel_center).move_to(0.0, 0.0);
  ASSERT_TRUE(wheel) << wheel.failure().reason;
  const auto printed = lotus_printed_values();
  ASSERT_EQ(printed.size(), 8u);
  for (const PrintedValue& one : printed) {
    const auto outputs = kinematic_outputs();
    const auto output = std::find_if(outputs.begin(), outputs.end(), [&](const auto& candidate) {
      return candidate.name == one.output;
    });
    ASSERT_NE(output, outputs.end()) << one.output;
    EXPECT_NEAR((*wheel).*output->value, one.value, one.tolerance) << one.output;
  }
}

// The axis about which the rack turns a wheel whose spring is locked is the line through its ball
// joints, whatever the lengths of the links. Locking the damper on the upper wishbone fixes both
// wishbones.
TEST(LotusShark, TheAxisOfRotationByTheRackIsTheKingpin) {
  const CornerGeometry corner = lotus_corner();
  CornerGeometry five_links = corner;
  five_links.kingpin.reset();
  KinematicCorner known(corner, TravelOf::contact), found(five_links, TravelOf::contact);
  for (const double travel : {0.0, 0.03, -0.04}) {
    const auto a = known.move_to(travel, 0.01), b = found.move_to(travel, 0.01);
    ASSERT_TRUE(a) << a.failure().reason;
    ASSERT_TRUE(b) << b.failure().reason;
    EXPECT_NEAR(a->caster, b->caster, 1e-11);
    EXPECT_NEAR(a->kpi, b->kpi, 1e-11);
    EXPECT_NEAR(a->mechanical_trail, b->mechanical_trail, 1e-11);
    EXPECT_NEAR(a->scrub_radius, b->scrub_radius, 1e-11);
    EXPECT_NEAR(a->kingpin_offset, b->kingpin_offset, 1e-11);
  }
}

}  // namespace
}  // namespace latsch::verification
