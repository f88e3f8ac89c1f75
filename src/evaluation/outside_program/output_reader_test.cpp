// SPDX-License-Identifier: Apache-2.0
#include "evaluation/outside_program/output_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "base/unit_words/unit_spellings_testing.h"
#include "base/units.h"

namespace latsch {
namespace {

using Kind = OutputReader::Kind;

Result<std::vector<Channel>> read(OutputReader reader, const std::string& text) {
  const ScratchFolder folder;
  reader.name = "out";
  reader.file = "file";
  std::ofstream(folder / "file", std::ios::binary) << text;
  return read_output(reader, folder.path());
}

void expect_failure(const OutputReader& reader, const std::string& text, const std::string& part) {
  const auto result = read(reader, text);
  ASSERT_FALSE(result.ok()) << part;
  EXPECT_NE(result.failure().reason.find(part), std::string::npos) << result.failure().reason;
  EXPECT_EQ(result.failure().cause, Cause::bad_output);
}

TEST(OutputReader, TableHasItsUnitsInTheFile) {
  const OutputReader reader{.kind = Kind::table, .quantities = {{"z", "m"}}};
  const auto channels = read(reader, "time [s],z [mm]\n0,1\n1,2\n");
  ASSERT_TRUE(channels.ok()) << channels.failure().reason;
  EXPECT_EQ(channels->front().values, (std::vector<double>{1e-3, 2e-3}));
  expect_failure(reader, "time [s],y [mm]\n0,1\n", "z");
  expect_failure(reader, "time [s],z [kg]\n0,1\n", "kg");
  expect_failure(reader, "", "output \"out\" (table)");
}

// Every spelling of the table of units is read with the factor stated in the table, or gives a
// failure that names unit and line.
TEST(OutputReader, UnitsOfTablesAreThoseOfAllReaders) {
  int count = 0;
  for (const UnitSpelling& spelling : unit_spellings::kAll) {
    const std::string unit = spelling.written;
    const OutputReader reader{.kind = Kind::table, .quantities = {{"z", spelling.si}}};
    const auto channels = read(reader,
                               "\"z [" +
                                   (unit == "\""            ? "\"\""
                                    : unit.starts_with('[') ? unit.substr(1)
                                                            : unit) +
                                   (unit.starts_with('[') ? "" : "]") + "\"\n7\n");
    if (!channels.ok()) {
      EXPECT_TRUE(std::isnan(spelling.factor)) << channels.failure().reason;
      EXPECT_NE(channels.failure().reason.find("file:1: column \"z\""), std::string::npos)
          << channels.failure().reason;
      continue;
    }
    ASSERT_FALSE(std::isnan(spelling.factor)) << unit;
    EXPECT_NEAR(channels->front().values[0] / (7.0 * spelling.factor + spelling.offset), 1.0, 1e-12)
        << unit;
    ++count;
  }
  EXPECT_GT(count, 400);
}

TEST(OutputReader, ColumnsSkipTheirHeader) {
  const OutputReader reader{
      .kind = Kind::columns, .quantities = {{"t", "s"}, {"f", "kN"}}, .columns = {1, 3}};
  const auto channels = read(reader, "some solver 1.0\n t  x  F\r\n\r\n0 9 1\n 0.5;9;2\n");
  ASSERT_TRUE(channels.ok()) << channels.failure().reason;
  EXPECT_EQ((*channels)[0].values, (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ((*channels)[1].values, (std::vector<double>{1e3, 2e3}));
  EXPECT_EQ((*channels)[1].name, "out/f");
  EXPECT_EQ((*channels)[1].unit, "N");
  expect_failure(reader, "0 9 1\n1 9\n", "file:2 is \"1 9\", expected numbers in columns 1, 3");
  expect_failure(reader, "0 9 inf\n", "expected a finite number");
  expect_failure(reader, "nothing\n", "holds no value of t");
}

TEST(OutputReader, ColumnsRefuseDecimalCommas) {
  const OutputReader reader{
      .kind = Kind::columns, .quantities = {{"t", "s"}, {"f", "N"}}, .columns = {1, 2}};
  for (const char* row : {"10,0 2500,5\n", "10,0;2500,5\n", "10,0\t2500,5\n", "1 2,5e3\n"})
    expect_failure(reader, row, "where the comma may be a decimal point");
  for (const char* row : {"10,2500\n", "10, 2500\n", "10.0,2500.5 7\n"})
    EXPECT_TRUE(read(reader, row).ok()) << row;
  // A line that is "10,5" alone is one number or two; a header with commas decides.
  const OutputReader first{.kind = Kind::columns, .quantities = {{"u", "mm"}}, .columns = {1}};
  expect_failure(first, "10,5\n11,5\n", "has \"10,5\", where the comma may be a decimal point");
  EXPECT_TRUE(read(first, "u,F\n10,5\n11,5\n").ok());
}

TEST(OutputReader, TydexGivesChannelsAndConstantsByName) {
  const std::string file =
      "**HEADER\n**CONSTANTS\nINFLPRES                                bar       2.5\n"
      "**MEASURCHANNELS\nRUNTIME                                 s         1         0         0\n"
      "FYW                                     kN        1         0         0\n"
      "**MEASURDATA\n0         -1.5\n1         NOTAVAIL\n**END\n";
  OutputReader reader{.kind = Kind::tydex, .quantities = {{"RUNTIME", "s"}, {"INFLPRES", "bar"}}};
  const auto channels = read(reader, file);
  ASSERT_TRUE(channels.ok()) << channels.failure().reason;
  EXPECT_EQ((*channels)[0].name, "out/RUNTIME");
  EXPECT_EQ((*channels)[0].values, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ((*channels)[1].values, (std::vector<double>{2.5e5}));
  EXPECT_EQ((*channels)[1].unit, "Pa");
  expect_failure({.kind = Kind::tydex, .quantities = {{"FYW", "N"}}}, file, "file:9 has no number");
  expect_failure({.kind = Kind::tydex, .quantities = {{"FYW", "m"}}}, file, "FYW in N");
  expect_failure({.kind = Kind::tydex, .quantities = {{"FZW", "N"}}}, file, "FZW");
  expect_failure(reader, file.substr(0, file.find("**END")), "output \"out\" (tydex)");
}

TEST(OutputReader, PatternTakesEveryLineBehindTheMark) {
  OutputReader reader{.kind = Kind::pattern, .quantities = {{"u", "mm"}}};
  reader.pattern = R"(^\s*\d+\s+(\S+)$)";
  reader.after = "displacements";
  const auto channels = read(reader, " 1 99\n displacements for set A\n\n 1 -2.5\n 2 3.5\n");
  ASSERT_TRUE(channels.ok()) << channels.failure().reason;
  EXPECT_EQ(channels->front().values, (std::vector<double>{-2.5e-3, 3.5e-3}));
  expect_failure(reader, " 1 99\n", "has no line with \"displacements\"");
  expect_failure(reader, "displacements\n 1 x\n", "file:2 has \"x\" for u, expected a number");
  reader.samples = 3;
  expect_failure(reader, "displacements\n 1 1\n 2 2\n", "holds 2 values of u, expected 3");
}

// Whatever bytes a program writes, reading them gives channels of finite numbers or a failure.
TEST(OutputReader, NoBytesBreakIt) {
  OutputReader pattern{.kind = Kind::pattern, .quantities = {{"u"}}};
  pattern.pattern = R"((\S+)\s*$)";
  const std::vector<OutputReader> readers{
      {.kind = Kind::table, .quantities = {{"u"}}},
      {.kind = Kind::columns, .quantities = {{"u"}}, .columns = {2}},
      {.kind = Kind::keys, .quantities = {{"u"}}, .keys = {"u"}},
      pattern};
  for (std::uint64_t i = 0; i < 200; ++i) {
    RandomStream random(9, i);
    std::string text = i % 2 ? "u = 1\n2, 3\n" : "";
    for (std::uint64_t n = random.below(3000); n > 0; --n) {
      text += i % 3 ? "0123456789.eE+-naif ,;=:\n\r\t\"u"[random.below(30)]
                    : static_cast<char>(random.below(256));
    }
    for (const OutputReader& reader : readers) {
      const auto channels = read(reader, text);
      if (!channels) continue;
      for (const double value : channels->front().values) EXPECT_TRUE(std::isfinite(value));
    }
  }
}

}  // namespace
}  // namespace latsch
