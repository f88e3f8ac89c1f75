// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/lab_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>

#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "formats/tables/csv_table.h"
#include "formats/tables/mat_file.h"
#include "formats/tables/tydex_file.h"

namespace latsch::formats {
namespace {

class LabTables : public testing::Test {
 protected:
  LabTable read(const std::string& name,
                const std::string& text,
                const std::map<std::string, std::string>& units = {}) {
    write_text_file(folder_ / name, text);
    return read_lab_table(folder_ / name, units);
  }
  std::string complaint(const std::string& name,
                        const std::string& text,
                        const std::map<std::string, std::string>& units = {}) {
    try {
      read(name, text, units);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  ScratchFolder folder_;
};

// 1 lbf = 4.4482216152605 N, 1 ft lbf = 1.3558179483314 N m [NIST SP 811, B.8]
TEST_F(LabTables, OfAConsortiumComeOutInSi) {
  const LabTable table = read("run4.dat",
                              "Tire: 16.0x7.5-10\tRun: 4\r\n"
                              "ET\tV\tSA\tFZ\tMZ\tNFY\tTSTI\r\n"
                              "sec\tmph\tdeg\tlb\tft-lb\t\tdeg F\r\n"
                              "0.01\t25\t-180\t-100\t2\t0.5\t212\r\n"
                              "0.02\t25\t90\t-200\t-2\t0.25\tNaN\r\n");
  EXPECT_EQ(table.channels["ET"], (std::vector<double>{0.01, 0.02}));
  EXPECT_NEAR(table.channels["V"][0], 25 * 0.44704, 1e-12);
  EXPECT_NEAR(table.channels["SA"][0], -std::numbers::pi, 1e-15);
  EXPECT_NEAR(table.channels["FZ"][1], -2 * 444.82216152605, 1e-9);
  EXPECT_EQ(table.channels.find("FZ")->unit, "N");
  EXPECT_NEAR(table.channels["MZ"][0], 2 * 1.3558179483314, 1e-12);
  EXPECT_EQ(table.channels.find("NFY")->unit, "1");
  EXPECT_NEAR(table.channels["TSTI"][0], 373.15, 1e-9);
  EXPECT_TRUE(std::isnan(table.channels["TSTI"][1]));
  EXPECT_EQ(table.lines, (std::vector<int>{4, 5}));
}

TEST_F(LabTables, OfAConsortiumMayStandBetweenBlanksAndNameNoUnits) {
  const LabTable blanks = read("a.dat", "run 4\n ET   SA  FZ\n sec  deg  N \n  1   2  -3e2\n");
  EXPECT_EQ(blanks.channels["FZ"], std::vector<double>{-300.0});
  const LabTable bare = read("b.dat", "run 4\nET\tFZ\n1\t-3\n2\t-4\n", {{"FZ", "kN"}});
  EXPECT_EQ(bare.channels["FZ"], (std::vector<double>{-3000.0, -4000.0}));
  EXPECT_EQ(bare.channels.find("ET")->unit, "1");
}

TEST_F(LabTables, AreRefusedInWords) {
  EXPECT_NE(complaint("a.dat", "run\nET\tFZ\nsec\tN\n1\t2\n1\n")
                .find("a.dat:5: has 1 field, "
                      "expected 2"),
            std::string::npos);
  EXPECT_NE(complaint("a.dat", "nothing here\n").find("no line of numbers"), std::string::npos);
  EXPECT_NE(complaint("a.xls", "x").find("a.xls: ends in \".xls\", expected"), std::string::npos);
  EXPECT_NE(
      complaint("a.csv", "FY_N,FZ_N\n1,2\n", {{"FX_N", "N"}}).find("\"FX_N\" is missing, did"),
      std::string::npos);
  EXPECT_NE(complaint("a.csv", "Fz [kN]\n1\n", {{"Fz", "N"}}).find("Fz is in \"kN\""),
            std::string::npos);
}

// Regression: a line of units with an unknown unit was read as the line of names.
TEST_F(LabTables, AnUnknownUnitOfADatIsNoName) {
  const LabTable table = read("a.dat", "run 4\nET\tSA\tFZ\tNFX\nsec\tdegg\tN\t\n1\t2\t3\t4\n");
  EXPECT_EQ(table.channels["FZ"], std::vector<double>{3.0});
  EXPECT_EQ(table.left_out.at("SA"), "has unknown unit \"degg\", did you mean \"deg\"?");
  EXPECT_EQ(table.columns.back().name, "NFX");
  EXPECT_EQ(table.columns.back().place, 4);
  EXPECT_EQ(table.columns.front().unit, "sec");
  EXPECT_EQ(table.columns.front().unit_line, 3);
  const auto expected = [](const std::string& name) {
    return std::string(name == "SA" ? "rad" : "");
  };
  EXPECT_THROW(read_lab_table(folder_ / "a.dat", {}, expected), InputError);
  // None of the units in this file is known, but all names of the columns are usual.
  EXPECT_EQ(read("b.dat", "run\nSA\tFZ\nfoo\tbaz\n1\t2\n").left_out.size(), 2u);
}

TEST_F(LabTables, DecimalCommasAndThousandsOfADatAreRefusedByTheirReason) {
  EXPECT_NE(complaint("a.dat", "run\nET\tFZ\nsec\tN\n0,5\t2,5\n")
                .find("a.dat:4: begins with \"0,5\", expected a number: decimal commas are not "
                      "read in a .dat"),
            std::string::npos);
  EXPECT_NE(complaint("a.dat", "run\nET\tFZ\nsec\tN\n1\t2,5\n")
                .find("a.dat:4: FZ is \"2,5\", a decimal comma"),
            std::string::npos);
  EXPECT_NE(complaint("a.dat", "run\nET\tFZ\nsec\tN\n1\t1,234.5\n")
                .find("a.dat:4: FZ is \"1,234.5\", expected a number without thousands separators"),
            std::string::npos);
  EXPECT_NE(complaint("a.dat", "ET,FZ\nsec,N\n1,2\n").find("between them make a .csv"),
            std::string::npos);
}

TEST_F(LabTables, TwoColumnsOfOneNameAndTooManyAreRefused) {
  EXPECT_NE(complaint("a.dat", "run\nET\tFZ\tFZ\nsec\tN\tN\n1\t2\t3\n")
                .find("a.dat:2: column \"FZ\" comes twice, as column 2 and 3"),
            std::string::npos);
  std::string names = "run\n", numbers = "1";
  for (int i = 0; i < 1'000'000; ++i) names += "\tc" + std::to_string(i), numbers += "\t1";
  EXPECT_NE(complaint("b.dat", names + "\n" + numbers + "\n").find("more than 10000 columns"),
            std::string::npos);
  std::string csv;
  for (int i = 0; i < 1'000'000; ++i) csv += "c" + std::to_string(i) + ",";
  EXPECT_NE(complaint("b.csv", csv + "x\n").find("b.csv:1: has more than 10000 fields"),
            std::string::npos);
  EXPECT_NE(complaint("e.dat", "").find("is empty"), std::string::npos);
  EXPECT_NE(complaint("e.csv", "").find("is empty"), std::string::npos);
}

// Symbols of units occur in the encodings that Windows programs use.
TEST_F(LabTables, AreReadInUtf8AndWindows1252AndNotInUtf16) {
  for (const std::string head : {"SA [\xc2\xb0],x [\xc2\xb5m],y [\xce\xbcm]\n",
                                 "\xef\xbb\xbfSA [\xc2\xb0],x [\xc2\xb5m],y [\xc2\xb5m]\n",
                                 "SA [\xb0],x [\xb5m],y [\xb5m]\n"}) {
    const LabTable table = read("a.csv", head + "180,1,1\n");
    EXPECT_NEAR(table.channels["SA"][0], std::numbers::pi, 1e-15);
    EXPECT_NEAR(table.channels["x"][0], 1e-6, 1e-20);
    EXPECT_NEAR(table.channels["y"][0], 1e-6, 1e-20);
  }
  EXPECT_EQ(read("p.csv", "a [\x89]\n7\n").channels["a"][0], 0.007);  // per mille
  EXPECT_NEAR(
      read("a.dat", "run\nET\tSA\nsec\t\xb0\n1\t180\n").channels["SA"][0], std::numbers::pi, 1e-15);
  std::string utf16 = "\xff\xfe";
  for (const char c : std::string("Fz [N]\n1\n")) utf16 += std::string({c, '\0'});
  for (const char* name : {"u.csv", "u.dat", "u.tdx"})
    for (const std::string& text : {utf16, utf16.substr(2)})
      EXPECT_NE(complaint(name, text).find(std::string(name) + ": is UTF-16 text, expected UTF-8"),
                std::string::npos)
          << complaint(name, text);
}

// A crash may leave a file for which space was reserved but nothing written: it contains only
// zeros.
TEST_F(LabTables, AFileOfZerosIsNoText) {
  for (const char* name : {"z.csv", "z.dat", "z.tdx"}) {
    const std::string said = complaint(name, std::string(4096, '\0'));
    EXPECT_NE(said.find("holds a zero byte"), std::string::npos) << said;
  }
}

TEST_F(LabTables, ABinaryFileThatIsNamedAsATextIsRefusedByWhatItIs) {
  for (const char* name : {"b.csv", "b.txt", "b.dat", "b.tdx", "b.mat"}) {
    write_text_file(folder_ / name, std::string("TDSm\x0e\0\0\0\x69\x12\0\0", 12));
    using Reader = std::function<void(const std::filesystem::path&)>;
    const Reader any = [](const std::filesystem::path& file) { read_lab_table(file); };
    const Reader own = [](const std::filesystem::path& file) {
      const std::string ending = file.extension().string();
      if (ending == ".mat") MatFile::read(file);
      if (ending == ".tdx") TydexFile::read(file);
      if (ending == ".csv" || ending == ".txt") CsvTable::read(file);
      if (ending == ".dat") read_lab_table(file);
    };
    for (const Reader& reader : {any, own}) {
      std::string said;
      try {
        reader(folder_ / name);
      } catch (const InputError& error) {
        said = error.what();
      }
      EXPECT_NE(said.find("is a TDMS file by its first bytes, but ends in"), std::string::npos)
          << name << ": " << said;
    }
  }
}

TEST_F(LabTables, ATextThatEndsWithinARowLeavesTheRowOutAndSaysSo) {
  const auto doubt_of = [](const LabTable& table) {
    return table.doubts.empty() ? std::string() : table.doubts.front().sentence;
  };
  const std::string dat = "run\nET\tFZ\nsec\tN\n0\t1\n1\t2\n2";
  for (const auto& [name, text] :
       {std::pair("a.csv", std::string("t [s],Fz [N]\n0,1\n1,2\n2")), std::pair("a.dat", dat)}) {
    const LabTable table = read(name, text);
    EXPECT_EQ(table.lines.size(), 2u) << name;
    EXPECT_EQ(doubt_of(table), "the file is cut off within this line, which is left out") << name;
    EXPECT_EQ(table.doubts.front().place.line, name == std::string("a.csv") ? 4 : 6);
    // With a line end the row is whole, and wrong.
    EXPECT_NE(complaint(name, text + "\n").find("has 1 field, expected 2"), std::string::npos);
  }
  // The last number may be cut: the row counts. A whole file may end without a line end.
  const std::string head = dat.substr(0, 16);
  const LabTable shortened = read("b.dat", head + "0\t1.25\n1\t2.75\n2\t3.2");
  EXPECT_EQ(shortened.lines.size(), 3u);
  EXPECT_NE(doubt_of(shortened).find("fewer decimals"), std::string::npos);
  EXPECT_EQ(doubt_of(read("c.dat", head + "0\t1.25\n1\t2.75\n2\t3.25")), "");
  EXPECT_EQ(doubt_of(read("d.dat", head + "0\t1.25\n1\t2.7\n2\t3")), "");
  EXPECT_EQ(doubt_of(read("e.dat", head + "0\t1.25\n1\t2.75\n2\t3.2\n")), "");
  const std::string csv = "t [s],Fz [N]\n";
  const std::string varied = csv + "0,1.23456\n1,1.2345\n2,1.234567\n3,1.";
  for (const std::string& text : {csv + "0,1.25\n1,2.75\n2,3.2", varied, varied + "0"})
    EXPECT_NE(doubt_of(read("f.csv", text)).find("fewer decimals"), std::string::npos) << text;
  for (const std::string& text : {csv + "0,1.25\n1,2.75\n2,3.2\n",
                                  csv + "0,1.25\n1,2.75\n2,3.25",
                                  varied + "23",
                                  std::string("t [s];Fz [N]\n0;1,25\n1;2,75\n2;3,25")})
    EXPECT_EQ(doubt_of(read("g.csv", text)), "") << text;
}

TEST_F(LabTables, ATableOfAMeasurementThatIsCutOffIsRefused) {
  try {
    CsvTable::parse("a [mm],b [N]\n1,2\n3", "t.csv");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()).find("t.csv:3: the file is cut off within this line: has 1"), 0u)
        << error.what();
  }
}

// A unit at the end of a name counts only if the name is known.
TEST_F(LabTables, AUnitMayEndAName) {
  const auto expected = [](const std::string& name) {
    return std::string(name.starts_with("SA") ? "rad" : name.starts_with("P") ? "Pa" : "");
  };
  write_text_file(folder_ / "a.csv", "SA_deg,P_kPa,run_N,SA_max\n180,80,3,4\n");
  write_text_file(folder_ / "a.dat", "run\nSA_deg\tP_kPa\trun_N\tSA_max\n180\t80\t3\t4\n");
  for (const char* name : {"a.csv", "a.dat"}) {
    const LabTable table = read_lab_table(folder_ / name, {}, expected);
    EXPECT_NEAR(table.channels["SA_deg"][0], std::numbers::pi, 1e-15);
    EXPECT_EQ(table.channels["P_kPa"][0], 80e3);
    EXPECT_EQ(table.channels.find("run_N")->unit, "1");
    EXPECT_EQ(table.channels.find("SA_max")->unit, "1");
    EXPECT_EQ(table.columns[0].assumed, "the unit \"deg\" is that of the name");
  }
  // A unit stated by the caller overrides that of the file.
  const LabTable stated = read_lab_table(folder_ / "a.csv", {{"P_kPa", "bar"}}, expected);
  EXPECT_EQ(stated.channels["P_kPa"][0], 80e5);
  EXPECT_EQ(CsvTable::read(folder_ / "a.csv").numbers("P_kPa", "Pa")[0], 80e3);
}

TEST_F(LabTables, AThousandIsNoOne) {
  EXPECT_NE(complaint("a.csv", "t [s];F [N]\n0.5;1,234\n").find("a separator of thousands?"),
            std::string::npos);
  EXPECT_NE(complaint("a.csv", "t [s];F [N]\n0,5;1\n1;1.234\n").find("a.csv:3: has the number "),
            std::string::npos);
  EXPECT_EQ(read("a.csv", "t [s];F [N]\n0,5;1,234\n").channels["F"][0], 1.234);
}

TEST_F(LabTables, KeepGapsAndTextsOfCsv) {
  const LabTable table =
      read("a.csv", "# note\nFz [kN],Fy,who,odd [furlongs per]\n1,,ann,1\n2,3,,2\n", {{"Fy", "N"}});
  EXPECT_EQ(table.channels["Fz"], (std::vector<double>{1000.0, 2000.0}));
  EXPECT_TRUE(std::isnan(table.channels["Fy"][0]));
  EXPECT_EQ(table.channels.find("Fy")->unit, "N");
  EXPECT_TRUE(std::isnan(table.channels["who"][1]));
  EXPECT_NE(table.left_out.at("odd").find("unknown unit"), std::string::npos);
  EXPECT_EQ(table.place(1).text(), (folder_ / "a.csv").string() + ":4");
}

TEST_F(LabTables, OfTydexHoldTheirConstantsAllAlong) {
  const LabTable table =
      read("a.tdx",
           "**HEADER\nRELEASE   Release of TYDEX-Format                 1.3\n"
           "**CONSTANTS\n"
           "INFLPRES  Inflation pressure            kPa       69\n"
           "FZW       Vertical force                N         1050\n"
           "**MEASURCHANNELS\n"
           "SLIPANGL  Slip angle                    deg       1         0         0\n"
           "FZW       Vertical force                N         1         0         0\n"
           "**MEASURDATA\n1 1000\n2 NOTAVAIL\n**END\n");
  EXPECT_EQ(table.channels["INFLPRES"], (std::vector<double>{69e3, 69e3}));
  EXPECT_EQ(table.channels["FZW"][0], 1000.0);
  EXPECT_TRUE(std::isnan(table.channels["FZW"][1]));
}

TEST_F(LabTables, OfTydexSayWhichConstantsTheirChannelsReplace) {
  const LabTable table =
      read("b.tdx",
           "**HEADER\nRELEASE   Release of TYDEX-Format                 1.3\n"
           "**CONSTANTS\n"
           "INCLANGL  Camber                        deg       3\n"
           "FZW       Vertical force                N         1050\n"
           "**MEASURCHANNELS\n"
           "INCLANGL  Camber                        deg       1         0         0\n"
           "FZW       Vertical force                N         1         0         0\n"
           "**MEASURDATA\n0 1000\n0.5 1100\n**END\n");
  ASSERT_EQ(table.left_columns.size(), 2u);
  EXPECT_EQ(table.left_columns[0].line, 4);
  EXPECT_EQ(table.left_out.at("INCLANGL of **CONSTANTS"),
            "is 3 deg, but the channel INCLANGL goes from 0 rad to 0.008727 rad: the channel is "
            "used");
  EXPECT_EQ(table.left_out.at("FZW of **CONSTANTS"), "is not used: the channel of that name is");
}

// In files of consortia the vectors have names and channel.units lists their units.
TEST_F(LabTables, OfMatTakeTheUnitsListedBesideTheChannels) {
  write_text_file(folder_ / "script",
                  "import numpy as np, scipy.io as io\n"
                  "o = lambda *a: np.array(a, dtype=object)\n"
                  "io.savemat('run.mat', {'SA': np.array([[180.0], [90.0]]), 'FZ': "
                  "np.array([[-1.0], [np.nan]]), 'tireid': 'x', 'channel': {'name': o('SA', 'FZ', "
                  "'MX'), 'units': o('deg', 'kN', 'N-m')}})\n");
  const std::string command =
      "cd '" + folder_.path().string() + "' && /usr/bin/python3 script >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0)
    GTEST_SKIP() << "SciPy is not installed (Debian: python3-scipy)";
  const LabTable table = read_lab_table(folder_ / "run.mat");
  EXPECT_NEAR(table.channels["SA"][0], std::numbers::pi, 1e-15);
  EXPECT_EQ(table.channels["FZ"][0], -1000.0);
  EXPECT_TRUE(std::isnan(table.channels["FZ"][1]));
  EXPECT_EQ(table.place(1).line, 0);
}

// All channels of a recording have one length. A shorter one must be refused, not filled with
// zeros.
TEST_F(LabTables, OfMatHaveVectorsOfOneLength) {
  const auto read = [&](const std::string& vectors) {
    write_text_file(folder_ / "script",
                    "import numpy as np, scipy.io as io\nn = lambda k: np.arange(1.0, k + 1)\n"
                    "io.savemat('run.mat', {" +
                        vectors + "})\n");
    const std::string command =
        "cd '" + folder_.path().string() + "' && /usr/bin/python3 script >/dev/null 2>&1";
    return std::system(command.c_str()) == 0;
  };
  if (!read("'SA': n(60), 'FY': n(40)"))
    GTEST_SKIP() << "SciPy is not installed (Debian: python3-scipy)";
  try {
    read_lab_table(folder_ / "run.mat");
    ADD_FAILURE() << "vectors of two lengths were read";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("vectors of one recording have the same length"), text.npos) << text;
  }
  ASSERT_TRUE(read("'SA': n(60), 'FY': n(60), 'speeds': n(5), 'P': 82.7"));
  const LabTable table = read_lab_table(folder_ / "run.mat");
  EXPECT_EQ(table.channels.all().size(), 2u);
  EXPECT_EQ(table.left_out.at("speeds"), "has 5 values, but the recording 60 samples");
  EXPECT_EQ(
      table.left_out.at("P"),
      "is a single number, 82.7, without a unit: columns = {p = \"P [kPa]\"} makes it a channel");
}

// A column with a unit must hold numbers: other cells are an error of the column, even if all of
// its cells are texts.
TEST_F(LabTables, AColumnWithAUnitAndNoNumberIsLeftOutWithItsReason) {
  for (const char* cell : {"\"4,000\"", "4'000", "0x10", "=A1", "4 000"}) {
    SCOPED_TRACE(cell);
    const LabTable table =
        read("t.csv", "load 7 [N],SA [deg]\n" + std::string(cell) + ",1\n" + cell + ",2\n");
    ASSERT_TRUE(table.left_out.contains("load 7"));
    EXPECT_NE(table.left_out.at("load 7").find("in line 2"), std::string::npos);
    ASSERT_EQ(table.left_columns.size(), 1u);
    EXPECT_EQ(table.left_columns[0].unit, "N");
  }
  // A column of texts needs no unit; a column of gaps counts as not recorded.
  EXPECT_TRUE(read("t.csv", "who,FZ [N],MX [N m]\nbob,1,\nann,2,\n").left_out.empty());
}

// 1 kgf = 9.80665 N [NIST SP 811, B.8]: a load "in kg" is the weight of that mass.
TEST_F(LabTables, AMassInPlaceOfAForceIsProposedAsAWeight) {
  const auto expected = [](const std::string& name) { return name == "FZ" ? "N" : "N m"; };
  const auto complain = [&](const std::string& head) -> std::string {
    write_text_file(folder_ / "t.csv", head + "\n1\n");
    try {
      read_lab_table(folder_ / "t.csv", {}, expected);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto proposed = [](const std::string& message) {
    const std::size_t at = message.find("such as \"");
    return at == message.npos ? message : message.substr(at + 9, message.rfind('"') - at - 9);
  };
  EXPECT_EQ(proposed(complain("FZ [kg]")), "FZ [kgf]");
  EXPECT_EQ(proposed(complain("FZ [t]")), "FZ [tf]");
  write_text_file(folder_ / "t.csv", "FZ [kgf]\n1\n");
  EXPECT_NEAR(read_lab_table(folder_ / "t.csv", {}, expected).channels["FZ"][0], 9.80665, 1e-12);
}

TEST_F(LabTables, HabitsOfOtherProgramsAreReadOrRefusedInWords) {
  EXPECT_EQ(read("sep.csv", "sep=;\nFZ [N];SA [deg]\n4,5;1\n").channels["FZ"][0], 4.5);
  EXPECT_EQ(read("tab.csv", "\"sep=\t\"\r\nFZ [N]\tSA [deg]\r\n4,5\t1\r\n").channels["FZ"][0], 4.5);
  const auto says = [&](const std::string& text, const std::string& words) {
    const std::string found = complaint("t.csv", text);
    EXPECT_NE(found.find(words), std::string::npos) << found;
  };
  says("FZ [N],SA [deg]\r4,1\r5,2\r", "carriage return alone");
  says("Tire 4711\nFZ [N],SA [deg]\n4,1\n", "if line 1 is a title, put # before it");
  EXPECT_EQ(read("t.csv", "# Tire 4711\nFZ [N],SA [deg]\n4,1\n").channels["FZ"][0], 4.0);
  EXPECT_NE(read("t.csv", "x [N],SA [deg]\n\u22124,1\n3,1\n").left_out.at("x").find("minus"),
            std::string::npos);
  EXPECT_TRUE(std::isnan(read("t.csv", "FZ [N],SA [deg]\nn.a.,1\n4,1\n").channels["FZ"][0]));
}

}  // namespace
}  // namespace latsch::formats
