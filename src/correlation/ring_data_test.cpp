// SPDX-License-Identifier: Apache-2.0
#include "correlation/ring_data.h"

#include <gtest/gtest.h>

#include <cmath>

#include "correlation/variables.h"
#include "models/ring_tire/ring_modes.h"
#include "models/ring_tire/ring_reader.h"

namespace latsch::correlation {
namespace {

RingData published() {
  return read_ring_data(std::filesystem::path(LATSCH_SOURCE_DIR) /
                        "studies/ring_tire_data/data.toml");
}

/// Without the targets that take a simulation: frequencies and damping alone, and what they show.
RingData modal_only() {
  RingData data = published();
  std::erase_if(data.targets, [](const RingTarget& target) {
    return target.kind == RingTarget::Kind::load || target.kind == RingTarget::Kind::stiffness;
  });
  return data;
}

TEST(RingData, FindsANumberForEveryPublishedFrequencyAndDamping) {
  const RingData data = modal_only();
  const auto fit = fit_ring(data, 300);
  ASSERT_TRUE(fit) << fit.failure().reason;
  for (std::size_t i = 0; i < data.targets.size(); ++i)
    EXPECT_NEAR(fit->values[i] / data.targets[i].value, 1.0, 5e-3) << data.targets[i].name;
}

// Without loads nothing is known of progressivity: no mode of small vibrations feels it.
TEST(RingData, SaysWhatTheDataLeaveOpen) {
  const RingData data = modal_only();
  const auto fit = fit_ring(data, 300);
  ASSERT_TRUE(fit);
  std::string all;
  for (const std::string& sentence : left_open(data, fit->confidence)) all += sentence + "\n";
  EXPECT_NE(all.find("progressivity: the data say nothing"), std::string::npos) << all;
}

}  // namespace
}  // namespace latsch::correlation
