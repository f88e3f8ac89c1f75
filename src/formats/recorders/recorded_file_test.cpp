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
#include "base/scratch_folder_testing.h"
#include "formats/recorders/mdf_file.h"
#include "formats/recorders/motec_file.h"
#include "formats/recorders/rpc_file.h"
#include "formats/recorders/tdms_file.h"
#include "formats/recorders/tdms_segments.h"
#include "formats/recorders/uff_file.h"
#include "formats/tables/lab_table.h"
#include "formats/text/file_marks.h"

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

std::string message_of_file(const fs::path& file) {
  try {
    read_recorded_file(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(WrittenRecordings, ARenamedFileIsRefusedByWhatItIs) {
  const ScratchFolder folder;
  const auto renamed = [&](const char* name, const std::string& as) {
    fs::copy_file(*folder_ / name, folder / as);
    return message_of_file(folder / as);
  };
  EXPECT_THAT(renamed("columns.mf4", "a.tdms"),
              HasSubstr("is an MDF 4 file by its first bytes, but ends in \".tdms\": expected "
                        "\".mf4\" or \".mdf\"; change its name"));
  EXPECT_THAT(renamed("kinds_little.tdms", "b.mf4"), HasSubstr("is a TDMS file"));
  EXPECT_THAT(renamed("reals_rsp.rsp", "c.ld"), HasSubstr("is an RPC III file"));
  EXPECT_THAT(renamed("log.ld", "d.uff"), HasSubstr("is a MoTeC log"));
  EXPECT_THAT(renamed("binary_2_even_1.uff", "e.tdms"), HasSubstr("is a universal file"));
  EXPECT_THAT(renamed("columns.mf4", "f.csv"), HasSubstr("is an MDF 4 file"));
  write_text_file(folder / "g.mf4", "PK\x03\x04 and so on");
  EXPECT_THAT(message_of_file(folder / "g.mf4"), HasSubstr("save the sheet as .csv"));
  // Files under their own names are read as before, and a table of numbers is none of these kinds.
  EXPECT_EQ(message_of_file(*folder_ / "columns.mf4"), "");
  EXPECT_EQ(find_file_mark("    -1,2,3\n     5\n"), nullptr);
  EXPECT_EQ(find_file_mark(""), nullptr);
}

TEST_F(WrittenRecordings, ACutFileSaysThatItIsCut) {
  const ScratchFolder folder;
  for (const char* name : {"columns.mf4", "kinds_little.tdms", "reals_rsp.rsp", "log.ld"}) {
    const std::string whole = bytes(name);
    for (const double share : {0.008, 0.3, 0.6}) {
      const fs::path file = folder / name;
      write_text_file(file, whole.substr(0, static_cast<std::size_t>(share * whole.size())));
      std::string said = message_of_file(file);
      if (said.empty())
        for (const std::string& doubt : read_recorded_file(file).doubts) said += doubt + "\n";
      EXPECT_THAT(said, HasSubstr("cut off")) << name << " " << share;
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
  EXPECT_EQ(files, 67);
}

TEST_F(WrittenRecordings, SayWhatIsLeftOut) {
  const RecordedFile file = parse_mdf(bytes("rules.mf4"), "rules");
  EXPECT_EQ(file.left_out.at("text"), "has texts");
  EXPECT_EQ(file.left_out.at("texts"), "is converted to texts");
  EXPECT_EQ(file.left_out.at("formula"), "is converted by a formula");
  EXPECT_EQ(file.left_out.at("long"), "has values of variable length");
  EXPECT_EQ(file.left_out.at("bits"), "has numbers of 65 bits, expected 1 to 64");
  EXPECT_EQ(file.left_out.at("array"), "is an array");
  // A label that is no unit of the kind of quantity is taken, with a doubt.
  std::string strange = bytes("text_2_even.uff");
  for (std::size_t at = strange.find("N                   "); at != strange.npos;
       at = strange.find("N                   ", at + 1))
    strange.replace(at, 4, "deg ");
  const RecordedFile doubted = parse_uff(strange, "strange");
  ASSERT_EQ(doubted.doubts.size(), 1u);
  EXPECT_THAT(doubted.doubts[0], HasSubstr("says \"deg\""));
  EXPECT_THAT(doubted.doubts[0], HasSubstr("not a unit of its kind of quantity"));
  const RecordedFile functions = parse_uff(bytes("functions.uff"), "functions");
  ASSERT_EQ(functions.left_out.size(), 1u);
  EXPECT_EQ(functions.left_out.begin()->second, "is of type 9, expected 1, 2, 3, 4, 6 or 12");
  const RecordedFile groups = parse_tdms(bytes("groups.tdms"), "groups");
  EXPECT_EQ(groups.left_out.at("note"), "has texts");
  EXPECT_EQ(groups.left_out.at("clock"), "has time stamps");
  EXPECT_EQ(groups.left_out.at("vector"), "has complex numbers");
  EXPECT_EQ(groups.left_out.at("counts"),
            "has the numbers of a converter, whose scale (NI_Scale) is not applied");
  const RecordedFile log = parse_motec(bytes("log.ld"), "log");
  EXPECT_EQ(log.left_out.at("Strange"), "has numbers of kind 9, expected 0, 3, 5 or 7");
  EXPECT_EQ(log.left_out.at("No Scale"), "has a scale of 0");
}

TEST_F(WrittenRecordings, SayThatTheyWereStillBeingWrittenOrAreCut) {
  const RecordedFile unfinished = parse_mdf(bytes("unfinished.mf4"), "unfinished");
  ASSERT_EQ(unfinished.doubts.size(), 1u);
  EXPECT_THAT(unfinished.doubts[0], HasSubstr("still being written"));
  const RecordedFile cut = parse_mdf(bytes("unsorted_2.mf4"), "cut");
  ASSERT_EQ(cut.doubts.size(), 1u);
  EXPECT_EQ(cut.doubts[0], "the last record of group \"fast\" is cut off and is not read");
  const RecordedFile open = parse_tdms(bytes("open.tdms"), "open");
  ASSERT_EQ(open.doubts.size(), 2u);
  EXPECT_THAT(open.doubts[0], HasSubstr("was not closed"));
  EXPECT_EQ(open.doubts[1],
            "the last 9 bytes of the segment at byte 0 are not a whole record and are not read");
  // A segment of one channel that is closed, and has fewer values than it states.
  const RecordedFile part = parse_tdms(bytes("part.tdms"), "part");
  ASSERT_EQ(part.doubts.size(), 2u);
  EXPECT_EQ(part.doubts[0],
            "the last part of the segment at byte 0 has 6 of the 1000 values that it states");
  EXPECT_THAT(part.doubts[1], HasSubstr("states a step of 0 (wf_increment)"));
  const RecordedFile short_tdms = parse_tdms(bytes("cut.tdms"), "cut");
  ASSERT_EQ(short_tdms.doubts.size(), 2u);
  EXPECT_THAT(short_tdms.doubts[0], HasSubstr("states 334 bytes and has 329"));
  const RecordedFile described = parse_tdms(bytes("cut_description.tdms"), "cut");
  ASSERT_EQ(described.doubts.size(), 2u);
  EXPECT_THAT(described.doubts[1], HasSubstr("within the description of its last segment"));
  const RecordedFile history = parse_rpc(bytes("cut.rsp"), "cut");
  ASSERT_EQ(history.doubts.size(), 1u);
  EXPECT_THAT(history.doubts[0], HasSubstr("it has 2 of 3 groups of 16 samples"));
}

TEST_F(WrittenRecordings, OfRigsSayWhatFillsUpTheLastGroup) {
  const RecordedFile filled = parse_rpc(bytes("integers.rsp"), "filled");
  ASSERT_EQ(filled.doubts.size(), 1u);
  EXPECT_THAT(filled.doubts[0], HasSubstr("0 in the last 3 samples"));
  EXPECT_TRUE(parse_rpc(bytes("no_filling.rsp"), "whole").doubts.empty());
  EXPECT_TRUE(parse_rpc(bytes("stated_samples.rsp"), "stated").doubts.empty());
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

using RecordedParser = RecordedFile (*)(std::string_view, std::string);

/// Returns the message for bytes that must be refused.
std::string refusal_of(const std::string& bytes, RecordedParser parse) {
  try {
    parse(bytes, "spoiled");
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
  EXPECT_THAT(refusal_of(with_number(plain, data + 8, std::uint64_t{1} << 63), parse_mdf),
              HasSubstr("states a length of 9223372036854775808 bytes"));
  EXPECT_THAT(refusal_of(with_number(plain, group + 24, group), parse_mdf),
              HasSubstr("is linked twice"));
  EXPECT_THAT(refusal_of(with_number(plain, channel + 24, channel), parse_mdf),
              HasSubstr("is linked twice"));
  EXPECT_THAT(refusal_of(with_number(plain, channels + 72 + 8, std::uint64_t{1} << 63), parse_mdf),
              HasSubstr("expected 9223372036854775808: is the file cut off?"));
  EXPECT_THAT(refusal_of(with_number(plain, channels + 72 + 24, 0), parse_mdf),
              HasSubstr("has group \"rig\" with a record size of 0"));
  EXPECT_THAT(refusal_of(with_number(bytes("rules.mf4"), rule + 8, 1), parse_mdf),
              HasSubstr("states a length of 1 bytes"));
  EXPECT_THAT(refusal_of(plain.substr(0, data + 100), parse_mdf), HasSubstr("links to byte"));
  std::string old = plain;
  old[28] = 'J', old[29] = 1;  // 330
  EXPECT_EQ(refusal_of(old, parse_mdf),
            "spoiled: is MDF 3.30, expected 4.0 to 4.2: convert it with the program that recorded "
            "it");
}

TEST_F(WrittenRecordings, ThatUnpackToMoreThanTheyStateAreRefused) {
  const std::string deflated = bytes("deflated.mdf");
  const std::size_t block = deflated.find("##DZ") + 24;
  EXPECT_THAT(refusal_of(with_number(deflated, block + 8, 100), parse_mdf),
              HasSubstr("expected 100 and no more"));
  EXPECT_THAT(refusal_of(with_number(deflated, block + 8, std::uint64_t{1} << 40), parse_mdf),
              HasSubstr("larger than 1 GiB when unpacked"));
  EXPECT_THAT(refusal_of(with_number(deflated, block + 16, std::uint64_t{1} << 40), parse_mdf),
              HasSubstr("packed bytes where"));
}

TEST_F(WrittenRecordings, OfBrokenTextAreRefusedWithTheLine) {
  std::string text = bytes("text_2_even.uff");
  const std::size_t number = text.rfind("-1.75000e+00");
  text.replace(number, 5, "abcde");
  EXPECT_THAT(refusal_of(text, parse_uff), HasSubstr("spoiled:34: is "));
  const std::string binary = bytes("binary_4_even_1.uff");
  EXPECT_THAT(refusal_of(binary.substr(0, binary.size() - 30), parse_uff), HasSubstr("cut off"));
  // The head ends with the file, without a line end, and states no sample.
  std::string head = binary.substr(0, binary.find("a line more") - 1);
  head.replace(head.find("         4         7"), 19, "         4         0");
  EXPECT_THAT(refusal_of(head, parse_uff), HasSubstr("spoiled:"));
}

TEST_F(WrittenRecordings, OfTdmsWithWrongLengthsAreRefusedInWords) {
  const std::string plain = bytes("segments_little.tdms");
  const std::size_t second = plain.find("TDSm", 4);
  EXPECT_THAT(refusal_of(with_number(plain, 12, std::uint64_t{1} << 63), parse_tdms),
              HasSubstr("states a length of 9223372036854775808 bytes where"));
  EXPECT_THAT(refusal_of(with_number(plain, 20, std::uint64_t{1} << 63), parse_tdms),
              HasSubstr("segment at byte 0 has raw data behind its end"));
  EXPECT_THAT(refusal_of(with_number(plain, second + 12, 3), parse_tdms),
              HasSubstr("expected \"TDSm\""));
  std::string other = plain;
  other[4] = static_cast<char>(other[4] | 0x80);
  EXPECT_THAT(refusal_of(other, parse_tdms), HasSubstr("has raw data of DAQmx"));
  other = plain;
  other[3] = 'h';
  EXPECT_THAT(refusal_of(other, parse_tdms), HasSubstr("this is an index without numbers"));
  other = plain;
  other[8] = 1;
  EXPECT_THAT(refusal_of(other, parse_tdms), HasSubstr("is of version"));
  const std::size_t count = plain.find("/'hub'/'Fz'") + 11 + 12;
  EXPECT_THAT(refusal_of(with_number(plain, count, std::uint64_t{1} << 63), parse_tdms),
              HasSubstr("states 9223372036854775808 values of \"Fz\""));
  EXPECT_THAT(refusal_of(plain.substr(second), parse_tdms),
              HasSubstr("but no channel with values"));
  EXPECT_THAT(refusal_of("", parse_tdms), HasSubstr("is empty"));
}

TEST(TdmsPath, HasQuotesWrittenTwice) {
  EXPECT_EQ(tdms_names("/'Dr. T''s'/'a/b'"), (std::vector<std::string>{"Dr. T's", "a/b"}));
  EXPECT_EQ(tdms_names("/"), std::vector<std::string>{});
  EXPECT_EQ(tdms_names("/'open"), std::nullopt);
  EXPECT_EQ(tdms_names("/'a'/'b'/'c'"), std::nullopt);
}

/// Returns the bytes with the value of a keyword of an RPC III header replaced.
std::string with_value(std::string bytes, const std::string& keyword, const std::string& value) {
  const std::size_t at = bytes.find(keyword + std::string(1, '\0'));
  return bytes.replace(at + 32, 96, value + std::string(96 - value.size(), '\0'));
}

TEST_F(WrittenRecordings, OfRpcThatAreNoPlainHistoryAreRefusedByName) {
  const std::string plain = bytes("integers.rsp");
  const auto refusal = [&](const char* keyword, const char* value) {
    return refusal_of(with_value(plain, keyword, value), parse_rpc);
  };
  EXPECT_THAT(refusal("FORMAT", "ASCII"), HasSubstr("has FORMAT = \"ASCII\", expected BINARY"));
  EXPECT_THAT(refusal("FILE_TYPE", "MATRIX"), HasSubstr("expected TIME_HISTORY"));
  EXPECT_THAT(refusal("TIME_TYPE", "MULT_DRIVE"), HasSubstr("expected DRIVE or RESPONSE"));
  EXPECT_THAT(refusal("HALF_FRAMES", "1"), HasSubstr("write the history without half frames"));
  EXPECT_THAT(refusal("DATA_TYPE", "LONG"), HasSubstr("expected SHORT_INTEGER or FLOATING_POINT"));
  EXPECT_THAT(refusal("DELTA_T", "0"), HasSubstr("expected a time above 0 s"));
  EXPECT_THAT(refusal("PTS_PER_GROUP", "9"), HasSubstr("expected a multiple of a frame's 4"));
  EXPECT_THAT(refusal("PTS_PER_FRAME", "0"), HasSubstr("PTS_PER_FRAME = \"0\", expected a number"));
  EXPECT_THAT(refusal("NUM_HEADER_BLOCKS", "1000"), HasSubstr("states 1000 header blocks"));
  EXPECT_THAT(refusal("SCALE.CHAN_2", "much"), HasSubstr("has SCALE.CHAN_2 = \"much\""));
  EXPECT_THAT(refusal("CHANNELS", "9e18"), HasSubstr("has CHANNELS = \"9e18\""));
  EXPECT_THAT(refusal_of("FORMAL", parse_rpc), HasSubstr("expected a header block of 512"));
}

TEST_F(WrittenRecordings, OfMotecWhoseChainReturnsAreRefused) {
  const std::string plain = bytes("log.ld");
  std::uint32_t first = 0;
  std::memcpy(&first, plain.data() + 8, sizeof(first));
  std::string looped = plain;
  std::memcpy(looped.data() + first + 4, &first, sizeof(first));
  EXPECT_THAT(refusal_of(looped, parse_motec), HasSubstr("is linked twice"));
  EXPECT_THAT(refusal_of(plain.substr(0, first + 20), parse_motec),
              HasSubstr("is behind the end of the file"));
  EXPECT_THAT(refusal_of(plain.substr(8), parse_motec),
              HasSubstr("expected the header of a MoTeC"));
  EXPECT_THAT(parse_motec(plain, "log").doubts.back(), HasSubstr("has no public text"));
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
