// SPDX-License-Identifier: Apache-2.0
// Tests that a change by the page changes only the intended position of a study's file.
#include "studio/shelf/study_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/document.h"
#include "base/error.h"
#include "correlation/search/study_reuse_testing.h"

namespace latsch::studio {
namespace {

const std::string kStudy = R"(# a comment that stays
title = "One"   # and this one

[variable.grip]
lower = "0.5"   # of a dry road
scale = "linear"
paths = ["PDY1"]

[run]
workers = 2
)";

std::string change(const std::vector<std::string>& table,
                   const std::string& key,
                   const EditedValue& value,
                   const std::string& text = kStudy) {
  return edited(text, "study.toml", {table, key, value});
}

TEST(EditedStudy, OneValueInItsPlace) {
  std::string expected = kStudy;
  expected.replace(expected.find("\"0.5\""), 5, "\"0.25 bar\"");
  EXPECT_EQ(change({"variable", "grip"}, "lower", "0.25 bar"), expected);
  expected = kStudy;
  expected.replace(expected.find("workers = 2"), 11, "workers = 3");
  EXPECT_EQ(change({"run"}, "workers", 3.0), expected);
}

TEST(EditedStudy, AKeyThatIsNotThereComesBelowItsHead) {
  const std::string text = change({"variable", "grip"}, "upper", "2");
  EXPECT_NE(text.find("[variable.grip]\nupper = \"2\"\nlower"), std::string::npos) << text;
  EXPECT_NE(change({}, "max_steps", 40.0).find("max_steps = 40\n# a comment"), std::string::npos);
}

TEST(EditedStudy, ATableThatIsNotThereComesAtTheEnd) {
  const std::string text = change({"variable", "stiffness"}, "path", "PKY1");
  EXPECT_TRUE(text.starts_with(kStudy)) << text;
  EXPECT_TRUE(text.ends_with("\n[variable.stiffness]\npath = \"PKY1\"\n")) << text;
  const std::string both = change({"variable", "stiffness"}, "lower", "-60", text);
  const Node table =
      Document::parse(both, "study.toml").root().table("variable").table("stiffness");
  EXPECT_EQ(table.text("path"), "PKY1");
  EXPECT_EQ(table.text("lower"), "-60");
}

TEST(EditedStudy, AKeyGoesWithItsLine) {
  std::string expected = kStudy;
  expected.erase(expected.find("scale"), std::string("scale = \"linear\"\n").size());
  EXPECT_EQ(change({"variable", "grip"}, "scale", std::monostate()), expected);
  EXPECT_EQ(change({"variable", "grip"}, "upper", std::monostate()), kStudy);
}

TEST(EditedStudy, AnyTextIsWrittenAsWhatItIs) {
  const std::string wild = "a \"quoted\" \\ name\nof two lines\t\x01";
  const std::string text = change({}, "title", wild);
  EXPECT_EQ(Document::parse(text, "study.toml").root().text("title"), wild);
}

TEST(EditedStudy, WhatIsNoScalarOrNoNameIsRefused) {
  EXPECT_THROW(change({"variable", "grip"}, "paths", "PDY1"), InputError);
  EXPECT_THROW(change({"variable"}, "grip", "x"), InputError);
  EXPECT_THROW(change({"variable", "a]\n[run"}, "lower", "1"), InputError);
  EXPECT_THROW(change({"run"}, "workers = 9\nx", 1.0), InputError);
  EXPECT_THROW(change({"title"}, "x", 1.0), InputError);
}

class WrittenStudy : public correlation::FittedStudy {};

TEST_F(WrittenStudy, WhatSomebodyElseWroteIsNotWrittenOver) {
  write("study.toml", kStudy);
  const auto file = folder_ / "study.toml";
  const StudyText seen = read_study_text(file);
  const std::string next = write_study_text(file, seen.version, kStudy + "# more\n");
  EXPECT_THROW(write_study_text(file, seen.version, kStudy), ChangedMeanwhile);
  EXPECT_EQ(read_study_text(file).text, kStudy + "# more\n");
  EXPECT_EQ(read_study_text(file).version, next);
  EXPECT_THROW(write_study_text(file, next, "[variable"), InputError) << "no TOML is written";
}

TEST_F(WrittenStudy, TheCheckNamesTheLineAndLeavesNothing) {
  const auto& language = experiment::language();
  const Checked good = check_study_text(folder_ / "study.toml", kHead, language);
  EXPECT_TRUE(good.ok) << good.messages.front().text;
  EXPECT_FALSE(good.understood.empty());
  std::string text = kHead;
  text.replace(text.find("lower = 0.5"), 11, "lower = \"x\"");
  const Checked wrong = check_study_text(folder_ / "study.toml", text, language);
  ASSERT_FALSE(wrong.ok);
  EXPECT_EQ(wrong.messages.front().line, 9);
  EXPECT_NE(wrong.messages.front().text.find("study.toml:9"), std::string::npos)
      << wrong.messages.front().text;
  for (const auto& file : std::filesystem::directory_iterator(folder_.path()))
    EXPECT_FALSE(file.path().filename().string().starts_with(".")) << file.path();
}

// A file name so long that no temporary file fits beside it acts like a read-only folder, which a
// test run by root cannot have.
TEST_F(WrittenStudy, WhereNothingCanBeWrittenTheCheckSaysSo) {
  const auto& language = experiment::language();
  const std::string name = std::string(240, 'x') + ".toml";
  write(name, kHead);
  EXPECT_TRUE(check_study_text(folder_ / name, kHead, language).ok) << "as it stands it is read";
  const Checked changed = check_study_text(folder_ / name, kHead + "# more\n", language);
  EXPECT_FALSE(changed.ok);
  ASSERT_EQ(changed.messages.size(), 1u);
  EXPECT_TRUE(
      changed.messages[0].text.starts_with(folder_.path().string() + " cannot be written to"))
      << changed.messages[0].text;
}

}  // namespace
}  // namespace latsch::studio
