// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/outcome_packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "evaluation/trial/encoding.h"

namespace latsch {
namespace {

constexpr int kStates = 600;

/// Returns a smooth model of three variables at measured states: one channel is constant, one
/// depends on one variable, one on all of them.
Outcome smooth(const std::vector<double>& p, double ripple = 0.0, std::uint64_t seed = 1) {
  RandomStream states(7, 0), noise(seed, 1);
  std::vector<double> load, trail, force;
  for (int i = 0; i < kStates; ++i) {
    const double alpha = 0.2 * (states.uniform() - 0.5), Fz = 1000.0 + 3000.0 * states.uniform();
    load.push_back(Fz);
    trail.push_back(0.03 * std::cos(std::atan(p[2] * alpha)));
    force.push_back(Fz * p[0] * std::sin(1.4 * std::atan(p[1] * alpha)) + ripple * noise.uniform());
  }
  Channels channels;
  channels.add({"Fz", "N", load});
  channels.add({"t", "m", trail});
  channels.add({"Fy", "N", force});
  return {.result = channels, .wall_time = 0.25, .cpu_time = 0.125, .worker = 1};
}

std::vector<Outcome> search(int trials, double ripple = 0.0) {
  std::vector<Outcome> all;
  RandomStream random(3, 0);
  for (int i = 0; i < trials; ++i) {
    const auto near = [&](double x) { return x * (1.0 + 0.02 * (random.uniform() - 0.5)); };
    all.push_back(smooth({near(1.2), near(12.0), i % 3 ? 8.0 : near(8.0)}, ripple, i));
  }
  return all;
}

/// Packs and unpacks the outcomes and compares them bit by bit. Returns the ratio of the packed to
/// the plain size.
double share(const std::vector<Outcome>& outcomes) {
  OutcomePacker packer;
  OutcomeUnpacker unpacker;
  double plain = 0.0, packed = 0.0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i) + 1;
    const std::string bytes = packer.pack(number, outcomes[i]);
    const auto back = unpacker.unpack(number, bytes);
    EXPECT_TRUE(back && encode(*back) == encode(outcomes[i])) << i;
    plain += static_cast<double>(encode(outcomes[i]).size());
    packed += static_cast<double>(bytes.size());
  }
  return packed / plain;
}

TEST(OutcomePacking, KeepsEveryBitOfSmoothChannelsInAFifthOfTheRoom) {
  EXPECT_LE(share(search(200)), 0.2);
}

// Rounding and solver tolerances are noise, which earlier outcomes cannot predict.
TEST(OutcomePacking, RoughChannelsTakeWhatTheirNoiseTakes) {
  // Forces near 1e3 N with noise of 1e-3 N: 20 of the 53 bits can be predicted.
  const double rough = share(search(100, 1e-3));
  EXPECT_LE(rough, 0.5);
}

TEST(OutcomePacking, KeepsAnyBits) {
  RandomStream random(5, 0);
  std::vector<Outcome> outcomes;
  for (int i = 0; i < 90; ++i) {
    Channels channels;
    std::vector<double> odd;
    for (int k = 0; k < 40 + i % 3; ++k) odd.push_back(std::ldexp(random.uniform() - 0.5, k * 20));
    odd[0] = -0.0;
    odd[1] = 1e-310;
    odd[2] = std::numeric_limits<double>::max();
    odd[3] = std::numeric_limits<double>::lowest();
    channels.add({"a/odd", "N", odd});
    if (i % 4) channels.add({"b/" + std::to_string(i % 2), "1", std::vector<double>(60, 0.1 * i)});
    channels.add({"empty", "1", {}});
    outcomes.push_back({.result = channels, .program_time = 0.5 * (i % 2)});
    if (i % 7 == 0) outcomes.push_back({.result = Failure{"no equilibrium", Cause::timeout}});
  }
  share(outcomes);
}

TEST(OutcomePacking, SlopesComeBackWhereThereAreSome) {
  std::vector<Outcome> outcomes = search(80);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (i % 5 == 0) continue;  // this trial has no slopes
    Channels with_slopes;
    for (Channel channel : outcomes[i].result->all()) {
      if (channel.name == "Fy") {
        // Slopes of Fy by ln p[0], then by a variable without effect.
        channel.slopes = channel.values;
        channel.slopes.resize(2 * kStates, 0.0);
      }
      with_slopes.add(std::move(channel));
    }
    outcomes[i].result = with_slopes;
  }
  EXPECT_LE(share(outcomes), 0.25);
}

TEST(OutcomePacking, ALostRowCostsThoseOfItsBlockAtMost) {
  const auto outcomes = search(3 * kLongestBlock);
  OutcomePacker packer;
  OutcomeUnpacker unpacker;
  int lost = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i) + 1;
    const std::string bytes = packer.pack(number, outcomes[i]);
    if (number == kLongestBlock + 1) continue;  // no other row refers to this one
    const auto back = unpacker.unpack(number, bytes);
    if (!back) ++lost;
    if (back) {
      EXPECT_EQ(encode(*back), encode(outcomes[i]));  // the outcome is never wrong
    }
  }
  EXPECT_GT(lost, 0);
  EXPECT_LT(lost, kLongestBlock);
}

TEST(OutcomePacking, AfterABeginningAnewNothingBeforeIsNeeded) {
  const auto outcomes = search(6);
  OutcomePacker packer;
  for (int i = 0; i < 3; ++i) (void)packer.pack(i + 1, outcomes[i]);
  packer.begin_anew();
  OutcomeUnpacker unpacker;
  EXPECT_TRUE(unpacker.unpack(4, packer.pack(4, outcomes[3])));
  EXPECT_TRUE(unpacker.unpack(5, packer.pack(5, outcomes[4])));
}

TEST(OutcomePacking, BytesThatAreNoneAreRefused) {
  const std::string bytes = OutcomePacker().pack(1, smooth({1.2, 12.0, 8.0}));
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50) {
    EXPECT_FALSE(OutcomeUnpacker().unpack(1, std::string_view(bytes).substr(0, size)));
  }
  RandomStream random(9, 0);
  for (int i = 0; i < 300; ++i) {
    std::string spoiled = bytes;
    spoiled[random.below(spoiled.size())] ^= static_cast<char>(1u << random.below(8));
    if (const auto read = OutcomeUnpacker().unpack(1, spoiled)) {
      EXPECT_EQ(encode(*read), encode(smooth({1.2, 12.0, 8.0})));
    }
  }
}

}  // namespace
}  // namespace latsch
