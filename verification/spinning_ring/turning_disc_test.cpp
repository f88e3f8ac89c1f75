// SPDX-License-Identifier: Apache-2.0
// A disc ring with one Prony term that turns below a standing force, against an independent
// program.
#include "turning_disc.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace latsch::verification {
namespace {

TEST(TurningDisc, HasTheDisplacementAndTheMomentOfTheList) {
  for (const ListedDisc& listed : listed_discs()) {
    const TurnedDisc disc = turned_disc(listed.sectors, listed.tau);
    std::printf("%d %g: %.4f um %.3f uNm losses %.3f (listed %.4f %.3f) passes %d\n",listed.sectors,listed.tau,disc.displacement*1e6,disc.moment*1e6,disc.by_losses*1e6,listed.displacement*1e6,listed.moment*1e6,disc.passes);
    EXPECT_NEAR(disc.displacement, listed.displacement, 0.002 * listed.displacement);
    EXPECT_NEAR(disc.moment, listed.moment, 0.01 * listed.moment);
  }
}

}  // namespace
}  // namespace latsch::verification
