// SPDX-License-Identifier: Apache-2.0
// A disc ring with one Prony term that turns below a standing force, against an independent
// program.
#include "turning_disc.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace latsch::verification {
namespace {

/// The limit of values that fall with the second power of the sectors' width.
double limit(double coarse, double fine) { return fine + (fine - coarse) / 3.0; }

// The independent program follows stress at two points a sector, Latsch at one, so on the same
// sectors they differ by the second order of the width. The limits are the same.
TEST(TurningDisc, HasTheDisplacementAndTheMomentOfTheList) {
  for (std::size_t first : {0u, 3u}) {
    const ListedDisc &coarse = listed_discs()[first + 1], &fine = listed_discs()[first + 2];
    const TurnedDisc own = turned_disc(coarse.sectors, coarse.tau),
                     finer = turned_disc(fine.sectors, fine.tau);
    const double displacement = limit(coarse.displacement, fine.displacement),
                 moment = limit(coarse.moment, fine.moment);
    EXPECT_NEAR(limit(own.displacement, finer.displacement), displacement, 0.002 * displacement);
    EXPECT_NEAR(limit(own.moment, finer.moment), moment, 0.01 * moment);
    EXPECT_NEAR(finer.moment, finer.by_losses, 0.002 * finer.moment);
    EXPECT_NEAR(finer.displacement, fine.displacement, 0.002 * fine.displacement);
  }
}

}  // namespace
}  // namespace latsch::verification
