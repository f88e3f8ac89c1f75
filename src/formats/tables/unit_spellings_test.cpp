// SPDX-License-Identifier: Apache-2.0
// Every spelling in the table of units is read by every reader of tables. The result must be the
// expected number, or an error that names the unit, the file and the line, and all readers must
// agree.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "base/text.h"
#include "base/unit_reading.h"
#include "base/unit_words/unit_spellings_testing.h"
#include "formats/tables/csv_table.h"
#include "formats/tables/lab_table.h"
#include "formats/tables/mat_file.h"
#include "formats/tables/measurement_file.h"
#include "formats/tables/recording.h"
#include "formats/tables/tydex_file.h"
#include "formats/text/teim_orbit.h"

namespace latsch::formats {
namespace {

constexpr double kWritten = 7.0;

/// Result of reading a column whose value is written as 7: the SI unit and the converted value.
struct Found {
  std::string unit;
  double si = 0.0;
};
using Reader = std::function<Found(const UnitSpelling&)>;

std::string quoted(const std::string& text) {
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

/// Returns a title "value [kPa]"; a unit that already has brackets gets no others.
std::string title(const UnitSpelling& spelling, const std::string& name = "value") {
  const std::string unit = spelling.written;
  return quoted(name + " " + (unit.starts_with('[') ? unit : "[" + unit + "]"));
}

/// `knows_dimension` is true for readers that know which quantity the column holds, so that they
/// must report a wrong dimension.
void expect_the_number_by_hand(const UnitSpelling& spelling,
                               const Reader& reader,
                               bool knows_dimension,
                               const std::string& where) {
  Found found;
  try {
    found = reader(spelling);
  } catch (const InputError& error) {
    const std::string words = error.what();
    // A reader that does not know the dimension of a column refuses a unit with two meanings.
    const bool needs_dimension = !knows_dimension && words.find("which may be") != words.npos;
    EXPECT_TRUE(std::isnan(spelling.factor) || needs_dimension) << words;
    EXPECT_NE(words.find(where), words.npos) << words;
    EXPECT_NE(words.find(in_quotes(spelling.written)), words.npos) << words;
    return;
  }
  // A column of unknown meaning is read; code that uses the column compares its dimension later.
  const bool is_refused_later =
      !knows_dimension && !Unit::of(found.unit).same_dimension(Unit::of(spelling.si));
  if (is_refused_later) return;
  ASSERT_FALSE(std::isnan(spelling.factor))
      << spelling.written << " for " << spelling.si << " is read as " << found.si;
  EXPECT_NEAR(found.si / (kWritten * spelling.factor + spelling.offset), 1.0, 1e-12)
      << spelling.written;
}

void go_through(const Reader& reader, bool knows_dimension, const std::string& where) {
  for (const UnitSpelling& spelling : unit_spellings::kAll)
    expect_the_number_by_hand(spelling, reader, knows_dimension, where);
}

/// Returns the number of spellings that a reader accepts. A reader that refuses all of them would
/// otherwise pass the test.
int count_read(const Reader& reader) {
  int count = 0;
  for (const UnitSpelling& spelling : unit_spellings::kAll) {
    try {
      const Found found = reader(spelling);
      count += Unit::of(found.unit).same_dimension(Unit::of(spelling.si)) ? 1 : 0;
    } catch (const InputError&) {
    }
  }
  return count;
}

class UnitSpellings : public testing::Test {
 protected:
  LabTable lab(const std::string& name, const std::string& text, const UnitSpelling& spelling) {
    write_text_file(folder_ / name, text);
    return read_lab_table(folder_ / name, {}, [&](const std::string&) { return spelling.si; });
  }
  static Found first(const Channels& channels) {
    return {channels.all().front().unit, channels.all().front().values.front()};
  }

  ScratchFolder folder_;
};

TEST_F(UnitSpellings, InTheHeaderOfACsv) {
  const Reader reader = [](const UnitSpelling& spelling) {
    const auto table = CsvTable::parse(title(spelling) + "\n7\n", "t.csv");
    return Found{spelling.si, table.numbers("value", spelling.si)[0]};
  };
  go_through(reader, true, "t.csv:1: column \"value\"");
  EXPECT_GT(count_read(reader), 400);
}

TEST_F(UnitSpellings, InTheLineOfUnitsOfACsv) {
  const Reader reader = [](const UnitSpelling& spelling) {
    const auto table =
        CsvTable::parse("value;force\n" + quoted(spelling.written) + ";kN\n7;1\n", "t.csv");
    return Found{spelling.si, table.numbers("value", spelling.si)[0]};
  };
  go_through(reader, true, "t.csv:2: column \"value\"");
  EXPECT_GT(count_read(reader), 400);
}

TEST_F(UnitSpellings, InARecording) {
  const Reader reader = [](const UnitSpelling& spelling) {
    return first(parse_recording(title(spelling) + "\n7\n", "t.csv"));
  };
  go_through(reader, false, "t.csv:1: column \"value\"");
  EXPECT_GT(count_read(reader), 400);
}

TEST_F(UnitSpellings, InACsvOfALaboratory) {
  const Reader reader = [&](const UnitSpelling& spelling) {
    return first(lab("t.csv", title(spelling) + "\n7\n", spelling).channels);
  };
  go_through(reader, true, "t.csv:1: column \"value\"");
  EXPECT_GT(count_read(reader), 400);
}

TEST_F(UnitSpellings, InADatOfAConsortium) {
  for (const UnitSpelling& spelling : unit_spellings::kAll)
    expect_the_number_by_hand(
        spelling,
        [&](const UnitSpelling& one) {
          write_text_file(folder_ / "t.dat",
                          "run 4\nvalue\tFZ\n" + std::string(one.written) + "\tN\n7\t1\n");
          const auto expected = [&](const std::string& name) {
            return name == "value" ? std::string(one.si) : std::string("N");
          };
          return first(read_lab_table(folder_ / "t.dat", {}, expected).channels);
        },
        true,
        "t.dat:3: column \"value\"");
}

TEST_F(UnitSpellings, InATydexChannel) {
  constexpr std::size_t kColumnsOfUnit = 10;
  const auto name_of = [](const std::string& si) {
    for (const auto& [name, unit] :
         std::vector<std::pair<std::string, std::string>>{{"FZW", "N"},
                                                          {"MZW", "N m"},
                                                          {"SLIPANGL", "rad"},
                                                          {"INFLPRES", "Pa"},
                                                          {"LONGVEL", "m/s"},
                                                          {"WHROTSPD", "rad/s"},
                                                          {"TRCKTEMP", "K"},
                                                          {"RUNTIME", "s"},
                                                          {"DSTGRWHC", "m"},
                                                          {"LONGSLIP", "1"}})
      if (unit == si) return name;
    return std::string("OWN");
  };
  int read = 0;
  for (const UnitSpelling& spelling : unit_spellings::kAll) {
    const std::string unit = spelling.written, name = name_of(spelling.si);
    std::size_t characters = 0;
    for (const char c : unit) characters += (c & 0xc0) != 0x80 ? 1 : 0;
    if (characters > kColumnsOfUnit) continue;
    ++read;
    const std::string text = "**HEADER\n**MEASURCHANNELS\n" + name +
                             std::string(40 - name.size(), ' ') + unit +
                             std::string(kColumnsOfUnit - characters, ' ') +
                             "1         0         0\n**MEASURDATA\n7\n**END\n";
    expect_the_number_by_hand(
        spelling,
        [&](const UnitSpelling&) { return first(TydexFile::parse(text, "t.tdx").channels); },
        name != "OWN",
        "t.tdx:3: " + name);
  }
  EXPECT_GT(read, 400);
}

TEST_F(UnitSpellings, InAStructOfAMatFile) {
  const auto file_with = [](const UnitSpelling& spelling) {
    MatFile file;
    file.file = "t.mat";
    file.variables.push_back({"value.data", {2, 1}, {kWritten, kWritten}, "", false});
    file.variables.push_back({"value.unit", {1, 1}, {}, spelling.written, true});
    return file;
  };
  const Reader told = [&](const UnitSpelling& spelling) {
    return first(file_with(spelling)
                     .named_channels({}, [&](const std::string&) { return spelling.si; })
                     .channels);
  };
  const Reader untold = [&](const UnitSpelling& spelling) {
    return first(file_with(spelling).channels());
  };
  go_through(told, true, "t.mat: column \"value\"");
  go_through(untold, false, "t.mat: column \"value\"");
  EXPECT_GT(count_read(told), 400);
}

TEST_F(UnitSpellings, InTheUnitsOfAPropertyFile) {
  const std::vector<std::tuple<std::string, std::string, double (TeimOrbitUnits::*)() const>> keys =
      {{"LENGTH", "m", &TeimOrbitUnits::length},
       {"FORCE", "N", &TeimOrbitUnits::force},
       {"ANGLE", "rad", &TeimOrbitUnits::angle},
       {"MASS", "kg", &TeimOrbitUnits::mass},
       {"TIME", "s", &TeimOrbitUnits::time},
       {"PRESSURE", "Pa", &TeimOrbitUnits::pressure}};
  int read = 0;
  for (const UnitSpelling& spelling : unit_spellings::kAll) {
    if (std::string_view(spelling.written).find('\'') != std::string_view::npos) continue;
    for (const auto& [key, si, member] : keys) {
      if (si != spelling.si) continue;
      const auto file =
          TeimOrbit::parse("[UNITS]\n" + key + " = '" + spelling.written + "'\n", "t.tir");
      expect_the_number_by_hand(
          spelling,
          [&, member = member](const UnitSpelling&) {
            return Found{spelling.si, kWritten * (file.units().*member)()};
          },
          true,
          "t.tir:2: " + key);
      ++read;
    }
  }
  EXPECT_GT(read, 150);
}

TEST_F(UnitSpellings, InMeasurementsOfLoadsModesAndShapes) {
  const auto write = [&](const std::string& text) {
    write_text_file(folder_ / "t.csv", text);
    return folder_ / "t.csv";
  };
  for (const UnitSpelling& spelling : unit_spellings::kAll) {
    const std::string si = spelling.si;
    Reader reader;
    if (si == "N")
      reader = [&](const UnitSpelling&) {
        return Found{si,
                     read_load_deflection(write("deflection [m]," + title(spelling, "force") +
                                                "\n0.001,1e-9\n0.002,7\n"))
                         .force.back()};
      };
    if (si == "m")
      reader = [&](const UnitSpelling&) {
        return Found{
            si,
            read_load_deflection(write(title(spelling, "deflection") + ",force [N]\n1,0.5\n7,1\n"))
                .position.back()};
      };
    if (si == "Hz")
      reader = [&](const UnitSpelling&) {
        return Found{si,
                     read_modes(write(title(spelling, "frequency") + "\n7\n")).modes[0].frequency};
      };
    if (reader) expect_the_number_by_hand(spelling, reader, true, "t.csv:1: column ");
  }
}

}  // namespace
}  // namespace latsch::formats
