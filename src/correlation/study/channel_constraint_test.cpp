// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/channel_constraint.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::correlation {
namespace {

const std::vector<KnownChannel> kChannels = {{"stiffness/force", "N"}, {"modes/frequency", "Hz"}};

ChannelConstraint channel_constraint_of(const std::string& text) {
  const Document document = Document::parse("[c.row]\n" + text, "study.toml");
  const Node root = document.root();
  const auto constraint = read_channel_constraint(root.named_tables("c").front(), kChannels);
  root.close();
  return constraint;
}

void expect_refused(const std::string& text, const std::string& part) {
  try {
    channel_constraint_of(text);
    FAIL() << text;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

Channels forces(std::vector<double> values) {
  Channels channels;
  channels.add({"stiffness/force", "N", std::move(values)});
  return channels;
}

TEST(ChannelConstraint, CountsInSharesOfItsScale) {
  Score score;
  const auto within = channel_constraint_of(
      "channel = \"stiffness/force\"\nof = \"largest\"\nlower = \"4 kN\"\nupper = \"5 kN\"\n"
      "scale = \"1 kN\"");
  EXPECT_TRUE(apply(within, forces({1000, 5500}), score).ok());
  EXPECT_EQ(score.constraints, (std::vector<double>{-1.5, 0.5}));
  EXPECT_EQ(in_words(within), "4 kN <= largest stiffness/force <= 5 kN");
  const auto equal =
      channel_constraint_of("channel = \"modes/frequency\"\nof = \"smallest\"\nequal = \"50 Hz\"");
  Channels modes;
  modes.add({"modes/frequency", "Hz", {60, 55}});
  EXPECT_TRUE(apply(equal, modes, score).ok());
  ASSERT_EQ(score.equations.size(), 1u);
  EXPECT_DOUBLE_EQ(score.equations[0], 0.1);
}

// A lower bound on the largest value leaves the others free, which nobody means who does not say
// which value is bounded.
TEST(ChannelConstraint, ALowerBoundOnSeveralValuesNeedsTheirChoice) {
  Score score;
  const auto open = channel_constraint_of("channel = \"stiffness/force\"\nlower = \"4 kN\"");
  const auto refused = apply(open, forces({1000, 5500}), score);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().reason.find("has 2 values"), std::string::npos);
  EXPECT_TRUE(apply(open, forces({5500}), score).ok());
  const auto upper = channel_constraint_of("channel = \"stiffness/force\"\nupper = \"4 kN\"");
  EXPECT_TRUE(apply(upper, forces({1000, 5500}), score).ok());
}

TEST(ChannelConstraint, TakesTheValueItNames) {
  const auto value = [](const std::string& of) {
    Score score;
    const auto constraint = channel_constraint_of("channel = \"stiffness/force\"\nof = \"" + of +
                                                  "\"\nupper = \"0 N\"\nscale = \"1 N\"");
    EXPECT_TRUE(apply(constraint, forces({2, 7, 1, 6}), score).ok());
    return score.constraints.front();
  };
  EXPECT_EQ(value("largest"), 7);
  EXPECT_EQ(value("smallest"), 1);
  EXPECT_EQ(value("mean"), 4);
  EXPECT_EQ(value("first"), 2);
  EXPECT_EQ(value("last"), 6);
}

TEST(ChannelConstraint, OfATrialWithoutItsChannelOrWithoutANumberIsAFailure) {
  Score score;
  const auto constraint = channel_constraint_of("channel = \"stiffness/force\"\nupper = \"4 kN\"");
  EXPECT_FALSE(apply(constraint, Channels(), score).ok());
  EXPECT_FALSE(apply(constraint, forces({}), score).ok());
  EXPECT_FALSE(apply(constraint, forces({NAN}), score).ok());
}

TEST(ChannelConstraint, SaysWhatIsWrong) {
  expect_refused("channel = \"stiffness/forse\"\nupper = \"4 kN\"",
                 "study.toml:2: c.row.channel is \"stiffness/forse\", which no trial records, did "
                 "you mean \"stiffness/force\"?");
  expect_refused("channel = \"stiffness/force\"\nupper = \"4 mm\"", "study.toml:3");
  expect_refused("channel = \"stiffness/force\"", "expected lower, upper or equal");
  expect_refused("channel = \"stiffness/force\"\nlower = \"2 N\"\nupper = \"1 N\"", "above upper");
  expect_refused("channel = \"stiffness/force\"\nequal = \"2 N\"\nupper = \"1 N\"", "alone");
  expect_refused("channel = \"stiffness/force\"\nupper = \"0 N\"", "scale is missing");
  expect_refused("channel = \"stiffness/force\"\nupper = \"1 N\"\nof = \"median\"", "smallest");
}

}  // namespace
}  // namespace latsch::correlation
