// SPDX-License-Identifier: Apache-2.0
// Files written by verification/recorders/write_recordings.py, a writer that shares nothing with
// the readers, are read back to the last bit.
#include "formats/recorders/recorded_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/file.h"
#include "formats/recorders/mdf_file.h"
#include "formats/recorders/uff_file.h"
#include "formats/tables/lab_table.h"

namespace latsch::formats {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class WrittenRecordings : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new fs::path(fs::temp_directory_path() /
                           fmt::format("latsch_recordings_{}", static_cast<long>(::getpid())));
    const std::string command =
        fmt::format("python3 {}/verification/recorders/write_recordings.py {}",
                    LATSCH_SOURCE_DIR,
                    folder_->string());
    is_written_ = std::system(command.c_str()) == 0;
  }
  static void TearDownTestSuite() {
    fs::remove_all(*folder_);
    delete folder_;
  }
  void SetUp() override { ASSERT_TRUE(is_written_) << "python3 could not write the files"; }

  static std::string bytes(const char* name) { return read_text_file(*folder_ / name, 1u << 20); }

  static inline fs::path* folder_ = nullptr;
  static inline bool is_written_ = false;
};

void expect_same_numbers(const RecordedChannel& read, const std::string& numbers) {
  std::istringstream words(numbers);
  std::vector<double> expected;
  for (std::string word; words >> word;) expected.push_back(std::strtod(word.c_str(), nullptr));
  ASSERT_EQ(read.values.size(), expected.size()) << read.name;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (std::isnan(expected[i])) {
      EXPECT_TRUE(std::isnan(read.values[i])) << read.name << " " << i;
    } else {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(read.values[i]),
                std::bit_cast<std::uint64_t>(expected[i]))
          << read.name << " " << i << ": " << read.values[i] << ", expected " << expected[i];
    }
  }
}

TEST_F(WrittenRecordings, AreReadBackToTheLastBit) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(*folder_)) {
    if (entry.path().extension() == ".expected") continue;
    SCOPED_TRACE(entry.path().filename().string());
    ++files;
    RecordedFile file;
    ASSERT_NO_THROW(file = read_recorded_file(entry.path()));
    std::map<std::string, std::size_t> taken;  // channels seen of each group
    std::ifstream lines(entry.path().string() + ".expected");
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> cells;
      std::istringstream fields(line);
      for (std::string cell; std::getline(fields, cell, '|');) cells.push_back(cell);
      ASSERT_EQ(cells.size(), 4u);
      const auto group = std::find_if(file.groups.begin(), file.groups.end(), [&](const auto& one) {
        return one.name == cells[0];
      });
      ASSERT_NE(group, file.groups.end()) << cells[0];
      const std::size_t k = taken[cells[0]]++;
      ASSERT_LT(k, group->channels.size()) << cells[1];
      EXPECT_EQ(group->channels[k].name, cells[1]);
      EXPECT_EQ(group->channels[k].unit, cells[2]) << cells[1];
      expect_same_numbers(group->channels[k], cells[3]);
    }
    EXPECT_EQ(taken.size(), file.groups.size());
    for (const RecordedGroup& group : file.groups)
      EXPECT_EQ(taken[group.name], group.channels.size()) << group.name;
  }
  EXPECT_EQ(files, 42);
}

TEST_F(WrittenRecordings, SayWhatIsLeftOut) {
  const RecordedFile file = parse_mdf(bytes("rules.mf4"), "rules");
  EXPECT_EQ(file.left_out.at("text"), "has texts");
  EXPECT_EQ(file.left_out.at("texts"), "is converted to texts");
  EXPECT_EQ(file.left_out.at("formula"), "is converted by a formula");
  EXPECT_EQ(file.left_out.at("long"), "has values of variable length");
  EXPECT_EQ(file.left_out.at("bits"), "has numbers of 65 bits, expected 1 to 64");
  EXPECT_EQ(file.left_out.at("array"), "is an array");
  const RecordedFile functions = parse_uff(bytes("functions.uff"), "functions");
  ASSERT_EQ(functions.left_out.size(), 1u);
  EXPECT_EQ(functions.left_out.begin()->second, "is of type 9, expected 1, 2, 3, 4, 6 or 12");
}

TEST_F(WrittenRecordings, SayThatTheyWereStillBeingWrittenOrAreCut) {
  const RecordedFile unfinished = parse_mdf(bytes("unfinished.mf4"), "unfinished");
  ASSERT_EQ(unfinished.doubts.size(), 1u);
  EXPECT_THAT(unfinished.doubts[0], HasSubstr("still being written"));
  const RecordedFile cut = parse_mdf(bytes("unsorted_2.mf4"), "cut");
  ASSERT_EQ(cut.doubts.size(), 1u);
  EXPECT_EQ(cut.doubts[0], "the last record of group \"fast\" is cut off and is not read");
}

TEST_F(WrittenRecordings, AreTablesInSiByGroupAndResampled) {
  const fs::path file = *folder_ / "unsorted_1.mf4";
  const LabTable fast = read_lab_table(file, {}, {}, "fast");
  EXPECT_EQ(fast.channels["Fz"][3], 2000.0);  // 2 kN
  const LabTable none = read_lab_table(file);
  EXPECT_EQ(none.structs, (std::vector<std::string>{"slow", "fast"}));
  const LabTable joined = read_lab_table(file, {}, {}, "", 2e-3);
  ASSERT_EQ(joined.channels["time"].size(), 9u);      // 0 to 16 ms
  EXPECT_DOUBLE_EQ(joined.channels["Fz"][1], 1.0);    // between 0 at 0 ms and 2 at 4 ms
  EXPECT_TRUE(std::isnan(joined.channels["Fz"][3]));  // beside the gap at 8 ms
  EXPECT_DOUBLE_EQ(joined.channels["Fz @ fast"][3], 11000.0);
  try {
    read_lab_table(file, {}, {}, "fats");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("has no group \"fats\", did you mean \"fast\"?"));
  }
}

/// Returns the message for bytes that must be refused.
std::string refusal_of(const std::string& bytes, bool is_mdf) {
  try {
    is_mdf ? parse_mdf(bytes, "spoiled") : parse_uff(bytes, "spoiled");
  } catch (const InputError& error) {
    return error.what();
  }
  return "is read";
}

/// Returns the bytes with a number of eight bytes written over those at a position.
std::string with_number(std::string bytes, std::size_t at, std::uint64_t number) {
  std::memcpy(bytes.data() + at, &number, sizeof(number));
  return bytes;
}

TEST_F(WrittenRecordings, WithWrongLengthsAndLinksAreRefusedInWords) {
  const std::string plain = bytes("plain.mf4");
  const std::size_t data = plain.find("##DT"), group = plain.find("##DG"),
                    channels = plain.find("##CG");
  const std::size_t channel = plain.find("##CN"), rule = bytes("rules.mf4").find("##CC");
  EXPECT_THAT(refusal_of(with_number(plain, data + 8, std::uint64_t{1} << 63), true),
              HasSubstr("states a length of 9223372036854775808 bytes"));
  EXPECT_THAT(refusal_of(with_number(plain, group + 24, group), true),
              HasSubstr("is linked twice"));
  EXPECT_THAT(refusal_of(with_number(plain, channel + 24, channel), true),
              HasSubstr("is linked twice"));
  EXPECT_THAT(refusal_of(with_number(plain, channels + 72 + 8, std::uint64_t{1} << 63), true),
              HasSubstr("expected 9223372036854775808: is the file cut off?"));
  EXPECT_THAT(refusal_of(with_number(plain, channels + 72 + 24, 0), true),
              HasSubstr("has group \"rig\" with a record size of 0"));
  EXPECT_THAT(refusal_of(with_number(bytes("rules.mf4"), rule + 8, 1), true),
              HasSubstr("states a length of 1 bytes"));
  EXPECT_THAT(refusal_of(plain.substr(0, data + 100), true), HasSubstr("links to byte"));
  std::string old = plain;
  old[28] = 'J', old[29] = 1;  // 330
  EXPECT_EQ(refusal_of(old, true),
            "spoiled: is MDF 3.30, expected 4.0 to 4.2: convert it with the program that recorded "
            "it");
}

TEST_F(WrittenRecordings, ThatUnpackToMoreThanTheyStateAreRefused) {
  const std::string deflated = bytes("deflated.mdf");
  const std::size_t block = deflated.find("##DZ") + 24;
  EXPECT_THAT(refusal_of(with_number(deflated, block + 8, 100), true),
              HasSubstr("expected 100 and no more"));
  EXPECT_THAT(refusal_of(with_number(deflated, block + 8, std::uint64_t{1} << 40), true),
              HasSubstr("larger than 1 GiB when unpacked"));
  EXPECT_THAT(refusal_of(with_number(deflated, block + 16, std::uint64_t{1} << 40), true),
              HasSubstr("packed bytes where"));
}

TEST_F(WrittenRecordings, OfBrokenTextAreRefusedWithTheLine) {
  std::string text = bytes("text_2_even.uff");
  const std::size_t number = text.rfind("-1.75000e+00");
  text.replace(number, 5, "abcde");
  EXPECT_THAT(refusal_of(text, false), HasSubstr("spoiled:34: is "));
  const std::string binary = bytes("binary_4_even_1.uff");
  EXPECT_THAT(refusal_of(binary.substr(0, binary.size() - 30), false), HasSubstr("cut off"));
  // The head ends with the file, without a line end, and states no sample.
  std::string head = binary.substr(0, binary.find("a line more") - 1);
  head.replace(head.find("         4         7"), 19, "         4         0");
  EXPECT_THAT(refusal_of(head, false), HasSubstr("spoiled:"));
}

TEST(RecordedText, EndsAtAZeroByteAndTakesLatin1) {
  EXPECT_EQ(recorded_text(std::string_view("Fz\0junk", 7), "f"), "Fz");
  EXPECT_EQ(recorded_text("Kr\xe4"
                          "fte\r\n",
                          "f"),
            "Kräfte");
}

TEST(RecordedNames, ThatComeTwiceAreToldApart) {
  RecordedGroup group{"g", {{"Fz"}, {"Fz"}, {"Fz #2"}, {"Fz"}}, false};
  tell_equal_names_apart(group);
  EXPECT_EQ(group.channels[1].name, "Fz #2");
  EXPECT_EQ(group.channels[2].name, "Fz #2 #2");
  EXPECT_EQ(group.channels[3].name, "Fz #3");
}

}  // namespace
}  // namespace latsch::formats
