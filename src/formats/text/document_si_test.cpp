// SPDX-License-Identifier: Apache-2.0
#include "formats/text/document_si.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cstdint>
#include <filesystem>

#include "base/error.h"
#include "base/units.h"
#include "formats/text/teim_orbit_si.h"

namespace latsch::formats {
namespace {

namespace fs = std::filesystem;

std::uint64_t bits_of_number(double value) { return std::bit_cast<std::uint64_t>(value); }

std::string in_si(const std::string& text) { return text_in_si(Document::parse(text, "t.toml")); }

TEST(DocumentSi, WritesEveryQuantityInCoherentUnits) {
  EXPECT_EQ(in_si("pressure = \"2.4 bar\"\n"), "pressure = \"240000 Pa\"\n");
  EXPECT_EQ(in_si("[a.b]\nangle = \"180 deg\"  # half a turn\n"),
            "a.b.angle = \"3.141592653589793 rad\"\n");
  EXPECT_EQ(in_si("k = \"4 kN m/deg\"\n"), "k = \"229183.1180523293 N m/rad\"\n");
  EXPECT_EQ(in_si("share = \"50 %\"\n"), "share = \"0.5 1\"\n");
  EXPECT_EQ(in_si("t = \"20 degC\"\n"), "t = \"293.15 K\"\n");
}

TEST(DocumentSi, WritesListsWithOneUnitOrWithOneForEach) {
  EXPECT_EQ(in_si("x = {unit = \"mm\", values = [[1, 20.5], [3, 4]]}\n"),
            "x = {unit = \"m\", values = [[0.001, 0.0205], [0.003, 0.004]]}\n");
  EXPECT_EQ(in_si("x = [[\"1 m/s\", \"3 kN\"], [\"2 m/s\", \"4 kN\"]]\n"),
            "x = [[\"1 m/s\", \"3000 N\"], [\"2 m/s\", \"4000 N\"]]\n");
  EXPECT_EQ(in_si("x = [{unit = \"mm\", values = [1]}, 2, 3.5]\n"),
            "x = [{unit = \"m\", values = [0.001]}, 2, 3.5]\n");
}

TEST(DocumentSi, LeavesTextsFlagsAndWholeNumbers) {
  const std::string text =
      "title = \"a \\\"tire\\\"\"\nversion = \"6.1\"\nsize = \"275/35R19\"\nlocked = true\n"
      "nodes = 80\n\"odd key\" = \"left\"\n";
  EXPECT_EQ(in_si(text), text);
}

TEST(DocumentSi, WritesTheNumbersAsTheyAreNow) {
  Document document = Document::parse("pressure = \"2.4 bar\"\nn = 3\n", "t.toml");
  document.set("pressure", 1.0 / 3.0);
  document.set("n", 4.5);
  EXPECT_EQ(text_in_si(document), "pressure = \"0.3333333333333333 Pa\"\nn = 4.5\n");
}

// The digits give the bits back by both ways in which they are read: through 64 bits of mantissa by
// the program, and directly as a double by a slim library.
TEST(DocumentSi, EveryNumberOfTheStudiesHasItsBitsAgain) {
  int numbers = 0;
  for (const auto& entry : fs::recursive_directory_iterator(LATSCH_SOURCE_DIR "/studies")) {
    // a study's expected results have keys with dots, which a document refuses
    if (entry.path().extension() != ".toml" || entry.path().stem() == "expected") continue;
    const Document written = Document::read(entry.path());
    const Document read = Document::parse(text_in_si(written), "si.toml");
    ASSERT_EQ(written.paths(), read.paths()) << entry.path();
    for (const std::string& path : written.paths()) {
      EXPECT_EQ(bits_of_number(written.get(path)), bits_of_number(read.get(path)))
          << entry.path() << ": " << path;
      EXPECT_EQ(written.unit(path), read.unit(path)) << entry.path() << ": " << path;
      const std::string digits = digits_of(written.get(path));
      double direct = 0.0;
      std::from_chars(digits.data(), digits.data() + digits.size(), direct);
      EXPECT_EQ(bits_of_number(direct), bits_of_number(written.get(path)));
      ++numbers;
    }
  }
  EXPECT_GT(numbers, 3000);
}

TEST(TeimOrbitSi, StatesTheScaleOfEveryUnit) {
  const std::string text =
      "[UNITS]\n LENGTH = 'mm'\n ANGLE = 'degrees'  $ of arc\n TIME = 'second'\n[MODEL]\n"
      " METHOD = '2D'\n LENGTH = 'mm'\n";
  EXPECT_EQ(with_si_units(text, "road.rdf"),
            "[UNITS]\n LENGTH = '0.001 m'\n ANGLE = '0.017453292519943295 rad'  $ of arc\n"
            " TIME = '1 s'\n[MODEL]\n METHOD = '2D'\n LENGTH = 'mm'\n");
  EXPECT_EQ(with_si_units("[MODEL]\n", "road.rdf"), "[MODEL]\n");
}

}  // namespace
}  // namespace latsch::formats
