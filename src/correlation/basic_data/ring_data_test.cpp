// SPDX-License-Identifier: Apache-2.0
#include "correlation/basic_data/ring_data.h"

#include <gtest/gtest.h>

#include <cmath>

#include "correlation/study/variables.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_modes.h"

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

// A longer patch than the tire has, without weight: what moves it is told, and what else goes with
// it. The tread's modulus is known to the tire file alone here, so the sidewall has to do it.
TEST(RingData, NamesWhatAMissedTargetWouldCost) {
  RingData data = modal_only();
  RingTarget patch;
  patch.name = "patch";
  patch.kind = RingTarget::Kind::footprint_length;
  patch.value = 0.4;
  patch.load = 4000.0;
  patch.weight = 0.0;
  data.targets.push_back(patch);
  const auto fit = fit_ring(data, 60);
  ASSERT_TRUE(fit) << fit.failure().reason;
  EXPECT_NEAR(fit->errors.tail<1>()[0], fit->values.back() / 0.4 - 1.0, 1e-12);
  EXPECT_EQ(fit->effects.rows(), static_cast<Eigen::Index>(data.targets.size()));
  std::string all;
  for (const std::string& sentence : missed(data, *fit)) all += sentence + "\n";
  EXPECT_NE(all.find("patch is "), std::string::npos) << all;
  EXPECT_NE(all.find(" % too low: "), std::string::npos) << all;
  EXPECT_NE(all.find("mended by it alone, "), std::string::npos) << all;
  EXPECT_NE(all.find("(it has no weight)"), std::string::npos) << all;
}

// Without loads nothing is known of progressivity: no mode of small vibrations feels it.
TEST(RingData, SaysWhatTheDataLeaveOpen) {
  const RingData data = modal_only();
  const auto fit = fit_ring(data, 300);
  ASSERT_TRUE(fit);
  std::string all;
  for (const std::string& sentence : left_open(data, fit->confidence)) all += sentence + "\n";
  const auto named = all.find("progressivity");
  ASSERT_NE(named, std::string::npos) << all;
  EXPECT_NE(all.substr(named).find("the data say nothing"), std::string::npos) << all;
}

}  // namespace
}  // namespace latsch::correlation
