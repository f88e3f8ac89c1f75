// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/values.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::correlation {
namespace {

const std::vector<KnownChannel> kKnown = {{"print/length", "m"}, {"print/load", "N"}};

std::shared_ptr<const Values> values_of(const std::string& text) {
  const Document document = Document::parse("[e.row]\n" + text, "study.toml");
  const Node root = document.root();
  auto values = read_values(root.named_tables("e").front(), kKnown);
  root.close();
  return values;
}

std::string values_complaint(const std::string& text) {
  try {
    values_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Channels lengths(std::vector<double> values) {
  Channels channels;
  channels.add({"print/length", "m", std::move(values)});
  return channels;
}

TEST(Values, AreComparedInSharesOfThemselves) {
  const auto both = values_of("channel = \"print/length\"\nvalues = [\"100 mm\", \"200 mm\"]\n");
  const auto comparison = both->compare(lengths({0.09, 0.21}), {});
  ASSERT_TRUE(comparison);
  EXPECT_NEAR(comparison->errors[0], 0.1, 1e-12);
  EXPECT_NEAR(comparison->errors[1], -0.05, 1e-12);
  EXPECT_NEAR(comparison->mean_error, 0.075, 1e-12);
  EXPECT_EQ(both->rows()[1], "print/length, value 2");
  EXPECT_NEAR(both->deviations({.absolute = 0.002}, {})[1], 0.01, 1e-15);
}

TEST(Values, OneOfSeveralIsTakenByItsName) {
  const auto one = values_of(
      "channel = \"print/length\"\nvalue = \"20 cm\"\nof = \"largest\"\nscale = \"1 cm\"\n");
  EXPECT_NEAR(one->compare(lengths({0.1, 0.19, 0.12}), {})->errors[0], 1.0, 1e-12);
  const auto plain = values_of("channel = \"print/length\"\nvalue = \"20 cm\"\n");
  EXPECT_NE(plain->compare(lengths({0.1, 0.2}), {}).failure().reason.find("of = \"largest\""),
            std::string::npos);
  EXPECT_FALSE(plain->compare(Channels(), {}));
}

TEST(Values, SayWhatIsWrong) {
  EXPECT_NE(values_complaint("channel = \"print/lenght\"\nvalue = \"1 m\"\n").find("did you mean"),
            std::string::npos);
  EXPECT_NE(values_complaint("channel = \"print/length\"\nvalue = \"1 N\"\n").find("length"),
            std::string::npos);
  EXPECT_NE(values_complaint("channel = \"print/length\"\nvalue = \"0 m\"\n").find("scale"),
            std::string::npos);
  EXPECT_NE(values_complaint("channel = \"print/length\"\n").find("one of them"),
            std::string::npos);
}

}  // namespace
}  // namespace latsch::correlation
