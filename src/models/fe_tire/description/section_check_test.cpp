// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/section_check.h"

#include <gtest/gtest.h>

#include "models/fe_tire/description/reference_tires.h"

namespace latsch::fe_tire {
namespace {

TEST(SectionCheck, TheReferenceTiresAreInOrder) {
  for (const TireDescription& tire : {reference_tire_a(), reference_tire_b()}) {
    EXPECT_EQ(wall_conflict(tire.section), "");
    for (const CordPly& ply : tire.plies) EXPECT_EQ(ply_conflict(tire.section, ply), "");
  }
}

TEST(SectionCheck, AContourThatCrossesItselfIsNamedWithThePlace) {
  Section section = reference_tire_b().section;
  std::swap(section.contour[4], section.contour[6]);
  EXPECT_NE(wall_conflict(section).find("crosses itself at y = "), std::string::npos);
}

TEST(SectionCheck, AWallThickerThanItIsCurvedFolds) {
  Section section = reference_tire_b().section;
  section.inside = {{0.0, 1.0}, {60e-3, 60e-3}};
  EXPECT_NE(wall_conflict(section), "");
}

TEST(SectionCheck, ALayerOutsideTheWallIsNamedWithItsPosition) {
  const TireDescription tire = reference_tire_b();
  CordPly ply = tire.plies.front();
  // At the crown the wall is 6 mm thick inside, but at the side only 4 mm, so the ply leaves it.
  ply.offset = {{0.0}, {-5e-3}};
  EXPECT_NE(ply_conflict(tire.section, ply).find("position 0.4"), std::string::npos)
      << ply_conflict(tire.section, ply);
}

TEST(SectionCheck, OuterSizeIsTheReferenceLineAndTheWallOutsideIt) {
  const OuterSize size = outer_size(reference_tire_b().section);
  EXPECT_NEAR(size.radius, 0.310 + 0.009, 1e-12);
  EXPECT_NEAR(size.width, 2.0 * (0.112 + 0.0048), 1e-3);
}

}  // namespace
}  // namespace latsch::fe_tire
