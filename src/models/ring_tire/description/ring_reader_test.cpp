// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/description/ring_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace latsch::ring_tire {
namespace {

Document example() {
  return Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) /
                        "studies/ring_tires/passenger_205_55R16.toml");
}

TEST(RingReader, ReadsEveryNumberInItsUnit) {
  const RingParameters ring = read_ring_tire(example().root());
  EXPECT_DOUBLE_EQ(ring.belt.radius, 0.305);
  EXPECT_DOUBLE_EQ(ring.belt.pressure, 2.4e5);
  EXPECT_EQ(ring.nodes, 80);
  EXPECT_NEAR(ring.tread.young_modulus, 5.92e6, 0.01e6);  // modulus of Shore 70
}

TEST(RingReader, EveryNumberCanBeVaried) {
  Document document = example();
  document.set("sidewall.radial.stiffness", 6.0e5);
  document.set("tread.shore_a", 60.0);
  const RingParameters ring = read_ring_tire(document.root());
  EXPECT_DOUBLE_EQ(ring.sidewall.radial.stiffness, 6.0e5);
  EXPECT_NEAR(ring.tread.young_modulus, 3.70e6, 0.01e6);
}

TEST(RingReader, KnowsTheRimAndWhatPressureDoesToTheSidewall) {
  std::string text = example().text();
  const double own = read_ring_tire(example().root()).sidewall.radial.stiffness;
  text.insert(text.find("[sidewall]") + 10,
              "\npressure_share = 0.6\nreference_pressure = \"2 bar\"\n"
              "rim = {travel = \"70 mm\", stiffness = \"5 MN/m^2\"}");
  const Document document = Document::parse(text, "tire.toml");
  const RingParameters ring = read_ring_tire(document.root());
  EXPECT_DOUBLE_EQ(ring.sidewall.rim_travel, 0.07);
  EXPECT_DOUBLE_EQ(ring.sidewall.rim_stiffness, 5e6);
  EXPECT_NEAR(ring.sidewall.radial.stiffness, own * (1.0 + 0.6 * 0.2), 1e-9 * own);  // at 2.4 bar
  Document without = document;  // a varied share may become 0
  without.set("sidewall.pressure_share", 0.0);
  EXPECT_DOUBLE_EQ(read_ring_tire(without.root()).sidewall.radial.stiffness, own);
}

// Coupling that would make energies of bending and twist negative is refused.
TEST(RingReader, KnowsDampingPliesAndConeOfTheBelt) {
  const auto with = [](const std::string& keys) {
    std::string text = example().text();
    text.insert(text.find("[belt]") + 6, "\n" + keys);
    return read_ring_tire(Document::parse(text, "tire.toml").root()).belt;
  };
  const Belt belt = with(
      "damping_time = \"0.1 ms\"\nextension_damping_time = \"2 us\"\n"
      "bending_twist = \"-3 N m^2\"\nconicity = \"0.2 deg\"");
  EXPECT_DOUBLE_EQ(belt.damping_time, 1e-4);
  EXPECT_DOUBLE_EQ(belt.extension_damping_time, 2e-6);
  EXPECT_DOUBLE_EQ(belt.bending_twist, -3.0);
  EXPECT_NEAR(belt.conicity, 0.2 * M_PI / 180.0, 1e-12);
  EXPECT_THROW(with("bending_twist = \"200 N m^2\""), InputError);
}

TEST(RingReader, KnowsWhereTheTreadBottomsOut) {
  EXPECT_EQ(read_ring_tire(example().root()).tread.bottoming, 0.0);
  const auto with = [](const std::string& share) {
    std::string text = example().text();
    text.insert(text.find("[tread]") + 7, "\nbottoming = " + share);
    return read_ring_tire(Document::parse(text, "tire.toml").root()).tread.bottoming;
  };
  EXPECT_DOUBLE_EQ(with("0.4"), 0.4);
  EXPECT_EQ(with("0"), 0.0);
  EXPECT_THROW(with("1.1"), InputError);
}

TEST(RingReader, KnowsWhatIsNotTheSameAllAround) {
  const auto with = [](const std::string& keys) {
    return read_ring_tire(
               Document::parse(example().text() + "\n[uniformity]\n" + keys, "tire.toml").root())
        .uniformity;
  };
  const Uniformity u = with(
      "imbalance = \"20 g\"\nimbalance_angle = \"90 deg\"\n"
      "radial_runout = [\"0.3 mm\", \"0.1 mm\"]\n"
      "radial_runout_angle = [\"0 deg\", \"180 deg\"]\n"
      "lateral_runout = [\"0.4 mm\"]");
  EXPECT_DOUBLE_EQ(u.imbalance, 0.02);
  EXPECT_DOUBLE_EQ(u.imbalance_angle, 0.5 * M_PI);
  ASSERT_EQ(u.radial_runout.size(), 2u);
  EXPECT_DOUBLE_EQ(u.radial_runout[1].amplitude, 1e-4);
  EXPECT_DOUBLE_EQ(u.radial_runout[1].angle, M_PI);
  ASSERT_EQ(u.lateral_runout.size(), 1u);
  EXPECT_EQ(u.lateral_runout[0].angle, 0.0);
  EXPECT_NEAR(runout_at(u.radial_runout, 0.5 * M_PI), -1e-4, 1e-12);
  EXPECT_THROW(with("radial_runout = [\"0.3 mm\"]\nradial_runout_angle = [\"0 deg\", \"1 deg\"]"),
               InputError);
  EXPECT_THROW(with("radial_runout_angle = [\"0 deg\"]"), InputError);
}

TEST(RingReader, ComplaintsNameThePlace) {
  std::string text = example().text();
  text.insert(text.find("[belt]"), "presure_gain = 1\n");
  try {
    read_ring_tire(Document::parse(text, "tire.toml").root());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("presure_gain"), std::string::npos) << error.what();
  }
}

// An old file, in which names have other meanings, is refused rather than read without them.
TEST(RingReader, SaysWhatANumberIsCalledNow) {
  for (const auto& [old, now] : {std::pair("bending_lateral", "bending_out_of_plane"),
                                 std::pair("section_bending", "bending_across")}) {
    std::string text = example().text();
    text.insert(text.find("[belt]") + 6, std::string("\n") + old + " = \"88 N m^2\"");
    try {
      read_ring_tire(Document::parse(text, "tire.toml").root());
      FAIL() << old;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("is called ") + now), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace latsch::ring_tire
