// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/csv_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "base/file.h"
#include "base/scratch_folder_testing.h"

namespace latsch::formats {
namespace {

CsvTable parse(const std::string& text) { return CsvTable::parse(text, "t.csv"); }

std::string table_complaint(const std::string& text,
                            const std::function<void(const CsvTable&)>& read) {
  try {
    read(parse(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CsvTable, UnitsInTheHeaderBecomeSi) {
  const CsvTable table = parse(
      "# rig 3\n\ndeflection [mm], force [kN], type\n5.0,0.812,lateral\n# more\n10,1.7,\"a, "
      "\"\"b\"\"\"\n");
  EXPECT_EQ(table.rows(), 2);
  EXPECT_EQ(table.numbers("deflection", "m"), (std::vector<double>{0.005, 0.01}));
  EXPECT_EQ(table.numbers("force", "N"), (std::vector<double>{812.0, 1700.0}));
  EXPECT_EQ(table.texts("type"), (std::vector<std::string>{"lateral", "a, \"b\""}));
  EXPECT_EQ(table.place(1).text(), "t.csv:6");
  EXPECT_TRUE(table.has("type"));
  EXPECT_FALSE(table.has("Type"));
}

TEST(CsvTable, UnitsMayStandInASecondRow) {
  for (const char* text : {"x,F,n\nmm,N,-\n5,812,1\n", "x,F,n\n[mm],[N],\n5,812,1\n"}) {
    const CsvTable table = parse(text);
    EXPECT_EQ(table.rows(), 1) << text;
    EXPECT_EQ(table.numbers("x", "m"), (std::vector<double>{0.005}));
    EXPECT_EQ(table.integers("n"), (std::vector<int>{1}));
  }
  EXPECT_EQ(parse("a,b\n1,2\n").rows(), 1);     // a line of numbers is data
  EXPECT_EQ(parse("a,b\nx,none\n").rows(), 1);  // words that are no units are data too
}

TEST(CsvTable, SpreadsheetsOfOtherCountriesUseSemicolonAndComma) {
  const CsvTable table = parse("\xef\xbb\xbfx [mm];F [N]\r\n5,5;1.25e3\r\n\"6,5\";-1,5E+3\r\n");
  EXPECT_EQ(table.numbers("x", "m"), (std::vector<double>{0.0055, 0.0065}));
  EXPECT_EQ(table.numbers("F", "N"), (std::vector<double>{1250.0, -1500.0}));
  EXPECT_EQ(parse("x [mm]\tF [N]\n5,5\t7\n").numbers("x", "m"), (std::vector<double>{0.0055}));
}

TEST(CsvTable, QuotedFieldsMayHoldLineEndsAndTheLastLineNeedsNone) {
  const CsvTable table = parse("a,b\n\"x\ny\",1\nz,2");
  EXPECT_EQ(table.texts("a"), (std::vector<std::string>{"x\ny", "z"}));
  EXPECT_EQ(table.place(1).line, 4);
}

TEST(CsvTableComplaint, NamesFileLineFoundAndExpected) {
  const auto force = [](const CsvTable& t) { t.numbers("force", "N"); };
  EXPECT_EQ(table_complaint("", force), "t.csv: is empty, expected a line of column names");
  EXPECT_EQ(table_complaint("force [N]\n1\nnan\n", force),
            "t.csv:3: force is \"nan\", expected a finite number");
  EXPECT_EQ(table_complaint("force [N],b\n1,2\n,2\n", force),
            "t.csv:3: force is empty, expected a finite number");
  EXPECT_EQ(table_complaint("force [N]\n1\ninf\n", force),
            "t.csv:3: force is \"inf\", expected a finite number");
  EXPECT_EQ(table_complaint("force [N];b\n1.234,5;2\n", force),
            "t.csv:2: force is \"1.234,5\", expected a number without thousands separators");
  EXPECT_EQ(table_complaint("force [N],b\n1,2\n1,2,3\n", force),
            "t.csv:3: has 3 fields, expected 2 as in the header (line 1); decimal commas need "
            "semicolons or tabs between the columns");
  EXPECT_EQ(table_complaint("force [kNn]\n1\n", force),
            "t.csv:1: column \"force\" has unknown unit \"kNn\", did you mean \"kN\"?");
  EXPECT_EQ(table_complaint("force [bar]\n1\n", force),
            "t.csv:1: column \"force\" is in \"bar\", expected a force, such as \"force [N]\"");
  EXPECT_EQ(table_complaint("force\n1\n", force),
            "t.csv:1: column \"force\" has no unit, expected a force, such as \"force [N]\"");
  EXPECT_EQ(table_complaint("forse [N],b\n1,2\n", force),
            "t.csv:1: column \"force\" is missing, did you mean \"forse\"? (columns: \"forse\" or "
            "\"b\")");
  EXPECT_EQ(table_complaint("a,a\n1,2\n", force),
            "t.csv:1: column \"a\" comes twice, as column 1 and 2");
  EXPECT_EQ(table_complaint("a,\n1,2\n", force), "t.csv:1: has a column without a name: column 2");
  EXPECT_EQ(table_complaint("a,b\n\"1,2\n", force), "t.csv:2: a quote is opened and never closed");
  EXPECT_EQ(table_complaint("a,b\n\"1\"x,2\n", force),
            "t.csv:2: text follows a closing quote, expected \",\"");
  EXPECT_EQ(table_complaint(std::string("a,b\n1,\0\n", 8), force),
            "t.csv:2: holds a zero byte, expected a text file in UTF-8");
  EXPECT_EQ(table_complaint("n\n1.5\n", [](const CsvTable& t) { t.integers("n"); }),
            "t.csv:2: n is 1.5, expected an integer");
  EXPECT_EQ(table_complaint("forse [N]\n1\n", [](const CsvTable& t) { t.expect_only({"force"}); }),
            "t.csv:1: unknown column \"forse\", did you mean \"force\"?");
}

TEST(CsvTableComplaint, FloodsEndEarly) {
  const auto nothing = [](const CsvTable&) {};
  EXPECT_EQ(table_complaint(std::string(15 << 20, ','), nothing),
            "t.csv:1: has more than 10000 fields");
}

// Only some positions of a long table are stored; all ways to read its rows must give equal
// results.
TEST(CsvTable, LongTablesAreReadByColumnsByBlocksAndByRows) {
  constexpr int kRows = 5000;
  std::string text = "n [mm], half, word\n";
  for (int i = 0; i < kRows; ++i) {
    if (i % 700 == 0) text += "# a comment\n\n";
    text += fmt::format("{}, {}, {}\n", i, 0.5 * i, i % 3 == 0 ? "\"a \"\"b\"\"\"" : "c");
  }
  const CsvTable table = CsvTable::parse(text, "long.csv");
  ASSERT_EQ(table.rows(), kRows);
  const auto n = table.numbers("n", "m");
  const auto both = table.numbers({{"half", "1"}, {"n", "m"}});
  EXPECT_EQ(both[1], n);
  EXPECT_EQ(table.texts("word")[3], "a \"b\"");
  std::vector<double> joined;
  int blocks = 0;
  table.for_blocks({{"n", "m"}}, 999, [&](const auto& block) {
    joined.insert(joined.end(), block[0].begin(), block[0].end());
    ++blocks;
  });
  EXPECT_EQ(joined, n);
  EXPECT_EQ(blocks, 6);
  for (const int row : {0, 1, 1023, 1024, 3499, 3500, kRows - 1}) {
    EXPECT_EQ(table.text("n", row), std::to_string(row));
    EXPECT_EQ(table.place(row).line, 2 + row + 2 * (row / 700 + 1)) << row;
    EXPECT_EQ(n[static_cast<std::size_t>(row)], row / 1000.0);
  }
}

TEST(CsvTable, FilesAreMapped) {
  const auto file =
      std::filesystem::temp_directory_path() / fmt::format("latsch_csv_{}.csv", ::getpid());
  write_text_file(file, "a [kN]\n1\n2.5\n");
  EXPECT_EQ(CsvTable::read(file).numbers("a", "N"), (std::vector<double>{1000.0, 2500.0}));
  write_text_file(file, "");
  EXPECT_THROW(CsvTable::read(file), InputError);
  std::filesystem::remove(file);
  EXPECT_THROW(CsvTable::read(file), InputError);
  EXPECT_THROW(CsvTable::read(file.parent_path()), InputError);
}

// Values written in any unit must be read back with the same bits.
TEST(CsvTable, WrittenChannelsComeBackBitForBit) {
  std::uint64_t state = 11;
  const auto any = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return std::ldexp(1.0 + static_cast<double>(state >> 12) * 0x1p-52,
                      static_cast<int>(state % 80) - 40) *
           (state & 1024 ? 1.0 : -1.0);
  };
  Channels channels;
  Channel x{"x, \"outer\"", "m", {}}, F{"#force [z]", "N", {}}, n{"n", "1", {}};
  for (int i = 0; i < 500; ++i) {
    x.values.push_back(any());
    F.values.push_back(any());
    n.values.push_back(i);
  }
  channels.add(x);
  channels.add(F);
  channels.add(n);
  EXPECT_EQ(parse(csv_text(channels)).channels(), channels);
  EXPECT_EQ(parse(csv_text(channels, {"in", "lbf", "%"})).channels(), channels);
}

TEST(CsvTable, AColumnWithoutUnitIsInSiWhereThatIsAskedFor) {
  const CsvTable table = parse("x,y [mm],z [N]\n2,3,4\n");
  EXPECT_EQ(table.si_numbers("x", "m"), (std::vector<double>{2.0}));
  EXPECT_EQ(table.si_numbers("y", "m"), (std::vector<double>{0.003}));
  EXPECT_THROW(table.si_numbers("z", "m"), InputError);
}

TEST(CsvTable, WrittenTablesAreReadable) {
  Channels channels;
  channels.add({"deflection", "m", {0.005}});
  channels.add({"force", "N", {812.0}});
  EXPECT_EQ(csv_text(channels, {"mm", "N"}), "deflection [mm],force [N]\n5,812\n");
}

// A modal test on the ground records many frequencies and one deflection, so the deflection's
// column has empty cells.
TEST(CsvText, AShorterChannelLeavesItsCellsEmpty) {
  Channels channels;
  channels.add({"frequency", "Hz", {40.0, 60.0}});
  channels.add({"deflection", "m", {0.02}});
  EXPECT_EQ(csv_text(channels), "frequency [Hz],deflection [m]\n40,0.02\n60,\n");
}

TEST(CsvTable, AUnitMayStandInRoundBracketsOrBehindASlash) {
  const CsvTable table = parse(
      "Fz (kN),SA (deg),v / (km/h),Temp (C),p (bar(g)),Fy (H),toe (L),n (1)\n1,180,36,0,2,7,8,9\n");
  EXPECT_EQ(table.numbers("Fz", "N")[0], 1000.0);
  EXPECT_NEAR(table.numbers("SA", "rad")[0], 3.14159265358979, 1e-14);
  EXPECT_EQ(table.numbers("v", "m/s")[0], 10.0);
  EXPECT_EQ(table.numbers("Temp", "K")[0], 273.15);
  EXPECT_EQ(table.numbers("p", "Pa")[0], 2e5);
  // A column can be requested by its whole title. Letters in brackets that name a frame, a side or
  // a position are no units.
  EXPECT_EQ(table.numbers("Fz (kN)", "N")[0], 1000.0);
  EXPECT_EQ(table.numbers("Fy (H)", "1")[0], 7.0);
  EXPECT_EQ(table.numbers("toe (L)", "1")[0], 8.0);
  EXPECT_EQ(table.numbers("n (1)", "1")[0], 9.0);
  const TableColumn& column = table.header()[2];
  EXPECT_EQ(column.unit, "km/h");
  EXPECT_EQ(column.line, 1);
  EXPECT_EQ(column.place, 3);
}

// Regression: a line of units with an unknown unit was read as values.
TEST(CsvTable, AnUnknownWordInTheLineOfUnitsIsAnUnknownUnit) {
  for (const char* text : {"SA,FZ\ndegg,N\n1,2\n", "SA;FZ\ndegg;foo\n1,0;2,0\n"}) {
    const CsvTable table = parse(text);
    EXPECT_EQ(table.rows(), 1) << text;
    EXPECT_EQ(table_complaint(text, [](const CsvTable& t) { t.numbers("SA", "rad"); }),
              "t.csv:2: column \"SA\" has unknown unit \"degg\", did you mean \"deg\"?");
  }
  const CsvTable texts = parse("who,FZ\n,N\nann,2\n");
  EXPECT_EQ(texts.numbers("FZ", "N"), std::vector<double>{2.0});
  EXPECT_EQ(texts.unit("who"), "");
}

TEST(CsvTable, NamesAllMissingColumnsAtOnce) {
  EXPECT_EQ(table_complaint("a [N],b\n1,2\n",
                            [](const CsvTable& t) {
                              t.numbers({{"A", "N"}, {"zeta", "m"}, {"b", "1"}});
                            }),
            "t.csv:1: columns \"A\", \"zeta\" are missing, did you mean \"a\" for \"A\"? (columns: "
            "\"a\" or \"b\")");
}

TEST(CsvTable, SaysWhyANumberIsNone) {
  const auto force = [](const CsvTable& t) { t.numbers("F", "N"); };
  EXPECT_EQ(table_complaint("F [N],b\n\"1,5\",2\n", force),
            "t.csv:2: F is \"1,5\", a decimal comma, which is not read in files with commas: write "
            "a decimal point, or a .csv with semicolons or tabs between the columns");
  EXPECT_EQ(table_complaint("F [N],b\n1'234.5,2\n", force),
            "t.csv:2: F is \"1'234.5\", expected a number without thousands separators");
  EXPECT_EQ(table_complaint("F [N],b\n1,5,2\n", force),
            "t.csv:2: has 3 fields, expected 2 as in the header (line 1); decimal commas need "
            "semicolons or tabs between the columns");
}

// Rows are read from the file a second time when their numbers are requested, so the test truncates
// the file in between.
TEST(CsvTable, OfAFileThatIsCutMeanwhileKeepsItsRows) {
  const ScratchFolder folder;
  std::string text = "force [kN]\n";
  constexpr int kRows = 9'000'000;
  for (int i = 0; i < kRows; ++i) text += "1.000000\n";
  ASSERT_GT(text.size(), 64u << 20);
  write_text_file(folder / "large.csv", text);
  const CsvTable table = CsvTable::read(folder / "large.csv");
  std::filesystem::resize_file(folder / "large.csv", 20);
  const auto force = table.numbers("force", "N");
  ASSERT_EQ(force.size(), static_cast<std::size_t>(kRows));
  EXPECT_EQ(force.back(), 1000.0);
}

}  // namespace
}  // namespace latsch::formats
