// SPDX-License-Identifier: Apache-2.0
// Compares a ring under harmonic forces with an independent program, and in modes and static
// displacements with all of its own equations.
#include "harmonic_ring.h"

#include <gtest/gtest.h>

namespace latsch::verification {
namespace {

TEST(HarmonicRing, ModesAndStaticDisplacementsGiveTheListedResponse) {
  const HarmonicErrors errors = harmonic_errors(harmonic_response(true));
  EXPECT_LT(errors.drive, 1e-3);
  EXPECT_LT(errors.top, 1e-3);
}

// The 200 modes of the list lack 1.5 % at the drive and a fifth of the small answer at the top.
TEST(HarmonicRing, ModesAloneLackWhatHigherOnesAddNearTheForce) {
  const HarmonicErrors errors = harmonic_errors(harmonic_response(false));
  EXPECT_GT(errors.drive, 0.01);
}

// The force on the rim follows from momentum, and by all unknowns it is the reaction of the rim's
// nodes.
TEST(HarmonicRing, ForcesOnTheRimAreTheReactionOfItsNodes) { EXPECT_LT(reaction_error(), 1e-3); }

}  // namespace
}  // namespace latsch::verification
