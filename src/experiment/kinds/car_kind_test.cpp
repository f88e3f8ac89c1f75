// SPDX-License-Identifier: Apache-2.0
// Tests the tires of a car: each side has the tire that the file states for it, or the mirror image
// of the other side's tire, of any kind.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <regex>
#include <typeinfo>

#include "base/file.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"

namespace latsch::experiment {
namespace {

namespace fs = std::filesystem;

const fs::path kShipped = fs::path(LATSCH_SOURCE_DIR) / "studies";

class CarFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::temp_directory_path() /
        ("car_kind_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::create_directories(folder_);
    for (const char* file : {"front_rigid.toml", "rear_rigid.toml"})
      fs::copy_file(kShipped / "kerb" / file, folder_ / file, fs::copy_options::overwrite_existing);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string with(std::string text, const std::string& pattern, const std::string& by) {
    EXPECT_TRUE(std::regex_search(text, std::regex(pattern))) << pattern;
    return std::regex_replace(text, std::regex(pattern), by);
  }
  /// Writes a tire that pulls to one side; if `side` is empty, the file states no side.
  void write_slick(const std::string& name, const std::string& side) {
    std::string text = read_text_file(kShipped / "kerb/slick.tir");
    text = with(text, "PHY1 = 0", "PHY1 = 0.004");
    text = with(text, "PVY1 = 0", "PVY1 = 0.02");
    text = with(text, "TYRESIDE = 'LEFT'\n", side.empty() ? "" : "TYRESIDE = '" + side + "'\n");
    write_text_file(folder_ / name, text);
  }
  /// Writes the slick as a flexible ring, with ply steer and conicity.
  void write_ring(const std::string& name, const std::string& side) {
    std::string text = read_text_file(kShipped / "kerb/slick_ring.toml");
    text = with(
        text, "\\[belt\\]\n", "[belt]\nconicity = \"0.3 deg\"\nbending_twist = \"-3 N m^2\"\n");
    if (!side.empty()) text = "side = \"" + side + "\"\n" + text;
    write_text_file(folder_ / name, text);
  }
  /// Writes a rigid ring of the slick's size.
  void write_rigid_ring(const std::string& name, const std::string& side) {
    std::string text = read_text_file(kShipped / "tire_model_comparison/rigid_ring.tir");
    text = with(text, "UNLOADED_RADIUS *= *[0-9.]+", "UNLOADED_RADIUS = 0.235");
    text = with(text, "RIM_RADIUS *= *[0-9.]+", "RIM_RADIUS = 0.127");
    text = std::regex_replace(text, std::regex("TYRESIDE *= *'[A-Z]*'\n"), "");
    text = with(text, "\\[MODEL\\]\n", "[MODEL]\nTYRESIDE = '" + side + "'\n");
    write_text_file(folder_ / name, text);
  }
  /// Writes the finite-element race tire on a coarse mesh, with losses.
  void write_elements(const std::string& name) {
    std::string text = read_text_file(kShipped / "tires/race_16x7.5-10.toml");
    text = with(text, "columns = \\[[^\n]*\nsplit_columns[^\n]*\n", "meridional = 13\n");
    text = with(text, "sectors = 60\n", "sectors = 36\n");
    text =
        with(text, "sector_zones = [^\n]*\n", "sector_zones = [[6, \"4 deg\"], [2, \"8 deg\"]]\n");
    text = with(text, "poisson_ratio = 0.49\n", "poisson_ratio = 0.49\nloss_factor = 0.15\n");
    write_text_file(folder_ / name, text);
  }
  fs::path write_car(const std::string& tires) {
    std::string text = read_text_file(kShipped / "kerb/baseline.toml");
    text = with(text, "front_tire = \"slick.tir\"\nrear_tire = \"slick.tir\"\n", tires);
    write_text_file(folder_ / "car.toml", text);
    return folder_ / "car.toml";
  }
  std::unique_ptr<car::Car> car_of(const std::string& tires) {
    const SpecimenKind& kind = *language().find_kind("car");
    const auto specimen = kind.build(kind.read(write_car(tires)));
    auto car = specimen->find<Drives>()->car({});
    EXPECT_TRUE(car) << car.failure().reason;
    return std::move(*car);
  }

  struct Straight {
    // sum of the side forces at the start and mean of |Fy|, N; lateral drift, m
    double side = 0.0, mean = 0.0, drift = 0.0;
  };
  /// Drives the car straight ahead for `lasts` seconds.
  static Straight run(car::Car& car, double speed, double lasts = 0.5) {
    const road::PlaneRoad flat;
    auto state = car.settle(flat, speed, {});
    EXPECT_TRUE(state) << state.failure().reason;
    Straight found;
    for (const car::WheelState& wheel : state->wheels) {
      const double Fy = (wheel.motion.carrier * wheel.hub.force).y();
      found.side += Fy;
      found.mean += 0.25 * std::abs(Fy);
    }
    const auto y = [&] { return state->bodies.poses[0].place.y(); };
    const double start = y();
    while (state->time() < lasts) {
      const auto done = car.advance(*state, 2e-4, flat, {});
      EXPECT_TRUE(done.ok()) << done.failure().reason;
      if (!done) break;
      found.drift = std::max(found.drift, std::abs(y() - start));
    }
    return found;
  }

  fs::path folder_;
};

TEST_F(CarFile, OneTireOnBothSidesIsItsMirrorImageOnTheOther) {
  for (const std::string side : {"LEFT", "RIGHT", "SYMMETRIC", ""}) {
    write_slick("tire.tir", side);
    const auto car = car_of("front_tire = \"tire.tir\"\nrear_tire = \"tire.tir\"\n");
    const Straight found = run(*car, 30.0);
    EXPECT_GT(found.mean, 1.0) << side;
    // The error of the equilibrium is rounding in rigid joints, 1e-5 N, which is 1e-9 of the tires'
    // forces.
    EXPECT_NEAR(found.side, 0.0, 1e-9 * found.mean) << side;
    EXPECT_LT(found.drift, 1e-9) << side;
  }
}

TEST_F(CarFile, ALeftTireOnTheRightPullsAsItsRightTwinDoesTheOtherWay) {
  write_slick("left.tir", "LEFT");
  write_slick("right.tir", "RIGHT");
  const auto pull = [&](const char* left, const char* right) {
    std::string tires;
    for (const char* axle : {"front", "rear"})
      tires +=
          fmt::format("{0}_tire = \"{1}.tir\"\n{0}_tire_right = \"{2}.tir\"\n", axle, left, right);
    return run(*car_of(tires), 30.0, 0.05);
  };
  // Each tire is mounted on the side that its file states: equal tires pull in equal directions.
  const Straight alike = pull("left", "right");
  EXPECT_GT(std::abs(alike.side), 3.9 * alike.mean);
  // Each tire is mounted on the opposite side, so it is the mirror image of itself.
  const Straight swapped = pull("right", "left");
  EXPECT_NEAR(swapped.side, -alike.side, 1e-6 * std::abs(alike.side));
  EXPECT_NEAR(pull("left", "left").side, 0.0, 1e-9 * alike.mean);
}

TEST_F(CarFile, RingsWithPlySteerAreMirroredToo) {
  write_ring("ring.toml", "right");
  const auto car = car_of("front_tire = \"ring.toml\"\nrear_tire = \"ring.toml\"\n");
  const Straight found = run(*car, 20.0, 0.05);
  EXPECT_GT(found.mean, 1.0);
  EXPECT_NEAR(found.side, 0.0, 1e-6 * found.mean);
  EXPECT_LT(found.drift, 1e-8);
}

TEST_F(CarFile, ARigidRingRollsOnACarWhereTheCarSaysSo) {
  write_rigid_ring("tire.tir", "LEFT");
  const auto car = car_of(
      "front_tire = \"tire.tir\"\nrear_tire = \"tire.tir\"\n"
      "front_tire_kind = \"rigid_ring\"\nrear_tire_kind = \"rigid_ring\"\n");
  const Straight found = run(*car, 20.0, 0.1);
  EXPECT_NEAR(found.side, 0.0, 1e-6);
  EXPECT_LT(found.drift, 1e-6);
  // The tires are rigid rings, whose belts vibrate, not Magic Formulas with the same coefficients.
  const auto formula = car_of("front_tire = \"tire.tir\"\nrear_tire = \"tire.tir\"\n");
  const auto a = car->settle(road::PlaneRoad{}, 20.0, {}),
             b = formula->settle(road::PlaneRoad{}, 20.0, {});
  ASSERT_TRUE(a && b);
  const Tire &ring = *a->wheels[0].tire, &plain = *b->wheels[0].tire;
  EXPECT_TRUE(typeid(ring) != typeid(plain));
}

// Finite-element tires start steadily, carry the car, and feel a bump that both front wheels cross.
// Ply steer makes both sides mirror images of each other until the bump is reached. On the bump
// each tire halves steps that fail by its own rounding, which depends on the processor, and on this
// coarse mesh halved steps change forces by a tenth and more, so the sides are not compared there.
TEST_F(CarFile, RollsOverABumpOnFiniteElementTires) {
  constexpr double kSpeed = 20.0, kStep = 1e-3;
  write_elements("elements.toml");
  const auto car = car_of("front_tire = \"elements.toml\"\nrear_tire = \"elements.toml\"\n");
  const double axle = car->parts().corners[car::kFL].wheel_center.x();
  road::ProfileRoad::Settings settings;
  settings.along = road::cleat_profile(0.006, 0.12, 0.006);
  settings.origin.x() = axle + 0.3;
  const road::ProfileRoad road(settings);
  auto state = car->settle(road, kSpeed, {});
  ASSERT_TRUE(state) << state.failure().reason;
  const auto before = car->vertical_forces(*state);
  const double weight = car->mechanism().mass() * car->parameters().gravity;
  EXPECT_NEAR(before[0] + before[1] + before[2] + before[3], weight, 1e-3 * weight);
  constexpr int kReached = 10;  // steps until the patch reaches the bump
  double most = 0.0, most_right = 0.0;
  for (int k = 0; k < 24; ++k) {
    const auto done = car->advance(*state, kStep, road, {});
    ASSERT_TRUE(done.ok()) << done.failure().reason;
    const auto now = car->vertical_forces(*state);
    most = std::max(most, now[car::kFL] - before[car::kFL]);
    most_right = std::max(most_right, now[car::kFR] - before[car::kFR]);
    if (k < kReached) EXPECT_NEAR(now[car::kFL], now[car::kFR], 2e-3 * before[car::kFL]) << k;
    EXPECT_NEAR(now[car::kRL], before[car::kRL], 0.1 * before[car::kRL]) << k;
  }
  EXPECT_GT(most, 0.2 * before[car::kFL]);
  EXPECT_GT(most_right, 0.2 * before[car::kFR]);
  EXPECT_GT(*state->wheels[car::kFL].tire->road_load(), 0.0);
}

TEST_F(CarFile, WhatNoReaderAsksForIsRefused) {
  write_slick("tire.tir", "LEFT");
  const SpecimenKind& kind = *language().find_kind("car");
  const std::string tires = "front_tire = \"tire.tir\"\nrear_tire = \"tire.tir\"\n";
  const auto complaint = [&](const std::string& keys) -> std::string {
    try {
      kind.read(write_car(tires + keys));
      return "none";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(complaint(""), "none");
  EXPECT_NE(complaint("frnt_tire_right = \"tire.tir\"\n").find("is no key of a car"),
            std::string::npos);
  EXPECT_NE(complaint("front_tire_kind = \"brush\"\n").find("front_tire_kind"), std::string::npos);
  EXPECT_NE(complaint("rear_tire_right = \"none.tir\"\n").find("none.tir"), std::string::npos);
}

TEST_F(CarFile, AFileThatStatesNoSideIsSaid) {
  write_slick("tire.tir", "");
  write_ring("ring.toml", "");
  const fs::path car = write_car("front_tire = \"tire.tir\"\nrear_tire = \"ring.toml\"\n");
  const auto notes = language().find_kind("car")->notes(car);
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_NE(notes[2].find("without the weight of their belts"), std::string::npos) << notes[2];
  EXPECT_NE(notes[0].find("states no TYRESIDE"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("states no side"), std::string::npos) << notes[1];
  write_slick("tire.tir", "RIGHT");
  write_ring("ring.toml", "right");
  EXPECT_EQ(language().find_kind("car")->notes(car).size(), 1u);
  const SpecimenKind& kind = *language().find_kind("car");
  EXPECT_NE(kind.describe(kind.read(car)).find("of the right side, mirrored on the left"),
            std::string::npos);
}

TEST_F(CarFile, HardpointsOfNoSuspensionAreDoubtedInACarAsInTheirOwnFile) {
  const fs::path kerb = fs::path(LATSCH_SOURCE_DIR) / "studies/kerb";
  const SpecimenKind& kind = *language().find_kind("car");
  EXPECT_TRUE(kind.notes(kerb / "baseline.toml").empty());
  for (const char* name : {"baseline.toml", "front_rigid.toml", "rear_rigid.toml", "slick.tir"})
    fs::copy_file(kerb / name, folder_ / name, fs::copy_options::overwrite_existing);
  const auto change = [&](const char* name, const std::string& from, const std::string& to) {
    std::string text = read_text_file(folder_ / name);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_text_file(folder_ / name, text.replace(at, from.size(), to));
  };
  change("front_rigid.toml",
         "contact = [\"1550.000 mm\", \"612.500 mm\"",
         "contact = [\"1550.000 mm\", \"1612.500 mm\"");
  const auto notes = kind.notes(folder_ / "baseline.toml");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("hardpoint.contact is 1000 mm beside"), std::string::npos) << notes[0];
  // Check the same car again, as one file in which the parts are tables.
  const Document whole = kind.read(folder_ / "baseline.toml");
  write_text_file(folder_ / "whole.toml", kind.text(whole));
  const auto of_tables = kind.notes(folder_ / "whole.toml");
  ASSERT_EQ(of_tables.size(), 1u);
  EXPECT_NE(of_tables[0].find("front_suspension: hardpoint.contact is 1000 mm beside"),
            std::string::npos)
      << of_tables[0];
}

TEST_F(CarFile, NumbersThatDoNotFitEachOtherAreDoubted) {
  const fs::path kerb = fs::path(LATSCH_SOURCE_DIR) / "studies/kerb";
  const SpecimenKind& kind = *language().find_kind("car");
  for (const char* name : {"front_rigid.toml", "rear_rigid.toml", "slick.tir"})
    fs::copy_file(kerb / name, folder_ / name, fs::copy_options::overwrite_existing);
  const auto notes = [&](const std::string& from, const std::string& to) {
    std::string text = read_text_file(kerb / "baseline.toml"), all;
    for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
    write_text_file(folder_ / "car.toml", text);
    for (const std::string& note : kind.notes(folder_ / "car.toml")) all += note + "\n";
    return all;
  };
  EXPECT_EQ(notes("x", "x"), "");
  for (const auto& [from, to, said] :
       {std::array{"\"0.28 m\"", "\"0.28 mm\"", "chassis.center is 0.28 mm above the ground"},
        {"[\"0.75 m\"", "[\"0.75 mm\"", "chassis.center is at x = 0.75 mm"},
        {"\"0.23 kg m^2\"", "\"23 kg m^2\"", "inertia.wheel_spin is 23 kg m^2"},
        {" m/s\"", " mm/s\"", "spring.damper has"}})
    EXPECT_NE(notes(from, to).find(said), std::string::npos) << to << ": " << notes(from, to);
}

TEST_F(CarFile, AFloorOutsideOfTheMapIsDoubted) {
  write_slick("tire.tir", "LEFT");
  const SpecimenKind& kind = *language().find_kind("car");
  const auto notes = [&](const std::string& floor) {
    std::string all;
    const fs::path car = write_car(
        "front_tire = \"tire.tir\"\nrear_tire = \"tire.tir\"\n[aero]\narea = \"1 m^2\"\nfloor = " +
        floor +
        "\nmap = [[\"10 mm\", \"20 mm\", 1, 1], [\"60 mm\", \"20 mm\", 1, 1], [\"10 mm\", \"80 "
        "mm\", "
        "1, 1], [\"60 mm\", \"80 mm\", 1, 1]]\n");
    for (const std::string& note : kind.notes(car)) all += note + "\n";
    return all;
  };
  EXPECT_EQ(notes("[\"40 mm\", \"50 mm\"]"), "");
  EXPECT_NE(notes("[\"130 mm\", \"50 mm\"]")
                .find("aero.floor is 130 mm at the front axle of the car as drawn, outside of the "
                      "heights 10 to 60 mm"),
            std::string::npos);
  EXPECT_NE(notes("[\"40 mm\", \"15 mm\"]").find("15 mm at the rear axle"), std::string::npos);
}

}  // namespace
}  // namespace latsch::experiment
