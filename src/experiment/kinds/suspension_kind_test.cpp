// SPDX-License-Identifier: Apache-2.0
// A suspension whose bushings are in files of their own.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "experiment/language.h"
#include "formats/car/bus_file.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::experiment {
namespace {

/// Test of a study's front suspension with these keys at its upper ball joint.
class BushingsOfFiles : public testing::Test {
 protected:
  BushingsOfFiles() {
    bushing_.stiffness = {1.1e7, 0.0, 1.3e7};
    bushing_.rotational = {110.0, 120.0, 130.0};
    bushing_.damping = {1e3, 2e3, 3e3};
    bushing_.rotational_damping = {1.0, 2.0, 3.0};
    bushing_.parts = {{1,
                       multibody::ElasticCurve{multibody::ForceCharacteristic(
                           {{-1e-3, -9e3}, {0.0, 0.0}, {1e-3, 12e3}})}}};
    write_text_file(folder_ / "rubber.bus", formats::bus_text(bushing_, "ubj"));
    text_ = read_text_file(std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/kerb/front.toml",
                           1u << 20);
  }
  Document read_with(const std::string& own) {
    write_text_file(folder_ / "front.toml", text_ + "\n[bushing.ubj]\n" + own);
    return language().find_kind("suspension")->read(folder_ / "front.toml");
  }
  std::string complaint_with(const std::string& own) {
    try {
      read_with(own);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }
  /// Returns "front.toml:", and the number of the line that contains `part`, counted from 1.
  std::string place_of(const std::string& part) const {
    const std::string text = read_text_file(folder_ / "front.toml");
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(part));
    return "front.toml:" + std::to_string(1 + std::count(text.begin(), end, '\n')) + ": ";
  }

  ScratchFolder folder_;
  std::string text_;
  multibody::BushingParameters bushing_;
};

TEST_F(BushingsOfFiles, BecomeNumbersOfTheSuspension) {
  Document numbers = read_with("file = \"rubber.bus\"\nfriction.x = [[\"40 N\", \"20 kN/mm\"]]\n");
  using suspension::DoubleWishbone;
  const auto corner = suspension::read_suspension(numbers.root());
  multibody::BushingParameters expected = bushing_;
  expected.parts.insert(expected.parts.begin(), {0, multibody::Friction{2e7, 40.0}});
  EXPECT_TRUE(corner.bushings[DoubleWishbone::kUbj] == expected);
  EXPECT_EQ(numbers.get("bushing.ubj.x"), 1.1e7);
  EXPECT_EQ(numbers.get("bushing.ubj.curve.y.2.1"), 12e3);
  EXPECT_EQ(numbers.get("bushing.ubj.viscous.about_z"), 3.0);
  numbers.set("bushing.ubj.x", 5e6);
  EXPECT_EQ(
      suspension::read_suspension(numbers.root()).bushings[DoubleWishbone::kUbj].stiffness.x(),
      5e6);
  // The written file does not need the bushing's file any more.
  std::filesystem::remove(folder_ / "rubber.bus");
  write_text_file(folder_ / "written.toml", numbers.text());
  EXPECT_EQ(language().find_kind("suspension")->read(folder_ / "written.toml").get("bushing.ubj.x"),
            5e6);
}

TEST_F(BushingsOfFiles, AnErrorNamesTheLineOfTheFileAsItStands) {
  const std::string two = "file = \"rubber.bus\"\n[bushing.lbj]\nfile = \"rubber.bus\"\n";
  EXPECT_EQ(complaint_with(two), "none");
  std::string said = complaint_with(two + "[bushing.lca_rear]\nx = \"3 N\"\n");
  EXPECT_NE(said.find(place_of("x = \"3 N\"")), std::string::npos) << said;
  EXPECT_NE(said.find("bushing.lca_rear.x"), std::string::npos) << said;
  said = complaint_with("file = \"rubber.bus\"\nfrction.x = [[\"40 N\", \"20 kN/mm\"]]\n");
  EXPECT_NE(said.find(place_of("frction")), std::string::npos) << said;
  EXPECT_NE(said.find("did you mean \"friction\""), std::string::npos) << said;
}

TEST_F(BushingsOfFiles, AFileStandsInThePlaceOfSpringsAndDampers) {
  for (const std::string key : {"x = \"1 N/m\"",
                                "about_z = \"1 N m/rad\"",
                                "rigid = true",
                                "damping = \"1 ms\"",
                                "curve.x = [[\"-1 m\", \"-1 N\"], [\"1 m\", \"1 N\"]]",
                                "viscous.x = \"1 N s/m\""}) {
    const std::string said = complaint_with("file = \"rubber.bus\"\n" + key + "\n");
    EXPECT_NE(said.find("is given beside file"), std::string::npos) << said;
    EXPECT_NE(said.find("bushing.ubj."), std::string::npos) << said;
  }
}

TEST_F(BushingsOfFiles, WhatIsWrongInThemIsSaidOfThem) {
  EXPECT_NE(complaint_with("file = \"none.bus\"\n").find("none.bus"), std::string::npos);
  write_text_file(folder_ / "bad.bus", "[MDI_HEADER]\nFILE_TYPE = 'spr'\n");
  const std::string said = complaint_with("file = \"bad.bus\"\n");
  EXPECT_NE(said.find("bad.bus:2: "), std::string::npos) << said;
}

/// Returns the notes about the front suspension of a study after a change of its text.
std::string notes_with(const std::string& old_text, const std::string& new_text) {
  std::string text = read_text_file(
      std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/kerb/front.toml", 1u << 20);
  const auto at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  if (at != std::string::npos) text.replace(at, old_text.size(), new_text);
  const ScratchFolder folder;
  write_text_file(folder.path() / "front.toml", text);
  std::string all;
  for (const std::string& note :
       language().find_kind("suspension")->notes(folder.path() / "front.toml"))
    all += note + "\n";
  return all;
}

TEST(HardpointsOfNoSuspension, AreDoubted) {
  EXPECT_EQ(notes_with("lbj =", "lbj ="), "");
  const auto expect_note = [](const char* old_text, const char* new_text, const char* said) {
    const std::string notes = notes_with(old_text, new_text);
    EXPECT_NE(notes.find(said), std::string::npos) << new_text << ": " << notes;
  };
  expect_note("\"118.540 mm\"", "\"1185.40 mm\"", "trackrod");
  expect_note("contact = [\"1550.000 mm\", \"612.500 mm\"",
              "contact = [\"1550.000 mm\", \"1612.500 mm\"",
              "hardpoint.contact is 1000 mm beside");
  expect_note("\"350.000 mm\"]", "\"100.000 mm\"]", "are the two exchanged?");
  expect_note("trackrod_inner = [\"1490.000 mm\", \"266.310 mm\"",
              "trackrod_inner = [\"1490.000 mm\", \"2663.10 mm\"",
              "the inner end of link trackrod is");
  expect_note("trackrod_inner = [\"1490.000 mm\", \"266.310 mm\"",
              "trackrod_inner = [\"1490.000 mm\", \"-266.310 mm\"",
              "266.31 mm beyond the middle of the car");
  expect_note("trackrod_inner = [\"1490.000 mm\", \"266.310 mm\"",
              "trackrod_inner = [\"14900.00 mm\", \"266.310 mm\"",
              "the inner end of link trackrod is 13");
}

TEST(HardpointsOfNoSuspension, AreDoubtedIfAllAreInAnotherUnit) {
  for (const auto& [unit, radius] : {std::pair{"in", "5969 mm above"}, {"cm", "2350 mm above"}}) {
    std::string text = read_text_file(
        std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/kerb/front.toml", 1u << 20);
    const std::size_t begin = text.find("[hardpoint]"), end = text.find("\n[", begin);
    std::string points = text.substr(begin, end - begin);
    for (std::size_t at = points.find("mm\""); at != points.npos; at = points.find("mm\"", at + 1))
      points.replace(at, 2, unit);
    text.replace(begin, end - begin, points);
    const ScratchFolder folder;
    write_text_file(folder.path() / "front.toml", text);
    std::string all;
    for (const std::string& note :
         language().find_kind("suspension")->notes(folder.path() / "front.toml"))
      all += note + "\n";
    EXPECT_NE(all.find(radius), std::string::npos) << all;
    EXPECT_NE(all.find("are all coordinates in another unit?"), std::string::npos) << all;
  }
}

}  // namespace
}  // namespace latsch::experiment
