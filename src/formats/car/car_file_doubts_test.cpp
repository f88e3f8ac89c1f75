// SPDX-License-Identifier: Apache-2.0
#include "formats/car/car_file_doubts.h"

#include <gtest/gtest.h>

#include <string>

namespace latsch::formats {
namespace {

std::string car_doubts(const std::string& text) {
  std::string all;
  for (const LedgerDoubt& doubt : doubts_of_car_file(Document::parse(text, "car.toml").root()))
    all += doubt.place.text() + " " + doubt.sentence + "\n";
  return all;
}

std::string unit(const std::string& keys, const std::string& part = "front.spring") {
  return car_doubts("kind = \"car\"\n[" + part + "]\nstiffness = \"50 N/mm\"\n" + keys);
}

void expect_part(const std::string& said, const std::string& part) {
  EXPECT_NE(said.find(part), std::string::npos) << said;
}

TEST(CarFileDoubts, ADamperThatDrivesIsTold) {
  const std::string good =
      R"(damper = [["-0.5 m/s", "-1.3 kN"], ["0 m/s", "0 N"], ["0.5 m/s", "1.9 kN"]])";
  EXPECT_EQ(unit(good), "");
  expect_part(
      unit(R"(damper = [["-0.5 m/s", "1.3 kN"], ["0 m/s", "0 N"], ["0.5 m/s", "1.9 kN"]])"),
      "car.toml:4 front.spring.damper falls from 1300 N at -0.5 m/s to 0 N at 0 m/s, while the "
      "velocity rises: it adds energy there");
  expect_part(unit(R"(damper = [["-0.5 m/s", "1 kN"], ["0.5 m/s", "-1 kN"]])", "rear.third"),
              "rear.third.damper falls");
  expect_part(unit(R"(damper = [["-0.5 m/s", "-1 kN"], ["0.5 m/s", "1.5 kN"]])"),
              "has 250 N at rest: a preload");
}

TEST(CarFileDoubts, ASpringThatPushesOnAndAStopInDroopAreTold) {
  EXPECT_EQ(unit(R"(curve = [["-40 mm", "-12 kN"], ["-25 mm", "0 kN"], ["100 mm", "0 kN"]])"), "");
  expect_part(unit(R"(curve = [["-40 mm", "12 kN"], ["-25 mm", "0 kN"], ["100 mm", "0 kN"]])"),
              "front.spring.curve falls from 1.2e+04 N at -0.04 m to 0 N at -0.025 m, while the "
              "extension rises");
  expect_part(unit(R"(curve = [["0 mm", "0 kN"], ["25 mm", "0 kN"], ["40 mm", "12 kN"]])"),
              "acts in extension alone");
  expect_part(car_doubts("kind = \"suspension\"\n[bushing.ubj]\ncurve.y = [[\"-1 mm\", \"1 kN\"], "
                         "[\"1 mm\", \"-1 kN\"]]\n"),
              "car.toml:3 bushing.ubj.curve.y falls from 1000 N");
  expect_part(car_doubts("kind = \"suspension\"\n[bushing.ubj]\ncurve.about_z = [[\"-1 deg\", "
                         "\"1 N m\"], [\"1 deg\", \"-1 N m\"]]\n"),
              "falls from 1 N m at");
}

TEST(CarFileDoubts, AnAeroMapThatLiftsIsTold) {
  const auto aero = [](const std::string& map) {
    return car_doubts("kind = \"car\"\n[aero]\narea = \"1 m^2\"\nmap = " + map + "\n");
  };
  EXPECT_EQ(aero(R"([["0 mm", "0 mm", 1.0, 2.0]])"), "");
  expect_part(aero(R"([["0 mm", "0 mm", -1.0, -2.0]])"),
              "car.toml:4 aero.map has a coefficient below 0 in 1 of 1 rows, first -1 in front and "
              "-2 at the rear: the air lifts the car there");
  expect_part(aero(R"([["0 mm", "0 mm", 1.0, 2.0], ["0 mm", "1 mm", 0.5, -0.1]])"),
              "1 of 2 rows, first 0.5 in front and -0.1 at the rear");
}

TEST(CarFileDoubts, AKingpinThatLeansForwardSuggestsOtherAxes) {
  const auto suspension = [](const std::string& x) {
    return car_doubts("kind = \"suspension\"\n[hardpoint]\nubj = [\"" + x +
                      "\", \"0.5 m\", \"0.35 m\"]\nlbj = [\"1.5 m\", \"0.55 m\", \"0.15 m\"]\n");
  };
  EXPECT_EQ(suspension("1.47 m"), "");
  EXPECT_EQ(suspension("1.502 m"), "");  // half a degree
  // An offset of 30 mm over a height of 200 mm is a caster angle of 8.5 degrees.
  expect_part(suspension("1.53 m"),
              "car.toml:3 hardpoint.ubj is 0.03 m before lbj: a caster of -8.5 deg");
}

TEST(CarFileDoubts, OtherFilesAndRowsThatTheReaderRefusesHaveNone) {
  EXPECT_EQ(car_doubts("[front.spring]\ndamper = [[\"-1 m/s\", \"1 N\"], [\"1 m/s\", \"-1 N\"]]\n"),
            "");
  EXPECT_EQ(car_doubts("kind = \"kerb\"\n"), "");
  EXPECT_EQ(unit("damper = 3\n"), "");
  EXPECT_EQ(unit(R"(damper = [["-1 m", "1 N"], ["1 m", "-1 N"]])"), "");
}

}  // namespace
}  // namespace latsch::formats
