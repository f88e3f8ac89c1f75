// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/tydex_writer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "base/units.h"
#include "formats/tables/tydex_file.h"

namespace latsch::formats {
namespace {

const std::filesystem::path kMeasuredTydex = LATSCH_SOURCE_DIR "/../shared/data/tdx";
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
// Half a unit of the last of seven digits, which nine characters hold beside sign and point.
constexpr double kHalfOfSeventhDigit = 0.5e-6;

/// A sweep of 50 samples, in which every number has all digits of a double.
TydexRecord sweep_record() {
  TydexRecord record;
  record.measurement = "sweep_1";
  record.supplier = "Latsch";
  record.date = "2026-01-31";
  record.comments = {"a sweep"};
  Channel time{"time", "s", {}}, alpha{"alpha", "rad", {}}, Fx{"Fx", "N", {}}, Fy{"Fy", "N", {}};
  Channel Mz{"Mz", "N m", {}}, belt{"belt_temperature", "K", {}};
  for (int i = 0; i < 50; ++i) {
    const double t = i / 7.0;
    time.values.push_back(t);
    alpha.values.push_back(0.1 * std::sin(t));
    Fx.values.push_back(-23.0 + 1e-5 * std::cos(t));
    Fy.values.push_back(-4321.0 * std::sin(t));
    Mz.values.push_back(87.6 * std::sin(1.1 * t));
    belt.values.push_back(300.0 + t);
  }
  Mz.values[7] = kUnknown;
  for (Channel* channel : {&time, &alpha, &Fx, &Fy, &Mz, &belt}) record.channels.add(*channel);
  record.frames = {"", "", "W", "W", "W", ""};
  return record;
}

const WrittenTydex::Name& named(const WrittenTydex& written, const std::string& channel) {
  for (const auto& name : written.names)
    if (name.channel == channel) return name;
  throw std::out_of_range(channel);
}

void expect_same_numbers(const std::vector<double>& read, const std::vector<double>& written) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (std::isnan(written[i])) {
      EXPECT_TRUE(std::isnan(read[i])) << i;
    } else {
      EXPECT_EQ(read[i], written[i]) << i;
    }
  }
}

TEST(TydexWriter, AllDigitsGiveTheBitsBack) {
  const TydexRecord record = sweep_record();
  const WrittenTydex written = tydex_text(record, TydexDigits::all);
  EXPECT_EQ(written.rounding, 0.0);
  const TydexFile read = TydexFile::parse(written.text, "sweep.tdx");
  ASSERT_EQ(read.channels.all().size(), record.channels.all().size());
  for (const Channel& channel : record.channels.all())
    expect_same_numbers(read.channels[named(written, channel.name).tydex], channel.values);
  EXPECT_EQ(read.find("MEASID")->text, "sweep_1");
  EXPECT_EQ(read.find("DATE")->text, "2026-01-31");
}

// The names are those of the manual for the axes W; FX is the longitudinal force there.
TEST(TydexWriter, NamesStateTheAxesOfAForce) {
  TydexRecord record = sweep_record();
  const auto name_in = [&](const std::string& frame, const std::string& channel) {
    record.frames = {"", "", frame, frame, frame, ""};
    return named(tydex_text(record, TydexDigits::columns_of_ten), channel);
  };
  EXPECT_EQ(name_in("W", "Fx").tydex, "FX");
  EXPECT_EQ(name_in("W", "Fy").tydex, "FYW");
  EXPECT_EQ(name_in("H", "Fx").tydex, "FXH");
  EXPECT_EQ(name_in("C", "Mz").tydex, "MZC");
  EXPECT_EQ(name_in("W", "alpha").tydex, "SLIPANGL");
  EXPECT_EQ(name_in("W", "time").tydex, "RUNTIME");
  // A force whose frame is not known must not get a name that states one.
  EXPECT_FALSE(name_in("", "Fx").is_defined);
  EXPECT_EQ(find_tydex_name(name_in("", "Fx").tydex), nullptr);
  const auto belt = name_in("W", "belt_temperature");
  EXPECT_FALSE(belt.is_defined);
  EXPECT_EQ(belt.tydex, "BELTTEMP");
}

TEST(TydexWriter, ColumnsOfTenRoundToTheirNineCharacters) {
  const TydexRecord record = sweep_record();
  const WrittenTydex written = tydex_text(record, TydexDigits::columns_of_ten);
  EXPECT_GT(written.rounding, 0.0);
  EXPECT_LE(written.rounding, kHalfOfSeventhDigit);
  const TydexFile read = TydexFile::parse(written.text, "sweep.tdx");
  for (const Channel& channel : record.channels.all()) {
    double largest = 0.0, error = 0.0;
    const auto& values = read.channels[named(written, channel.name).tydex];
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isnan(channel.values[i])) continue;
      largest = std::max(largest, std::abs(channel.values[i]));
      error = std::max(error, std::abs(channel.values[i] - values[i]));
    }
    EXPECT_LE(error, written.rounding * largest * (1.0 + 1e-12)) << channel.name;
  }
}

TEST(TydexWriter, NineCharactersAreTheClosestOnes) {
  EXPECT_EQ(nine_characters(1.0 / 3.0), "0.3333333");
  EXPECT_EQ(nine_characters(-1234.56789), "-1234.568");
  EXPECT_EQ(nine_characters(123456789.4), "123456789");
  EXPECT_EQ(nine_characters(1234567890.0), "1.23457e9");
  EXPECT_EQ(nine_characters(-1.23456e-10), "-1.23e-10");
  EXPECT_EQ(nine_characters(1.23456e-5), "1.2346e-5");
  EXPECT_EQ(nine_characters(0.000123456789), "1.2346e-4");
  EXPECT_EQ(nine_characters(-1.5e300), "-1.5e+300");
  EXPECT_EQ(nine_characters(-1.23456e300), "-1.23e300");
  EXPECT_EQ(nine_characters(0.0), "0");
  EXPECT_EQ(nine_characters(10.0), "10");
  EXPECT_EQ(nine_characters(-0.125), "-0.125");
}

// DSTGRWHC is a height, the loaded radius a length in the wheel plane: height = R_l cos gamma.
TEST(TydexWriter, TheLoadedRadiusBecomesTheHeightOfTheCenter) {
  TydexRecord record;
  record.channels.add({"loaded_radius", "m", {0.31, 0.31}});
  WrittenTydex written = tydex_text(record, TydexDigits::all);
  EXPECT_EQ(written.names.front().tydex, "RL");
  record.channels.add({"gamma", "rad", {0.0, std::numbers::pi / 3.0}});
  written = tydex_text(record, TydexDigits::all);
  const TydexFile read = TydexFile::parse(written.text, "radius.tdx");
  EXPECT_EQ(read.channels["DSTGRWHC"][0], 0.31);
  EXPECT_NEAR(read.channels["DSTGRWHC"][1], 0.155, 1e-15);
}

TEST(TydexWriter, SingleValuesAreConstantsAndShortChannelsEndInGaps) {
  TydexRecord record;
  record.channels.add({"time", "s", {0.0, 1.0, 2.0}});
  record.channels.add({"dz_by_Fz", "m/N", {5e-6}});
  record.channels.add({"note", "1", {1.0, 2.0}});
  const TydexFile read = TydexFile::parse(tydex_text(record, TydexDigits::all).text, "a.tdx");
  EXPECT_EQ(*read.find("DZBYFZ")->number, 5e-6);
  EXPECT_EQ(read.find("DZBYFZ")->comment, "dz_by_Fz");
  expect_same_numbers(read.channels["NOTE"], {1.0, 2.0, kUnknown});
}

TEST(TydexWriter, RefusesWhatTheFormatCannotExpress) {
  TydexRecord record;
  EXPECT_THROW(tydex_text(record, TydexDigits::all), InputError);
  record.channels.add({"Fz", "N", {std::numeric_limits<double>::infinity()}});
  EXPECT_THROW(tydex_text(record, TydexDigits::all), InputError);
  TydexRecord wide;
  wide.channels.add({"time", "s", {0.0}});
  wide.channels.add({"odd", "kg^2 m^3 s^-4", {0.0}});
  EXPECT_EQ(tydex_text(wide, TydexDigits::all).left_out,
            (std::vector<std::string>{"odd [kg^2 m^3 s^-4]"}));
}

// Two channels with the first eight letters in common, and names that the format would misread.
TEST(TydexWriter, NamesAreUniqueAndWithinTheirColumns) {
  TydexRecord record;
  record.channels.add({"temperature_1", "K", {1.0}});
  record.channels.add({"temperature_2", "K", {2.0}});
  record.channels.add({"**END", "1", {3.0}});
  record.channels.add({"speed", "m/s", {4.0}});
  record.channels.add({"Vx", "m/s", {5.0}});
  record.comments = {"**END", "two\nlines"};
  const WrittenTydex written = tydex_text(record, TydexDigits::all);
  const TydexFile read = TydexFile::parse(written.text, "names.tdx");
  ASSERT_EQ(read.channels.all().size(), 5u);
  EXPECT_EQ(read.channels["TEMPERAT"][0], 1.0);
  EXPECT_EQ(read.channels["TEMPERA2"][0], 2.0);
  EXPECT_EQ(read.channels["END"][0], 3.0);
  EXPECT_EQ(read.channels["LONGVEL"][0], 4.0);
  EXPECT_EQ(read.channels["VX"][0], 5.0);
  EXPECT_EQ(read.comments, (std::vector<std::string>{"**END", "two lines"}));
}

/// A reader that shares no code with ours: it cuts every line at the columns of the format.
constexpr const char* kColumnReader = R"(
import sys
def fields(line):
    return [line[:10].strip(), line[10:40].strip(), line[40:50].strip(), line[50:].split()]
section, channels, rows, constants = None, [], [], {}
for line in open(sys.argv[1], encoding="utf-8").read().split("\n"):
    if line.startswith("**"):
        section = line.strip()
        continue
    if line.startswith("!") or not line.strip():
        continue
    if section in ("**HEADER", "**CONSTANTS"):
        name, comment, unit, value = fields(line)
        assert name and len(name) <= 8 and line[8:10] == "  ", line
        constants[name] = " ".join(value)
    elif section == "**MEASURCHANNELS":
        name, comment, unit, numbers = fields(line)
        assert len(name) <= 8 and len(numbers) == 3 and len(unit) < 10, line
        factor, measured, physical = (float(line[50 + 10 * i:60 + 10 * i]) for i in range(3))
        assert (factor, measured, physical) == (1.0, 0.0, 0.0)
        channels.append(name)
    elif section == "**MEASURDATA":
        cells = [line[10 * i:10 * i + 10].strip() for i in range(len(channels))]
        assert len(line) <= 10 * len(channels) and all(cells), line
        assert line.split() == cells, "blanks and columns of ten must agree"
        rows.append([float("nan") if c == "NOTAVAIL" else float(c) for c in cells])
assert section == "**END" and constants["RELEASE"] == "1.3"
print(" ".join(channels))
for row in rows:
    print(" ".join(repr(number) for number in row))
)";

TEST(TydexWriter, AnIndependentReaderFindsTheColumnsOfTheFormat) {
  const ScratchFolder folder;
  const WrittenTydex written = tydex_text(sweep_record(), TydexDigits::columns_of_ten);
  write_text_file(folder.path() / "sweep.tdx", written.text);
  write_text_file(folder.path() / "reader.py", kColumnReader);
  const std::string command =
      fmt::format("cd '{}' && python3 reader.py sweep.tdx > numbers 2>&1", folder.path().string());
  const int code = std::system(command.c_str());
  const std::string printed = read_text_file(folder.path() / "numbers");
  ASSERT_EQ(code, 0) << printed;
  std::string expected = "RUNTIME SLIPANGL FX FYW MZW BELTTEMP\n";
  ASSERT_EQ(printed.substr(0, expected.size()), expected);
  // The numbers that Python prints are those that our reader returns, in the units of the file.
  const TydexFile read = TydexFile::parse(written.text, "sweep.tdx");
  std::size_t at = expected.size();
  for (std::size_t row = 0; row < read.lines.size(); ++row)
    for (const Channel& channel : read.channels.all()) {
      char* end = nullptr;
      const double number = std::strtod(printed.c_str() + at, &end);
      at = static_cast<std::size_t>(end - printed.c_str());
      if (!std::isnan(channel.values[row])) {
        const Unit unit = Unit::of(channel.name == "SLIPANGL" ? "deg" : channel.unit);
        ASSERT_DOUBLE_EQ(unit.to_si(number), channel.values[row]) << channel.name << row;
      } else {
        ASSERT_TRUE(std::isnan(number));
      }
    }
}

// Recordings of a tire test consortium: read, written in their own units, read again.
TEST(TydexWriter, AMeasuredFileKeepsItsNumbers) {
  if (!std::filesystem::exists(kMeasuredTydex))
    GTEST_SKIP() << "the measured files are not part of this copy";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kMeasuredTydex)) {
    if (entry.path().extension() != ".tdx") continue;
    ++files;
    const TydexFile measured = TydexFile::read(entry.path());
    TydexRecord record;
    record.channels = measured.channels;
    for (const auto& about : measured.descriptions) record.units.push_back(about.unit);
    for (std::string& unit : record.units)
      if (unit == "Nm") unit = "N m";
    for (const auto& c : measured.constants)
      record.constants.push_back({c.name, c.comment, c.unit, c.text});
    for (const TydexDigits digits : {TydexDigits::columns_of_ten, TydexDigits::all}) {
      const WrittenTydex written = tydex_text(record, digits);
      EXPECT_EQ(written.rounding, 0.0) << written.rounded;
      const TydexFile again = TydexFile::parse(written.text, "again.tdx");
      EXPECT_EQ(again.channels.all(), measured.channels.all()) << entry.path();
      for (const auto& c : measured.constants) {
        ASSERT_TRUE(again.find(c.name)) << c.name;
        EXPECT_EQ(again.find(c.name)->text, c.text);
        EXPECT_EQ(again.find(c.name)->number, c.number);
      }
    }
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace latsch::formats
