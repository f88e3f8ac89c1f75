// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/d_optimality.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch {
namespace {

// The data determine only the sum u0 + u1. A measurement of this sum adds little; one of the
// difference determines the direction that was unknown. With M = 12 I + a a' / s^2, all
// determinants are products.
TEST(DOptimality, RanksFirstWhatRepairsTheFlatDirection) {
  const double s = 0.01;
  const Eigen::MatrixXd J = Eigen::MatrixXd{{1, 1}} / s;
  const std::vector<Candidate> candidates{{"sum again", Eigen::MatrixXd{{1, 1}} / s},
                                          {"difference", Eigen::MatrixXd{{1, -1}} / s}};
  const auto gains = d_optimality(J, candidates);
  EXPECT_EQ(gains[0].candidate, 1);
  EXPECT_NEAR(gains[0].shrinkage, std::sqrt((12 + 2e4) / 12), 1e-9 * gains[0].shrinkage);
  EXPECT_NEAR(gains[1].shrinkage, std::sqrt((12 + 4e4) / (12 + 2e4)), 1e-9);
  // Only the bounds limit this direction.
  EXPECT_NEAR(gains[0].widest_before, std::sqrt(1.0 / 12), 1e-9);
  EXPECT_NEAR(gains[0].widest_after, 1 / std::sqrt(12 + 2e4), 1e-9);
  EXPECT_NEAR(gains[1].widest_after, gains[1].widest_before, 1e-9);
}

TEST(DOptimality, WithoutDataTheBoundsAreWhatIsKnown) {
  const auto d = deviations_with_bounds(Eigen::MatrixXd::Zero(1, 2));
  EXPECT_NEAR(d[0], std::sqrt(1.0 / 12), 1e-12);
}

}  // namespace
}  // namespace latsch
