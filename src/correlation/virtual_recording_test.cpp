// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/virtual_recording.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "correlation/study/spring_testing.h"
#include "correlation/study/study.h"
#include "formats/tables/csv_table.h"

namespace latsch::correlation {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTrueSpring =
    "kind = \"spring\"\nstiffness = \"20 N/mm\"\ndamping = \"300 N s/m\"\n";

constexpr const char* kVirtualStudy = R"toml(
model = "start.toml"
test.pulled = {kind = "pull", travels = ["1 mm", "4 mm"], speed = "0.5 m/s"}
measurement.pulled = {file = "measured/pulled.csv", virtual = {model = "spring.toml", test = "pulled"}}
variable.stiffness = {path = "stiffness", lower = "5 N/mm", upper = "60 N/mm", initial = "9 N/mm"}
experiment.force = {kind = "curve", x = "pulled/travel", y = "pulled/force", measurement = "pulled"}
)toml";

class VirtualRecordingTest : public ::testing::Test {
 protected:
  VirtualRecordingTest() {
    write("spring.toml", kTrueSpring);
    write("start.toml", kTrueSpring);
    write("study.toml", kVirtualStudy);
  }
  void write(const std::string& name, const std::string& text) const {
    write_text_file(folder_ / name, text);
  }
  fs::path study() const { return folder_ / "study.toml"; }
  VirtualRecording only() const {
    return virtual_recordings(study(), experiment::spring_language()).at(0);
  }
  std::string why() const { return why_to_record(only().file, only().recipe); }
  /// Returns the message of the InputError with which reading the study ends.
  std::string refusal() const {
    try {
      read_study(study(), experiment::spring_language());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
};

// F = k x + c v: 20 N/mm and 300 N s/m at 0.5 m/s.
TEST_F(VirtualRecordingTest, HasTheForcesOfItsModel) {
  ASSERT_TRUE(record(only()));
  const auto table = formats::CsvTable::read(folder_ / "measured" / "pulled.csv");
  EXPECT_EQ(table.numbers("force", "N"), (std::vector<double>{170.0, 230.0}));
  EXPECT_EQ(table.numbers("travel", "m"), (std::vector<double>{0.001, 0.004}));
}

TEST_F(VirtualRecordingTest, IsOutOfDateOnceTheModelOrTheTestHasChanged) {
  EXPECT_EQ(why(), "it has not been recorded");
  ASSERT_TRUE(record(only()));
  EXPECT_EQ(why(), "");
  write("spring.toml", std::string("# a comment\n") + kTrueSpring);
  EXPECT_EQ(why(), "") << "a comment is not a number";
  write("spring.toml", "kind = \"spring\"\nstiffness = \"21 N/mm\"\ndamping = \"300 N s/m\"\n");
  EXPECT_EQ(why(), "the model or the test has changed since it was recorded");
  write("spring.toml", kTrueSpring);
  EXPECT_EQ(why(), "");
  std::string other = kVirtualStudy;
  other.replace(other.find("0.5 m/s"), 7, "0.6 m/s");
  write("study.toml", other);
  EXPECT_EQ(why(), "the model or the test has changed since it was recorded");
}

TEST_F(VirtualRecordingTest, IsRefusedByStudiesUntilItIsRecorded) {
  EXPECT_NE(refusal().find("latsch run"), std::string::npos) << refusal();
  EXPECT_NE(refusal().find("it has not been recorded"), std::string::npos) << refusal();
  ASSERT_TRUE(record(only()));
  EXPECT_EQ(refusal(), "");
  write("measured/pulled.csv", "travel [mm],force [N]\n1,170\n4,230\n");
  EXPECT_NE(refusal().find("does not say of which model"), std::string::npos) << refusal();
}

TEST_F(VirtualRecordingTest, IsOutOfDateOnceAValueIsChangedByHand) {
  ASSERT_TRUE(record(only()));
  std::string text = read_text_file(only().file);
  std::string other_lines;
  for (const char c : text) other_lines += c == '\n' ? "\r\n" : std::string(1, c);
  write("measured/pulled.csv", other_lines);
  EXPECT_EQ(why(), "") << "ends of lines are no values";
  text.replace(text.find("170"), 3, "171");
  write("measured/pulled.csv", text);
  EXPECT_EQ(why(), kEdited);
  EXPECT_NE(refusal().find(kEdited), std::string::npos) << refusal();
}

TEST_F(VirtualRecordingTest, RefusesATestThatIsNeitherNamedNorAFile) {
  std::string other = kVirtualStudy;
  other.replace(other.find("test = \"pulled\""), 15, "test = \"puled\"");
  write("study.toml", other);
  try {
    only();
    FAIL() << "read";
  } catch (const InputError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("study.toml:4"), std::string::npos) << words;
    EXPECT_NE(words.find("\"puled\", which is neither a [test.NAME]"), std::string::npos) << words;
    EXPECT_NE(words.find("pulled"), std::string::npos) << words;
  }
}

}  // namespace
}  // namespace latsch::correlation
