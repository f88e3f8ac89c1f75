// SPDX-License-Identifier: Apache-2.0
#include "base/units.h"

#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <thread>

namespace latsch {
namespace {

double si(const char* text) {
  const auto quantity = parse_quantity(text);
  return quantity ? quantity->si : std::nan("");
}

// UDUNITS-2 reads decimals by the locale, which a program that contains Latsch may have set.
TEST(Units, DoNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  bool has_comma = false;
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE.utf8", "nl_NL.UTF-8"})
    has_comma =
        has_comma || (std::setlocale(LC_ALL, name) && *std::localeconv()->decimal_point == ',');
  // no other test reads these units first
  const double torr = si("2 torr"), horse = si("2 hp");
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_NEAR(torr, 2.0 * 101325.0 / 760.0, 1e-9);
  EXPECT_NEAR(horse, 2.0 * 745.6999, 1e-3);
  if (!has_comma) GTEST_SKIP() << "No locale with a decimal comma is installed.";
}

// The factors are exact by definition (BIPM, SI brochure; international inch and pound), so the
// bits of the literals are expected.
TEST(Units, DecimalUnitsGiveTheBitsOfTheLiteral) {
  EXPECT_EQ(si("2.6 bar"), 2.6e5);
  EXPECT_EQ(si("22.3 N/mm^2"), 22.3e6);
  EXPECT_EQ(si("310 mm"), 0.310);
  EXPECT_EQ(si("306.5 mm"), 0.3065);
  EXPECT_EQ(si("1e-3 in"), 2.54e-5);
  EXPECT_EQ(si("0.246 mm^2"), 0.246e-6);
  EXPECT_EQ(si("83kPa"), 83e3);
  EXPECT_EQ(si("1 lbf"), 4.4482216152605);
  EXPECT_EQ(si("-5 degC"), 268.15);
  EXPECT_EQ(si("50 %"), 0.5);
  EXPECT_EQ(si("90 deg"), std::numbers::pi / 2);
  EXPECT_EQ(si("1 rev"), 2 * std::numbers::pi);
  EXPECT_EQ(si("5 µm"), 5e-6);
  EXPECT_EQ(si("36 km/h"), 10.0);
}

TEST(Units, TextThatIsNoQuantityIsRefused) {
  for (const char* text : {"",
                           "bar",
                           "2.6",
                           "2.6 barr",
                           "2.6 3 bar",
                           "2,6 bar",
                           "1 dB",
                           "225/50R16",
                           "16x7.5-10",
                           "1 m^99999",
                           "3 seconds since 1970-01-01",
                           "5 lg(re 1 mW)",
                           "0x10 m",
                           "- 3 mm",
                           "1 ((((m",
                           "1 \xff\xfe"})
    EXPECT_FALSE(parse_quantity(text)) << text;
}

TEST(Units, AnAngleIsADimensionOfItsOwn) {
  EXPECT_FALSE(Unit::of("deg").same_dimension(Unit::of("1")));
  EXPECT_FALSE(Unit::of("rpm").same_dimension(Unit::of("Hz")));
  EXPECT_TRUE(Unit::of("N/mm^2").same_dimension(Unit::of("bar")));
  EXPECT_TRUE(Unit::of("Nm").same_dimension(Unit::of("J")));
}

TEST(Units, DimensionsHaveTheirSiUnitAndWords) {
  for (const char* unit : {"1",
                           "m",
                           "N",
                           "Pa",
                           "N/m",
                           "rad",
                           "Hz",
                           "kg/m^3",
                           "N m",
                           "rad/s",
                           "K",
                           "m/N",
                           "rad/N",
                           "rad/(N m)"})
    EXPECT_EQ(si_unit(Unit::of(unit).dimension()), unit);
  EXPECT_EQ(si_unit(Unit::of("V").dimension()), "m^2 kg s^-3 A^-1");
  EXPECT_EQ(words_for(Unit::of("rad")).noun, "an angle");
  EXPECT_EQ(words_for(Unit::of("rad")).example, "22 deg");
  EXPECT_EQ(unknown_unit("kpa"), "unknown unit \"kpa\", did you mean \"kPa\"?");
}

// Regression test: si_unit() wrote exponents of two digits, which find() did not read.
TEST(Units, TheSiUnitOfEveryUnitIsAUnitOfItsDimension) {
  for (const char* text :
       {"mm^9", "1/m^9", "N^4", "m^9 kg^-9 s^9 A^-9 K^9 mol^-9 cd^9 rad^-9", "kWh"}) {
    const Unit unit = Unit::of(text);
    const auto si = Unit::find(si_unit(unit.dimension()));
    ASSERT_TRUE(si) << text;
    EXPECT_TRUE(si->same_dimension(unit)) << text;
    EXPECT_EQ(si->to_si(1.0L), 1.0) << text;
  }
  EXPECT_FALSE(Unit::find("m^9 m^3"));
}

TEST(Units, EveryExampleIsAQuantityOfItsDimension) {
  for (const char* unit : {"m",
                           "N",
                           "Pa",
                           "N/m",
                           "rad",
                           "Hz",
                           "kg/m^3",
                           "N m",
                           "rad/s",
                           "K",
                           "W",
                           "V",
                           "m^3",
                           "kg m^2",
                           "N m/rad",
                           "Pa/m",
                           "1/m",
                           "Pa s",
                           "N s/m"}) {
    const auto example = parse_quantity(words_for(Unit::of(unit)).example);
    ASSERT_TRUE(example) << unit;
    EXPECT_TRUE(example->unit.same_dimension(Unit::of(unit))) << unit;
  }
}

TEST(Units, FormatsForAPerson) {
  EXPECT_EQ(format_quantity(2.6e5, "bar"), "2.6 bar");
  EXPECT_EQ(format_quantity(0.1, "1"), "0.1");
  EXPECT_EQ(format_quantity(std::numbers::pi, "deg", 3), "180 deg");
}

// Property: for any bits and any unit, the text gives the bits back.
TEST(Units, EverySiValueHasATextThatGivesItsBitsBack) {
  std::uint64_t state = 1;
  for (const char* name : {"bar", "mm", "in", "deg", "N/mm^2", "psi", "GPa", "lbf", "rpm", "1"}) {
    const Unit unit = Unit::of(name);
    for (int i = 0; i < 2000; ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      const double mantissa = 1.0 + static_cast<double>(state >> 12) * 0x1p-52;
      const double value =
          std::ldexp(i % 2 ? mantissa : -mantissa, static_cast<int>(state % 600) - 300);
      const auto back = parse_quantity(unit.exact_number(value) + " " + name);
      ASSERT_TRUE(back);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(back->si), std::bit_cast<std::uint64_t>(value))
          << name << " " << value;
    }
  }
}

TEST(Units, ShortNumbersStayShort) {
  EXPECT_EQ(Unit::of("N/mm^2").exact_number(22.3e6), "22.3");
  EXPECT_EQ(Unit::of("mm").exact_number(0.310), "310");
  EXPECT_EQ(Unit::of("bar").exact_number(2.6e5), "2.6");
  EXPECT_EQ(Unit::of("GPa").exact_number(0.0), "0");
}

TEST(Units, ThreadsMayAskAtOnce) {
  std::vector<std::thread> threads;
  std::vector<double> sums(4);
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&sums, t] {
      for (int i = 0; i < 500; ++i)
        sums[t] += Unit::find("mm^" + std::to_string(1 + i % 9))->to_si(1.0L);
    });
  for (std::thread& thread : threads) thread.join();
  for (int t = 1; t < 4; ++t) EXPECT_EQ(sums[t], sums[0]);
}

// strtold rounds correctly; every plain decimal must be read with the same bits.
TEST(SplitNumber, PlainDecimalsAreRoundedOnce) {
  std::uint64_t state = 1;
  for (int i = 0; i < 20'000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;  // Knuth's generator
    std::string text = std::to_string(state >> (i % 63));
    const std::size_t point = (state >> 7) % (text.size() + 1);
    if (point > 0 && point < text.size()) text.insert(text.begin() + point, '.');
    if (state % 3 == 0) text.insert(text.begin(), '-');
    const auto parts = split_number(text);
    ASSERT_TRUE(parts) << text;
    EXPECT_EQ(parts->number, std::strtold(text.c_str(), nullptr)) << text;
    EXPECT_EQ(parts->digits, text);
    EXPECT_TRUE(parts->rest.empty());
  }
  EXPECT_TRUE(std::signbit(split_number("-0.0")->number));
  for (const char* text : {"", "-", ".", "--1", "1-", "- 1"}) {
    const auto parts = split_number(text);
    EXPECT_FALSE(parts && parts->rest.empty()) << text;
  }
  EXPECT_EQ(split_number("1.2.3")->rest, ".3");
  EXPECT_EQ(split_number("5.")->number, 5.0L);
  EXPECT_EQ(split_number("5 mm")->rest, "mm");
}

}  // namespace
}  // namespace latsch
