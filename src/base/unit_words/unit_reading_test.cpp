// SPDX-License-Identifier: Apache-2.0
#include "base/unit_reading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/document.h"
#include "base/text.h"
#include "base/unit_words/unit_spellings_testing.h"

namespace latsch {
namespace {

// Relative tolerance. UDUNITS converts units with an offset by differences, which adds rounding.
constexpr double kRounding = 1e-12;

// Every spelling in the table of the tests is read with the factor that the table states, or is
// refused if the table says so.
TEST(UnitReading, EverySpellingOfTheTableIsReadAsByHand) {
  EXPECT_GE(std::size(unit_spellings::kAll), 220u);
  for (const UnitSpelling& spelling : unit_spellings::kAll) {
    const Unit expected = Unit::of(spelling.si);
    const UnitReading reading = reading_of_unit(spelling.written, expected);
    const bool fits = reading.unit && reading.unit->same_dimension(expected);
    if (std::isnan(spelling.factor)) {
      EXPECT_FALSE(fits) << spelling.written;
      continue;
    }
    ASSERT_TRUE(fits) << spelling.written << ": " << reading.fault;
    const double offset = reading.unit->to_si(0.0L), factor = reading.unit->to_si(1.0L) - offset;
    EXPECT_NEAR(factor / spelling.factor, 1.0, kRounding) << spelling.written;
    EXPECT_NEAR(offset, spelling.offset, 1e-9) << spelling.written;
  }
}

// The text that a reader keeps for a unit is read again as the same unit.
TEST(UnitReading, TheTextOfAUnitIsReadAgainAsThatUnit) {
  for (const UnitSpelling& spelling : unit_spellings::kAll) {
    const auto unit = find_unit(spelling.written, Unit::of(spelling.si));
    if (!unit || std::isnan(spelling.factor)) continue;
    const auto again = find_unit(unit->text(), Unit::of(spelling.si));
    ASSERT_TRUE(again) << spelling.written;
    EXPECT_EQ(again->to_si(1.0L), unit->to_si(1.0L)) << spelling.written;
  }
}

TEST(UnitReading, QuantitiesOfDocumentsAreReadByTheSameTable) {
  for (const UnitSpelling& spelling : unit_spellings::kAll) {
    if (std::string_view(spelling.written).find('\'') != std::string_view::npos) continue;
    const std::string text = std::string("x = '7 ") + spelling.written + "'\n";
    const Document document = Document::parse(text, "table.toml");
    try {
      const double si = document.root().quantity("x", spelling.si);
      ASSERT_FALSE(std::isnan(spelling.factor)) << spelling.written << " is read as " << si;
      EXPECT_NEAR(si / (7.0 * spelling.factor + spelling.offset), 1.0, kRounding)
          << spelling.written;
    } catch (const InputError& error) {
      EXPECT_TRUE(std::isnan(spelling.factor)) << error.what();
      EXPECT_NE(std::string(error.what()).find("table.toml:1: x is"), std::string::npos)
          << error.what();
    }
  }
}

TEST(UnitReading, WithoutADimensionWordsOfTwoMeaningsAreToldOrRefused) {
  EXPECT_EQ(reading_of_unit("lb").unit->to_si(1.0L), 4.4482216152605);
  EXPECT_EQ(reading_of_unit("lb").assumed,
            "\"lb\" is taken as \"lbf\", which may be a force or a mass: write \"lbf\" or \"lbm\"");
  for (const char* text : {"g", "kn", "\"", "mg", "oz"}) {
    EXPECT_FALSE(reading_of_unit(text).unit) << text;
    EXPECT_NE(reading_of_unit(text).fault.find("which may be"), std::string::npos) << text;
  }
  EXPECT_TRUE(reading_of_unit("g/cm^3").unit);
  EXPECT_EQ(reading_of_unit("").unit->text(), "1");
}

TEST(UnitReading, WordsThatUdunitsMakesByPrefixesAreRefused) {
  for (const char* text :
       {"Ms",      "Mm",     "ps",   "as",   "ET",  "a",    "pu",   "Gal",   "pt",    "aF",
        "furlong", "1 N/mm", "10 N", "m^99", "kkg", "m m_", "N//m", "/s",    "N*",    "deg deg(",
        "(m",      "m)",     "mu",   "are",  "T",   "Wb",   "u",    "force", "gamma", "Forces"})
    EXPECT_FALSE(Unit::find(text)) << text;
  EXPECT_EQ(unknown_unit("Ms"),
            "unit \"Ms\", which is not \"ms\", because case matters here: write \"ms\"");
  EXPECT_EQ(unknown_unit("ns"),
            "unit \"ns\", which is not known; with capitals, \"Ns\", it is N s");
}

TEST(UnitReading, ADocumentsPoundIsAMassWhereOneIsExpected) {
  const Document document =
      Document::parse("m = \"10 lb\"\nF = \"10 lb\"\na = \"2 g\"\nw = \"300 g\"\n", "d.toml");
  EXPECT_EQ(document.root().quantity("m", "kg"), 4.5359237);
  EXPECT_EQ(document.root().quantity("F", "N"), 44.482216152605);
  EXPECT_EQ(document.root().quantity("a", "m/s^2"), 19.6133);
  EXPECT_EQ(document.root().quantity("w", "kg"), 0.3);
}

}  // namespace
}  // namespace latsch
