// SPDX-License-Identifier: Apache-2.0
#include "correlation/validation/validation.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/study/spring_testing.h"

namespace latsch::correlation {
namespace {

using experiment::Language;
using experiment::Specimen;
using experiment::TestKind;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A test that records NaN as its second sample.
class GapTest : public experiment::Test {
 public:
  std::string in_words() const override { return "a test with a gap"; }
  std::vector<experiment::ChannelInfo> channels() const override { return {{"force", "N"}}; }
  std::vector<std::string> needs() const override { return {experiment::Spring::kName}; }
  Result<Channels> run(Specimen&) const override {
    Channels channels;
    channels.add({"force", "N", {200.0, kNaN}});
    return channels;
  }
};

const Language& gap_language() {
  static const experiment::SpringKind kind;
  static const TestKind gap = {
      "gap",
      "has a gap",
      {experiment::Spring::kName},
      [](const Node&, const experiment::TestSource&) {
        return std::unique_ptr<experiment::Test>(std::make_unique<GapTest>());
      }};
  static const Language language = {{&kind}, {&gap}};
  return language;
}

const char* const kSpring = "kind = \"spring\"\nstiffness = \"20 N/mm\"\ndamping = \"0 N s/m\"\n";

Validation validated(const std::string& checks) {
  const ScratchFolder folder;
  write_text_file(folder.path() / "gap.toml", "kind = \"gap\"\n");
  const auto suite = folder.path() / "suite.toml";
  write_text_file(suite, "[test.run]\nfile = \"gap.toml\"\n" + checks);
  const Language& language = gap_language();
  return validate(read_suite(suite, *language.kinds.front(), language),
                  *language.kinds.front(),
                  Document::parse(kSpring, "spring.toml"),
                  [](const std::string&) {});
}

TEST(Validation, AValueThatIsNotANumberIsNeverAccepted) {
  const Validation validation = validated(
      "[check.forces]\nkind = \"values\"\nchannel = \"run/force\"\nvalues = [\"200 N\", "
      "\"200 N\"]\nlargest_error = \"3 %\"\nmean_error = \"3 %\"\nsource = \"none\"\n");
  ASSERT_EQ(validation.results.size(), 2u);
  for (const CheckResult& one : validation.results) {
    EXPECT_FALSE(one.accepted);
    EXPECT_FALSE(one.value.has_value());
    EXPECT_NE(one.reason.find("channel \"run/force\" is nan at sample 2"), std::string::npos)
        << one.reason;
  }
}

TEST(Validation, ANumberOfATestWithAGapHasNoValueEither) {
  const Validation validation = validated(
      "[check.first]\nchannel = \"run/force\"\nof = \"first\"\nlower = \"100 N\"\n"
      "source = \"none\"\n");
  ASSERT_EQ(validation.results.size(), 1u);
  EXPECT_FALSE(validation.accepted());
  EXPECT_FALSE(validation.results.front().value.has_value());
}

TEST(Validation, TheLanguageFailsATestWithAGapInWords) {
  const Language& language = gap_language();
  const Document numbers = Document::parse(kSpring, "spring.toml");
  const auto whole = language.run(*language.kinds.front(), numbers, GapTest());
  ASSERT_FALSE(whole);
  EXPECT_NE(whole.failure().reason.find("force is not a number at sample 2"), std::string::npos);
  long told = 0;
  const auto blocks = language.run_in_blocks(
      *language.kinds.front(), numbers, GapTest(), [&](const Channels&) { ++told; });
  EXPECT_FALSE(blocks);
  EXPECT_EQ(told, 0);
}

}  // namespace
}  // namespace latsch::correlation
