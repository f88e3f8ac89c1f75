// SPDX-License-Identifier: Apache-2.0
#include "base/document.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

namespace latsch {
namespace {

constexpr const char* kTire = R"(# A tire.
name = "tire B"   # its name
size = "225/50R16"
pressure = "2.6 bar"

[section]
contour = {unit = "mm", values = [[0, 310], [45, 309],
                                  [75, 306.5]]}
thickness = [[0.0, "6 mm"], [0.5, "0.5 cm"]]
positions = ["0 mm", "5 mm"]

[rubber.tread]
poisson_ratio = 0.49
young_modulus = "22.3 N/mm^2"

[layer.carcass]
angle = "90 deg"
[layer.belt_1]
angle = "24deg"
lifted = true
[mesh]
sectors = 60
)";

Document tire() { return Document::parse(kTire, "tire.toml"); }

/// Returns the error message of parsing `text` and reading it by `read`, or "" if there is no
/// error.
std::string complaint(const std::string& text, const std::function<void(const Node&)>& read) {
  try {
    read(Document::parse(text, "t.toml").root());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Document, ReadsQuantitiesInSi) {
  const Node root = tire().root();
  EXPECT_EQ(root.quantity("pressure", "Pa", Range::positive()), 2.6e5);
  const Node section = root.table("section");
  EXPECT_EQ(section.rows("contour", {"m", "m"}),
            (std::vector<std::vector<double>>{{0.0, 0.31}, {0.045, 0.309}, {0.075, 0.3065}}));
  EXPECT_EQ(section.rows("thickness", {"1", "m"}),
            (std::vector<std::vector<double>>{{0.0, 0.006}, {0.5, 0.005}}));
  EXPECT_EQ(section.quantities("positions", "m"), (std::vector<double>{0.0, 0.005}));
  EXPECT_EQ(section.one_or_more("positions", "m"), (std::vector<double>{0.0, 0.005}));
  EXPECT_EQ(root.table("rubber").table("tread").quantity("poisson_ratio", "1"), 0.49);
  EXPECT_EQ(root.quantity("absent", "m", {}, 0.25), 0.25);
  EXPECT_EQ(root.table("mesh").integer("sectors", 1, 100), 60);
}

TEST(Document, AListWithAUnitMayHoldAValueInAnother) {
  const auto document = Document::parse("a = {unit = \"mm\", values = [5, \"1 cm\"]}", "t");
  EXPECT_EQ(document.root().quantities("a", "m"), (std::vector<double>{0.005, 0.01}));
  EXPECT_EQ(Document::parse("a = \"5 mm\"", "b.toml").root().one_or_more("a", "m"),
            std::vector<double>{0.005});
}

TEST(Document, NamedTablesComeInTheOrderOfTheFile) {
  const std::vector<Node> layers = tire().root().named_tables("layer");
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0].name(), "carcass");
  EXPECT_EQ(layers[1].path(), "layer.belt_1");
  EXPECT_EQ(layers[1].place().text(), "tire.toml:18");
  EXPECT_EQ(layers[1].quantity("angle", "rad"), 24 * std::numbers::pi / 180);
  EXPECT_TRUE(layers[1].flag("lifted", false));
  EXPECT_TRUE(tire().root().named_tables("absent").empty());
  const Node list = Document::parse("[[run]]\na = 1\n[[run]]\na = 2\n", "l").root();
  EXPECT_EQ(list.named_tables("run")[1].integer("a", 0, 9), 2);
}

TEST(Document, EveryNumberHasAPath) {
  const Document document = tire();
  EXPECT_EQ(document.paths(),
            (std::vector<std::string>{"pressure",
                                      "section.contour.0.0",
                                      "section.contour.0.1",
                                      "section.contour.1.0",
                                      "section.contour.1.1",
                                      "section.contour.2.0",
                                      "section.contour.2.1",
                                      "section.thickness.0.0",
                                      "section.thickness.0.1",
                                      "section.thickness.1.0",
                                      "section.thickness.1.1",
                                      "section.positions.0",
                                      "section.positions.1",
                                      "rubber.tread.poisson_ratio",
                                      "rubber.tread.young_modulus",
                                      "layer.carcass.angle",
                                      "layer.belt_1.angle",
                                      "mesh.sectors"}));
  EXPECT_EQ(document.get("section.contour.2.1"), 0.3065);
  EXPECT_EQ(document.unit("section.contour.2.1"), "m");
  EXPECT_EQ(document.unit("rubber.tread.young_modulus"), "Pa");
  EXPECT_EQ(document.unit("rubber.tread.poisson_ratio"), "1");
}

TEST(Document, ASetNumberStaysInItsUnitAndNothingElseChanges) {
  Document document = tire();
  EXPECT_EQ(document.text(), kTire);
  document.set("pressure", 3.1e5);
  document.set("section.contour.2.1", 0.3);
  document.set("section.thickness.1.1", 0.0045);
  document.set("layer.belt_1.angle", -25 * std::numbers::pi / 180);
  document.set("mesh.sectors", 61);
  document.set("rubber.tread.poisson_ratio", 1.0);
  std::string expected = kTire;
  const auto replace = [&](const std::string& old, const std::string& now) {
    expected.replace(expected.find(old), old.size(), now);
  };
  replace("2.6 bar", "3.1 bar");
  replace("306.5", "300.0");
  replace("0.5 cm", "0.45 cm");
  replace("24deg", "-25deg");
  replace("sectors = 60", "sectors = 61");
  replace("0.49", "1.0");
  EXPECT_EQ(document.text(), expected);
  EXPECT_EQ(document.root().quantity("pressure", "Pa"), 3.1e5);
}

TEST(Document, CopiesAndNodesReadEarlierKeepTheirValues) {
  Document document = tire();
  const Document copy = document;
  const Node earlier = document.root();
  document.set("pressure", 1e5);
  EXPECT_EQ(document.get("pressure"), 1e5);
  EXPECT_EQ(copy.get("pressure"), 2.6e5);
  EXPECT_EQ(earlier.quantity("pressure", "Pa"), 2.6e5);
}

// Property: get() returns exactly the bits that were set, and so does the text when it is read
// again.
TEST(Document, SetValuesComeBackBitForBitThroughTheText) {
  std::uint64_t state = 7;
  Document document = tire();
  const std::vector<std::string> paths = document.paths();
  for (int round = 0; round < 100; ++round) {
    std::vector<double> values;
    for (const std::string& path : paths) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      const double mantissa = 1.0 + static_cast<double>(state >> 12) * 0x1p-52;
      const int exponent = static_cast<int>((state >> 3) % 200) - 100;
      values.push_back(round == 0 ? -0.0 : std::ldexp(state & 1 ? mantissa : -mantissa, exponent));
      document.set(path, values.back());
    }
    const Document again = Document::parse(document.text(), "again.toml");
    ASSERT_EQ(again.paths(), paths);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const auto bits = std::bit_cast<std::uint64_t>(values[i]);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(document.get(paths[i])), bits) << paths[i];
      ASSERT_EQ(std::bit_cast<std::uint64_t>(again.get(paths[i])), bits) << paths[i];
    }
  }
}

TEST(Document, ChangesKeepTheirPlaceBesideForeignLettersAndLineEnds) {
  const std::string text =
      "\xef\xbb\xbf\"größe\" = \"5 µm\" # ä\r\nb = [1_000.5, 0x10, +2.5e3]\r\nc = '7 mm'\r\n";
  Document document = Document::parse(text, "t");
  EXPECT_EQ(document.get("größe"), 5e-6);
  EXPECT_EQ(document.get("b.0"), 1000.5);
  EXPECT_EQ(document.get("b.1"), 16.0);
  document.set("größe", 6e-6);
  document.set("b.0", 2.0);
  document.set("b.1", 17.0);
  document.set("b.2", -3.5);
  document.set("c", 8e-3);
  EXPECT_EQ(document.text(), "\"größe\" = \"6 µm\" # ä\r\nb = [2.0, 17, -3.5]\r\nc = \"8 mm\"\r\n");
}

TEST(Document, PathsThatLeadToNoNumberAreAnsweredWithTheNearest) {
  Document document = tire();
  try {
    document.set("rubber.tread.young_modulos", 1.0);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "tire.toml: no number at path \"rubber.tread.young_modulos\", did you mean "
                 "\"rubber.tread.young_modulus\"?");
  }
  EXPECT_THROW(document.get("name"), InputError);
  EXPECT_THROW(document.get("section"), InputError);
  EXPECT_THROW(document.get(""), InputError);
  EXPECT_THROW(document.set("pressure", std::nan("")), InputError);
}

TEST(DocumentComplaint, NamesPlaceFoundAndExpected) {
  const auto angle = [](const Node& root) { root.table("belt").quantity("angle", "rad"); };
  EXPECT_EQ(complaint("[belt]\nangle = \"22 N\"", angle),
            "t.toml:2: belt.angle is \"22 N\", expected an angle such as \"22 deg\"");
  EXPECT_EQ(
      complaint("[belt]\nangle = \"22 degg\"", angle),
      "t.toml:2: belt.angle is \"22 degg\", expected an angle such as \"22 deg\" (unknown unit "
      "\"degg\", did you mean \"deg\"?)");
  EXPECT_EQ(complaint("\n[belt]\n", angle),
            "t.toml:2: belt.angle is missing, expected an angle such as \"22 deg\"");
  EXPECT_EQ(complaint("[belt]\nangle = 22", angle),
            "t.toml:2: belt.angle is 22, expected an angle with its unit, such as \"22 deg\"");
  EXPECT_EQ(complaint("[belt]\nangle = \"nan deg\"", angle),
            "t.toml:2: belt.angle is \"nan deg\", expected a finite number");
  EXPECT_EQ(complaint("[belt]\nangle = true", angle),
            "t.toml:2: belt.angle is true, expected an angle such as \"22 deg\"");
  EXPECT_EQ(complaint("belt = 3", angle), "t.toml:1: belt is 3, expected a table");
  EXPECT_EQ(complaint("", angle), "t.toml:1: belt is missing, expected a table [belt]");
}

TEST(DocumentComplaint, AMissingKeyIsSoughtAmongTheMisspelled) {
  const auto read = [](const Node& root) {
    root.quantity("thickness_inside", "m");
    root.quantity("thickness_outside", "m");
  };
  EXPECT_EQ(complaint("\nthicknes_inside = \"2 mm\"", read),
            "t.toml:2: unknown key \"thicknes_inside\", did you mean \"thickness_inside\"?");
  EXPECT_EQ(complaint("\nthickness_outside = \"2 mm\"", read),
            "t.toml:1: thickness_inside is missing, expected a length such as \"25 mm\"");
  EXPECT_EQ(complaint("[msh]\nn = 1", [](const Node& root) { root.table("mesh"); }),
            "t.toml:1: unknown key \"msh\", did you mean \"mesh\"?");
}

TEST(DocumentComplaint, APressureNeedsItsUnitAndARange) {
  const auto pressure = [](const Node& root) {
    root.quantity("pressure", "Pa", Range::between(1e4, 1e6));
  };
  EXPECT_EQ(
      complaint("pressure = 2.6", pressure),
      "t.toml:1: pressure is 2.6, expected a pressure or modulus with its unit, such as \"2.6 "
      "bar\"");
  EXPECT_EQ(complaint("pressure = \"26 bar\"", pressure),
            "t.toml:1: pressure is \"26 bar\", expected 0.1 bar to 10 bar");
  const auto thickness = [](const Node& root) { root.quantity("t", "m", Range::positive()); };
  EXPECT_EQ(complaint("t = \"-2 mm\"", thickness),
            "t.toml:1: t is \"-2 mm\", expected more than 0 mm");
  EXPECT_EQ(complaint("t = \"1e999 mm\"", thickness),
            "t.toml:1: t is \"1e999 mm\", expected a finite number");
}

TEST(DocumentComplaint, PlainNumbersAreFiniteAndHaveNoUnit) {
  const auto ratio = [](const Node& root) { root.quantity("nu", "1", {0.0, 0.49999, true}); };
  EXPECT_EQ(complaint("nu = nan", ratio), "t.toml:1: nu is nan, expected a finite number");
  EXPECT_EQ(complaint("nu = -inf", ratio), "t.toml:1: nu is -inf, expected a finite number");
  EXPECT_EQ(complaint("nu = \"22 deg\"", ratio),
            "t.toml:1: nu is \"22 deg\", expected a plain number such as 0.5");
  EXPECT_EQ(complaint("nu = 0.5", ratio),
            "t.toml:1: nu is 0.5, expected more than 0 and at most 0.49999");
}

TEST(DocumentComplaint, RowsOfListsNameTheirOwnLine) {
  const auto rows = [](const Node& root) { root.rows("c", {"m", "m"}); };
  EXPECT_EQ(complaint("c = [[\"1 mm\", \"2 mm\"],\n[\"1 mm\"]]", rows),
            "t.toml:2: c.1 has 1 values, expected 2 in every row");
  EXPECT_EQ(complaint("c = [[\"1 mm\",\n\"2 bar\"]]", rows),
            "t.toml:2: c.0.1 is \"2 bar\", expected a length such as \"25 mm\"");
  EXPECT_EQ(complaint("c = {unit = \"mmm\", values = [[1, 2]]}", rows),
            "t.toml:1: c.0.0 is \"1 mmm\", expected a length such as \"25 mm\" (unknown unit "
            "\"mmm\", did you mean \"mm\"?)");
}

TEST(DocumentComplaint, ChoicesAndIntegersNameWhatIsAllowed) {
  EXPECT_EQ(complaint("law = \"neo-hook\"",
                      [](const Node& root) {
                        root.choice("law", {"neo-Hooke", "Mooney-Rivlin"});
                      }),
            "t.toml:1: law is \"neo-hook\", expected \"neo-Hooke\" or \"Mooney-Rivlin\", did you "
            "mean \"neo-Hooke\"?");
  const auto integer = [](const Node& root) { root.integer("n", 4, 2000); };
  EXPECT_EQ(complaint("n = 2", integer), "t.toml:1: n is 2, expected an integer from 4 to 2000");
  EXPECT_EQ(complaint("n = 2.5", integer),
            "t.toml:1: n is 2.5, expected an integer from 4 to 2000");
}

TEST(DocumentClose, RejectsKeysNobodyAskedFor) {
  const auto read = [](const Node& root) {
    root.quantity("pressure", "Pa", {}, 1e5);
    if (const auto mesh = root.find_table("mesh")) mesh->integer("sectors", 1, 100, 60);
    for (const Node& layer : root.named_tables("layer")) layer.quantity("angle", "rad", {}, 0.0);
    root.close();
  };
  EXPECT_EQ(
      complaint("pressure = \"1 bar\"\n[mesh]\nsectors = 3\n[layer.a]\nangle = \"1 deg\"", read),
      "");
  EXPECT_EQ(complaint("name = 1\npresure = \"1 bar\"", read), "t.toml:1: unknown key \"name\"");
  EXPECT_EQ(complaint("\npresure = \"1 bar\"", read),
            "t.toml:2: unknown key \"presure\", did you mean \"pressure\"?");
  EXPECT_EQ(complaint("[mesh]\nsectors = 3\nsector = 3", read),
            "t.toml:3: unknown key \"mesh.sector\", did you mean \"sectors\"?");
  EXPECT_EQ(complaint("[layer.a]\nangel = \"1 deg\"", read),
            "t.toml:2: unknown key \"layer.a.angel\", did you mean \"angle\"?");
  EXPECT_EQ(complaint("[[layer]]\nangel = \"1 deg\"", read),
            "t.toml:2: unknown key \"layer.0.angel\", did you mean \"angle\"?");
  EXPECT_EQ(complaint("[msh]\nsectors = 3", read),
            "t.toml:1: unknown key \"msh\", did you mean \"mesh\"?");
}

TEST(DocumentLimits, SyntaxSizeAndDepth) {
  const auto nothing = [](const Node&) {};
  EXPECT_EQ(complaint("a = 1\nb = = 2", nothing).find("t.toml:2: not valid TOML: "), 0u);
  EXPECT_NE(complaint("a = 1\na = 2", nothing).find("t.toml:2"), std::string::npos);
  EXPECT_NE(complaint(std::string(5u << 20, '#'), nothing).find("expected at most"),
            std::string::npos);
  const std::string deep = "t.toml:1: nested deeper than 16 levels";
  EXPECT_EQ(complaint("a = " + std::string(17, '[') + std::string(17, ']'), nothing), deep);
  EXPECT_EQ(complaint("a = " + std::string(1000000, '['), nothing), deep);
  std::string keys = "a";
  for (int i = 0; i < 1000000; ++i) keys += ".a";
  EXPECT_EQ(complaint(keys + " = 1", nothing), deep);
  EXPECT_EQ(complaint("[" + keys + "]", nothing), deep);
  EXPECT_EQ(complaint("a = " + std::string(15, '[') + std::string(15, ']'), nothing), "");
  EXPECT_NE(complaint("\"a.b\" = 1", nothing), "");
  std::string flood = "a = [";
  for (int i = 0; i < 1000000; ++i) flood += "1,";
  EXPECT_EQ(complaint(flood + "]", nothing), "t.toml:1: holds more than 50000 values");
}

// The time of reading a line is proportional to its length. It was not when each value was searched
// for from the beginning of the line: 50,000 values on one line took 4 s.
TEST(DocumentLimits, LongLinesAreReadInProportionToTheirLength) {
  std::string text = "a = [";
  for (int i = 0; i < 49000; ++i) text += "1, ";
  Document document = Document::parse(text + "]", "t.toml");
  document.set("a.48999", 2.0);
  EXPECT_EQ(document.text(), text.substr(0, text.size() - 3) + "2, ]");
}

TEST(DocumentLimits, AMissingFileIsNamed) {
  try {
    Document::read("/nonexistent/tire.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "/nonexistent/tire.toml: cannot be opened: No such file or directory");
  }
}

}  // namespace
}  // namespace latsch
