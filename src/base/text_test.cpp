// SPDX-License-Identifier: Apache-2.0
#include "base/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace latsch {
namespace {

TEST(Text, EditDistanceCountsASwapOfNeighborsOnce) {
  EXPECT_EQ(edit_distance("pressure", "pressure"), 0);
  EXPECT_EQ(edit_distance("presure", "pressure"), 1);
  EXPECT_EQ(edit_distance("pressuer", "pressure"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // [Levenshtein 1966]'s textbook pair
  EXPECT_EQ(edit_distance("", "abc"), 3);
}

TEST(Text, SuggestsTheNearestNameAndNoneThatIsUnlike) {
  EXPECT_EQ(nearest("presure", {"size", "pressure", "name"}), "pressure");
  EXPECT_EQ(nearest("FZ", {"Fx", "Fz"}), "Fz");
  EXPECT_EQ(nearest("zzz", {"size", "pressure"}), std::nullopt);
  EXPECT_EQ(did_you_mean("presure", {"pressure"}), ", did you mean \"pressure\"?");
  EXPECT_EQ(did_you_mean("zzz", {}), "");
}

TEST(Text, QuotationsHoldNoControlCharactersAndStayShort) {
  EXPECT_EQ(in_quotes("a\nb\x1b[2J"), "\"a\\x0ab\\x1b[2J\"");
  EXPECT_LT(in_quotes(std::string(10000, 'x')).size(), 100u);
  EXPECT_EQ(list_of({"a", "b", "c"}), "\"a\", \"b\" or \"c\"");
}

// The first case is the guide's own example [JCGM 100:2008, 7.2.6]: 10.05762 ohm known to 27 mohm
// is 10.058.
TEST(Text, ValuesHaveTheDigitsTheirUncertaintyLeaves) {
  EXPECT_EQ(format_known(10.05762, 0.027), "10.058");
  EXPECT_EQ(format_known(73.039, 33.9), "73");
  EXPECT_EQ(format_known(-0.8233412, 0.0071), "-0.8233");
  EXPECT_EQ(format_known(1987.3, 330.0), "1990");  // and not 1.99e+03
  EXPECT_EQ(format_known(99.6, 12.0), "100");
  EXPECT_EQ(format_known(204'113.0, 2100.0), "204100");
  EXPECT_EQ(format_known(1.2345e-7, 3e-9), "1.235e-07");
  EXPECT_EQ(format_known(0.3, 500.0), "0.3");  // a logarithmic variable
  EXPECT_EQ(format_known(0.0, 0.1), "0");
  EXPECT_EQ(format_known(1.0 / 3.0, 0.0), "0.333333333");
  EXPECT_EQ(format_known(22.31, std::numeric_limits<double>::infinity()), "20");
  EXPECT_EQ(format_known(22.31, std::numeric_limits<double>::quiet_NaN()), "20");
}

TEST(Text, NumbersComeBackWithTheSameBits) {
  for (const double value : {0.1, 1.0 / 3.0, 6.02214076e23, 5e-324, -0.0, 1.7976931348623157e308}) {
    const auto read = parse_number(format_number(value));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, value);
    EXPECT_EQ(std::signbit(*read), std::signbit(value));
  }
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(1.0 / 3.0, 3), "0.333");
  EXPECT_EQ(parse_number(" +2.5 "), 2.5);
  EXPECT_FALSE(parse_number("2.5x"));
  EXPECT_FALSE(parse_number(""));
  EXPECT_FALSE(parse_number("+-1"));
}

TEST(DidYouMean, OneLetterIsNoSlipOfAnother) {
  EXPECT_EQ(did_you_mean("y", {"x"}), "");
  EXPECT_EQ(did_you_mean("Y", {"y"}), ", did you mean \"y\"?");
  EXPECT_EQ(did_you_mean("k", {"k2"}), ", did you mean \"k2\"?");
}

}  // namespace
}  // namespace latsch
