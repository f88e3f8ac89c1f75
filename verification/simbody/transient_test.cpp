// SPDX-License-Identifier: Apache-2.0
// The committed run of the car over its kerb is what Simbody gives where it is installed.
#include <gtest/gtest.h>

#include <cmath>

#include "simbody/oracle_figures.h"

namespace latsch::verification {
namespace {

// At a thousand times the committed run's tolerance, which is 20 nm away.
TEST(SimbodyTransient, CommittedRunIsWhatItGivesToday) {
  const std::string folder = LATSCH_SIMBODY_CASES;
  const auto today = figures_of_oracle("transient '" + folder + "/car_21_bodies.json' 1e-6");
  if (!today) GTEST_SKIP() << "Simbody (libsimbody-dev) is not installed: no oracle was built";
  const Figures committed = read_figures(folder + "/car_21_bodies_simbody.csv");
  ASSERT_EQ(today->head, committed.head);
  ASSERT_EQ(committed.rows.size(), 301u);
  ASSERT_EQ(today->rows.size(), committed.rows.size());
  double away = 0.0;
  for (std::size_t i = 0; i < committed.rows.size(); ++i)
    for (std::size_t j = 0; j < committed.head.size(); ++j)
      away = std::max(away, std::abs(today->number(i, j) - committed.number(i, j)));
  EXPECT_LT(away, 1e-7);  // s, m
}

}  // namespace
}  // namespace latsch::verification
