// SPDX-License-Identifier: Apache-2.0
// Units, signs and names of the columns of a [measurement].
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/document.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "base/text.h"
#include "base/unit_words/unit_spellings_testing.h"
#include "base/units.h"
#include "correlation/laboratory/measurement.h"
#include "correlation/laboratory/selection.h"

namespace latsch::correlation {
namespace {

constexpr double kPoundForce = 0.45359237 * 9.80665;

class MeasurementUnits : public testing::Test {
 protected:
  Measurement read(const std::string& name,
                   const std::string& text,
                   const std::string& lines = "") {
    write_text_file(folder_ / name, text);
    write_text_file(folder_ / "study.toml", "[measurement.run]\nfile = \"" + name + "\"\n" + lines);
    const Document document = Document::read(folder_ / "study.toml");
    return *find(read_laboratory(document.root(), folder_.path()), "run");
  }
  std::string complaint(const std::string& name,
                        const std::string& text,
                        const std::string& lines = "") {
    try {
      read(name, text, lines);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  }

  ScratchFolder folder_;
};

// Regression test: 900 lb once became 408 N, because the number was read as a mass and the unit as
// that of a force.
TEST_F(MeasurementUnits, NumbersAndLabelsOfACsvAgree) {
  for (const char* file :
       {"Fz [lb]\n900\n", "Fz\nlb\n900\n", "Fz (lb)\n900\n", "Fz / lbf\n900\n"}) {
    const Measurement run = read("run.csv", file);
    EXPECT_NEAR(run.values("Fz", "N")[0], 900 * kPoundForce, 1e-9) << file;
    EXPECT_EQ(run.unit("Fz"), "N");
  }
  const Measurement moment =
      read("run.csv", "Mz [ft-lb],SA [Grad],P [PSI],N [1/min]\n10,2,30,60\n");
  EXPECT_NEAR(moment.values("Mz", "N m")[0], 3.048 * kPoundForce, 1e-12);
  EXPECT_NEAR(moment.values("alpha", "rad")[0], std::numbers::pi / 90, 1e-15);
  EXPECT_NEAR(moment.values("p", "Pa")[0], 30 * kPoundForce / 0.0254 / 0.0254, 1e-9);
  EXPECT_NEAR(moment.values("omega", "rad/s")[0], 2 * std::numbers::pi, 1e-14);
}

// Test a file of a German spreadsheet program, with degree signs, decimal commas and CRLF line
// ends.
TEST_F(MeasurementUnits, OfASpreadsheetWithDegreeSignsAreRead) {
  for (const std::string degree : {"\xc2\xb0", "\xb0"}) {
    const Measurement run =
        read("utf2.csv",
             "Zeit [s];SA [" + degree +
                 "];FZ [N];FY [N]\r\n0,0;1,5;4000,5;-900\r\n0,1;2,0;4010;-1200\r\n");
    EXPECT_NEAR(run.values("alpha", "rad")[0], 1.5 * std::numbers::pi / 180, 1e-15);
    EXPECT_EQ(run.values("Fz", "N")[0], 4000.5);
  }
}

TEST_F(MeasurementUnits, AColumnThatStatesItsUnitMayBeNamed) {
  const std::string columns = "columns = {Fz = \"FZH\"}\n";
  EXPECT_EQ(read("run.csv", "FZH [kN]\n2\n", columns).values("Fz", "N")[0], 2000.0);
  EXPECT_EQ(read("run.dat", "run\nET\tFZH\nsec\tkN\n0\t2\n", columns).values("Fz", "N")[0], 2000.0);
  const std::string tydex =
      "**HEADER\n**MEASURCHANNELS\n"
      "FZH                                     kN        1         0         0\n"
      "**MEASURDATA\n2\n**END\n";
  for (const char* name : {"run.tdx", "run.tda", "run.TDB", "run.tydex"})
    EXPECT_EQ(read(name, tydex, columns).values("Fz", "N")[0], 2000.0) << name;
  EXPECT_EQ(
      read("run.csv", "FZH [kN]\n2\n", "columns = {Fz = \"FZH [kN]\"}\n").values("Fz", "N")[0],
      2000.0);
  EXPECT_EQ(
      read("run.csv", "FZH [lb]\n2\n", "columns = {Fz = \"FZH [lbf]\"}\n").values("Fz", "N")[0],
      2 * kPoundForce);
  EXPECT_NE(complaint("run.csv", "FZH [kN]\n2\n", "columns = {Fz = \"FZH [N]\"}\n")
                .find("run.csv:1: FZH is in \"kN\", but was said to be in \"N\""),
            std::string::npos);
}

TEST_F(MeasurementUnits, ASignMayStandBeforeAColumn) {
  const Measurement run =
      read("run.csv", "FXH [kN],FYH [N]\n2,3\n", "columns = {Fx = \"-FXH\", Fy = \"- FYH [N]\"}\n");
  EXPECT_EQ(run.values("Fx", "N")[0], -2000.0);
  EXPECT_EQ(run.values("Fy", "N")[0], -3.0);
  EXPECT_EQ(run.written("Fx").sign, -1.0);
  EXPECT_EQ(run.written("Fx").column, "FXH");
  EXPECT_NE(std::find(run.words().begin(), run.words().end(), "Fx is FXH with its sign changed"),
            run.words().end());
}

TEST_F(MeasurementUnits, AColumnIsOneChannel) {
  EXPECT_NE(complaint("run.csv", "A [N]\n2\n", "columns = {Fx = \"A\", Fy = \"-A\"}\n")
                .find("study.toml:3: measurement.run.columns.Fy is \"-A\", the column that Fx is"),
            std::string::npos);
  EXPECT_NE(complaint("run.csv", "A [N]\n2\n", "columns = {Fx = \"A [Grat]\"}\n")
                .find("unknown unit \"Grat\""),
            std::string::npos);
  EXPECT_NE(complaint("run.csv", "A [N],b\n2,1\n", "columns = {Fx = \"B\", Fy = \"C\"}\n")
                .find("run.csv:1: columns \"B\", \"C\" are missing, did you mean \"b\" for \"B\"? "
                      "(columns: \"A\" or \"b\")"),
            std::string::npos);
}

// A known name requires a dimension; a unit of another dimension, or an unknown unit, is an error
// at the unit.
TEST_F(MeasurementUnits, OfKnownChannelsAreChecked) {
  EXPECT_NE(complaint("run.csv", "time [s],FZ [kg]\n0,1\n")
                .find("run.csv:1: column \"FZ\" is in \"kg\", expected a force"),
            std::string::npos);
  EXPECT_NE(complaint("run.csv", "time,SA\ns,degg\n0,1\n")
                .find("run.csv:2: column \"SA\" has unknown unit \"degg\", did you mean \"deg\"?"),
            std::string::npos);
  EXPECT_NE(complaint("run.dat", "run\nET\tSA\tFZ\nsec\tdegg\tN\n0\t1\t2\n")
                .find("run.dat:3: column \"SA\" has unknown unit \"degg\""),
            std::string::npos);
  EXPECT_NE(complaint("run.csv", "time [s],SA [grad]\n0,1\n").find("write \"deg\" or \"gon\""),
            std::string::npos);
  EXPECT_NE(complaint("run.csv", "time [s],FY [N]\n0,\"1,234\"\n1,5\n")
                .find("run.csv:1: FY is \"1,234\" in line 2, a decimal comma"),
            std::string::npos);
}

TEST_F(MeasurementUnits, OfOtherColumnsWithFaultsAreLeftOutAndTold) {
  const Measurement run = read("run.csv", "time [s],az [g],b [foo]\n0,1,2\n");
  for (const char* channel : {"az", "b"}) {
    EXPECT_FALSE(run.has(channel));
    try {
      run.values(channel, "m/s^2");
      FAIL() << channel;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("unit \""), std::string::npos) << error.what();
    }
  }
  const Measurement told =
      read("run.csv", "time [s],az [g]\n0,2\n", "columns = {az = \"az [gn]\"}\n");
  EXPECT_NEAR(told.values("az", "m/s^2")[0], 19.6133, 1e-12);
}

TEST_F(MeasurementUnits, WindowsAreReadByTheTableOfSpellings) {
  for (const UnitSpelling& spelling : unit_spellings::kAll) {
    const std::string text = std::string("7 ") + spelling.written + " .. 9 " + spelling.written;
    const auto [window, fault] = parse_window(text, spelling.si);
    if (std::isnan(spelling.factor)) {
      EXPECT_FALSE(window) << spelling.written;
      continue;
    }
    ASSERT_TRUE(window) << spelling.written << " " << fault;
    EXPECT_NEAR(window->from / (7 * spelling.factor + spelling.offset), 1.0, 1e-12)
        << spelling.written;
  }
}

}  // namespace
}  // namespace latsch::correlation
