// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/bushing_reader.h"

#include <gtest/gtest.h>

#include <numbers>

namespace latsch::suspension {
namespace {

using multibody::BushingParameters;

constexpr const char* kAll =
    "[bushing.all]\nx = \"1 N/m\"\ny = \"2 N/m\"\nz = \"3 N/m\"\n"
    "about_x = \"4 N m/rad\"\nabout_y = \"5 N m/rad\"\nabout_z = \"6 N m/rad\"\n";

/// Reads a file in which kAll is followed by this text, and returns the bushing of the joint ubj.
/// Every key must be known.
BushingParameters ubj_of(const std::string& own, const std::string& of_all = "") {
  const Document document = Document::parse(kAll + of_all + "[bushing.ubj]\n" + own, "corner.toml");
  const Node root = document.root();
  const BushingParameters bushing = read_bushing(root.table("bushing"), "ubj");
  root.close();
  return bushing;
}

std::string complaint_about_ubj(const std::string& own) {
  try {
    ubj_of(own);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

/// Returns the only force part of a bushing, which must belong to this axis.
template <class Law>
Law part_of_axis(const BushingParameters& bushing, int axis) {
  EXPECT_EQ(bushing.parts.size(), 1u);
  EXPECT_EQ(bushing.parts.at(0).axis, axis);
  return std::get<Law>(bushing.parts.at(0).law);
}

TEST(BushingReader, AJointHasWhatItSaysAndOtherwiseWhatAllHave) {
  const BushingParameters bushing = ubj_of("y = \"1 kN/mm\"\nabout_z = \"1 N m/deg\"\n");
  EXPECT_EQ(bushing.stiffness, Eigen::Vector3d(1.0, 1e6, 3.0));
  EXPECT_EQ(bushing.rotational.head<2>(), Eigen::Vector2d(4.0, 5.0));
  EXPECT_NEAR(bushing.rotational.z(), 180.0 / std::numbers::pi, 1e-12);
  EXPECT_TRUE(bushing.parts.empty());
  EXPECT_TRUE(bushing.damping.isZero() && bushing.rotational_damping.isZero());
}

TEST(BushingReader, ACurveStandsInThePlaceOfTheStiffness) {
  const BushingParameters x =
      ubj_of("curve.x = [[\"-1 mm\", \"-9 kN\"], [\"0 mm\", \"0 kN\"], [\"1 mm\", \"12 kN\"]]\n");
  EXPECT_EQ(x.stiffness, Eigen::Vector3d(0.0, 2.0, 3.0));
  const auto curve = part_of_axis<multibody::ElasticCurve>(x, 0).curve;
  EXPECT_EQ(curve.points().size(), 3u);
  EXPECT_DOUBLE_EQ(curve.at(-1e-3), -9e3);
  EXPECT_DOUBLE_EQ(curve.at(1e-3), 12e3);
  const BushingParameters about_y =
      ubj_of("curve.about_y = [[\"-10 deg\", \"-5 N m\"], [\"10 deg\", \"6 N m\"]]\n");
  EXPECT_EQ(about_y.rotational.y(), 0.0);
  EXPECT_DOUBLE_EQ(
      part_of_axis<multibody::ElasticCurve>(about_y, 4).curve.at(std::numbers::pi / 18.0), 6.0);
}

TEST(BushingReader, AStiffnessOfAJointGoesBeforeTheCurveOfAll) {
  const std::string curve = "curve.x = [[\"-1 mm\", \"-9 kN\"], [\"1 mm\", \"12 kN\"]]\n";
  EXPECT_TRUE(ubj_of("x = \"7 N/m\"\n", curve).parts.empty());
  EXPECT_EQ(ubj_of("x = \"7 N/m\"\n", curve).stiffness.x(), 7.0);
  EXPECT_EQ(ubj_of("", curve).stiffness.x(), 0.0);
  part_of_axis<multibody::ElasticCurve>(ubj_of("", curve), 0);
}

TEST(BushingReader, PlayFrictionAndMaxwellStandBesideTheStiffness) {
  const BushingParameters with_play = ubj_of("play.y = [[\"0.1 mm\", \"30 kN/mm\"]]\n");
  EXPECT_EQ(with_play.stiffness.y(), 2.0);
  EXPECT_EQ(part_of_axis<multibody::Play>(with_play, 1), (multibody::Play{1e-4, 3e7}));
  const BushingParameters with_friction =
      ubj_of("friction.about_z = [[\"4 N m\", \"2 kN m/rad\"]]\n");
  EXPECT_EQ(with_friction.rotational.z(), 6.0);
  EXPECT_EQ(part_of_axis<multibody::Friction>(with_friction, 5), (multibody::Friction{2e3, 4.0}));
  const BushingParameters with_maxwell = ubj_of("maxwell.z = [[\"3 kN/mm\", \"8 ms\"]]\n");
  EXPECT_EQ(with_maxwell.stiffness.z(), 3.0);
  EXPECT_EQ(part_of_axis<multibody::Maxwell>(with_maxwell, 2), (multibody::Maxwell{3e6, 8e-3}));
  const BushingParameters three = ubj_of(
      "play.y = [[\"0.1 mm\", \"30 kN/mm\"]]\nfriction.y = [[\"40 N\", \"20 kN/mm\"]]\n"
      "maxwell.y = [[\"3 kN/mm\", \"8 ms\"]]\n");
  EXPECT_EQ(three.parts.size(), 3u);
}

TEST(BushingReader, RigidIsStiffAgainstTravelAndTurnsFreely) {
  const BushingParameters bushing = ubj_of("rigid = true\n");
  EXPECT_EQ(bushing.stiffness, Eigen::Vector3d::Constant(1e10));
  EXPECT_EQ(bushing.rotational, Eigen::Vector3d::Zero());
  EXPECT_TRUE(bushing.rigid);
  EXPECT_FALSE(ubj_of("").rigid);
  EXPECT_EQ(ubj_of("rigid = false\n", "rigid = true\n").stiffness.x(), 1.0);
  EXPECT_EQ(ubj_of("", "rigid = true\n").stiffness.x(), 1e10);
}

TEST(BushingReader, DampingIsATimeOfAllAxesOrAValueOfOne) {
  const BushingParameters of_time = ubj_of("damping = \"2 s\"\n");
  EXPECT_EQ(of_time.damping, Eigen::Vector3d(2.0, 4.0, 6.0));
  EXPECT_EQ(of_time.rotational_damping, Eigen::Vector3d(8.0, 10.0, 12.0));
  const BushingParameters mixed =
      ubj_of("damping = \"2 s\"\nviscous.x = \"3 kN s/m\"\nviscous.about_y = \"0.5 N m s/rad\"\n");
  EXPECT_EQ(mixed.damping, Eigen::Vector3d(3e3, 4.0, 6.0));
  EXPECT_EQ(mixed.rotational_damping, Eigen::Vector3d(8.0, 0.5, 12.0));
}

TEST(BushingReader, DampingOfAJointGoesBeforeThatOfAll) {
  const std::string all = "damping = \"2 s\"\nviscous.y = \"7 N s/m\"\n";
  EXPECT_EQ(ubj_of("", all).damping, Eigen::Vector3d(2.0, 7.0, 6.0));
  EXPECT_EQ(ubj_of("damping = \"1 s\"\n", all).damping, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(ubj_of("viscous.y = \"0 N s/m\"\n", all).damping, Eigen::Vector3d(2.0, 0.0, 6.0));
  // The time constant of the damping does not apply to an axis with a curve, because this axis has
  // no stiffness by which to multiply it.
  const BushingParameters curved = ubj_of(
      "viscous.x = \"9 N s/m\"\ncurve.x = [[\"-1 m\", \"-1 N\"], [\"1 m\", \"2 N\"]]\n", all);
  EXPECT_EQ(curved.damping.x(), 9.0);
}

TEST(BushingReader, ErrorsNameTheJointAndItsAxis) {
  EXPECT_EQ(complaint_about_ubj(""), "none");
  for (const auto& [own, place, part] : std::vector<std::array<std::string, 3>>{
           {"x = \"1 N\"\n", "corner.toml:9: ", "bushing.ubj.x"},
           {"x = \"-1 N/m\"\n", "corner.toml:9: ", "bushing.ubj.x"},
           {"viscous.y = \"1 N/m\"\n", "corner.toml:9: ", "bushing.ubj.viscous.y"},
           {"viscous.y = \"-1 N s/m\"\n", "corner.toml:9: ", "bushing.ubj.viscous.y"},
           {"viscous.u = \"1 N s/m\"\n", "corner.toml:9: ", "bushing.ubj.viscous.u"},
           {"x = \"1 N/m\"\ncurve.x = [[\"-1 m\", \"-1 N\"], [\"1 m\", \"1 N\"]]\n",
            "corner.toml:9: ",
            "bushing.ubj.x is given beside curve.x"},
           {"curve.z = [[\"1 m\", \"1 N\"]]\n",
            "corner.toml:9: ",
            "bushing.ubj.curve.z has 1 points"},
           {"curve.z = [[\"1 m\", \"1 N\"], [\"1 m\", \"2 N\"]]\n",
            "corner.toml:9: ",
            "bushing.ubj.curve.z does not rise in x"},
           {"play.x = [[\"1 N\", \"1 N/m\"]]\n", "corner.toml:9: ", "bushing.ubj.play.x"},
           {"maxwell.x = [[\"1 N/m\", \"0 s\"]]\n", "corner.toml:8: ", "bushing.ubj"},
           {"friction.x = [[\"1 N\", \"1 N/m\"], [\"1 N\", \"1 N/m\"]]\n",
            "corner.toml:9: ",
            "double brackets"}}) {
    const std::string said = complaint_about_ubj(own);
    EXPECT_EQ(said.find(place), 0u) << own << said;
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }
  try {
    const Document document = Document::parse("[bushing.ubj]\nx = \"1 N/m\"\n", "corner.toml");
    read_bushing(document.root().table("bushing"), "ubj");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("bushing.ubj has no y"), std::string::npos)
        << error.what();
  }
}

TEST(BushingReader, WhatItsLinesSayIsTheBushingTheyWereMadeOf) {
  BushingParameters bushing;
  bushing.stiffness = {1e7 / 3.0, 0.0, 2e7};
  bushing.rotational = {0.1, 200.0, 0.0};
  bushing.damping = {1.0 / 3.0, 2.0, 0.0};
  bushing.rotational_damping = {0.0, 0.7, 1e-3};
  using multibody::ForceCharacteristic;
  bushing.parts = {
      {1, multibody::ElasticCurve{ForceCharacteristic({{-1e-3 / 3.0, -2.0}, {0.1, 7.1}})}},
      {5, multibody::ElasticCurve{ForceCharacteristic({{-0.3, -2.0}, {0.0, 1.0}, {0.1, 7.1}})}}};
  std::string own;
  for (const std::string& line : bushing_lines(bushing)) own += line + "\n";
  EXPECT_TRUE(ubj_of(own, "damping = \"1 s\"\n") == bushing) << own;
}

}  // namespace
}  // namespace latsch::suspension
