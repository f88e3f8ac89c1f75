// SPDX-License-Identifier: Apache-2.0
// Tests an axle on the K&C rig: derivatives by bushings equal differences, the mode determines the
// loads on the right wheel from those on the left, and the regression slope of a straight line is
// its slope.
#include "experiment/rigs/car/axle_kc_rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/document_parts.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "models/suspension/kinematic_outputs.h"
#include "models/suspension/suspension_reader.h"

namespace latsch::experiment {
namespace {

const std::filesystem::path kCars = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies";

class AxleOnKcRig : public testing::Test {
 protected:
  static std::unique_ptr<experiment::Test> test(const std::string& keys) {
    return language().read_test(
        Document::parse("kind = \"axle_kc\"\naxle = \"rear\"\n" + keys, "test.toml").root(), {});
  }
  Channels record(const std::string& keys, const Asked& asked = {}) {
    const auto specimen = language().find_kind("car")->build(numbers_);
    auto channels = test(keys)->run_with_slopes(*specimen, asked);
    EXPECT_TRUE(channels) << channels.failure().reason;
    return *channels;
  }

  Document numbers_ = language().find_kind("car")->read(kCars / "compliance/rear_axle/car.toml");
};

TEST_F(AxleOnKcRig, SlopesInStiffnessesAreThoseOfDifferences) {
  const std::string keys =
      "springs = \"free\"\nFy_L = [\"-1 kN\", \"1 kN\", \"2 kN\"]\nFz_L = \"800 N\"\n"
      "Mz_R = \"60 N m\"\nFx_R = \"-700 N\"\nslopes_by = \"Fy_L\"\n";
  Asked asked{{},
              {"rear_suspension.bushing.trackrod_outer.y",
               "rear_suspension.bushing.lca_front.x",
               "rear_suspension.bushing.all.about_x",
               "front_suspension.bushing.all.y"}};
  for (const ChannelInfo& channel : test(keys)->channels()) asked.channels.push_back(channel.name);
  const Channels exact = record(keys, asked);
  const Document whole = numbers_;
  for (std::size_t p = 0; p < asked.paths.size(); ++p) {
    const double at = whole.get(asked.paths[p]);
    const auto moved_by = [&](double share) {
      numbers_ = whole;
      numbers_.set(asked.paths[p], at * (1.0 + share));
      return record(keys);
    };
    // Central differences of two steps, extrapolated: the remaining error is the rounding of 1e-9
    // rad.
    const Channels up = moved_by(2e-2), down = moved_by(-2e-2), half_up = moved_by(1e-2),
                   half_down = moved_by(-1e-2);
    for (const Channel& channel : exact.all()) {
      const std::size_t n = channel.values.size();
      ASSERT_EQ(channel.slopes.size(), n * asked.paths.size()) << channel.name;
      double apart = 0.0, size = 0.0, value = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        const auto difference = [&](const Channels& a, const Channels& b, double step) {
          return (a[channel.name][i] - b[channel.name][i]) / (2.0 * step);
        };
        const double slope =
            (4.0 * difference(half_up, half_down, 1e-2) - difference(up, down, 2e-2)) / 3.0;
        apart = std::max(apart, std::abs(channel.slopes[p * n + i] * at - slope));
        size = std::max(size, std::abs(slope));
        value = std::max(value, std::abs(channel.values[i]));
      }
      // A load on the left wheel does not move the right one. The tolerance is the residual of
      // Newton's method, 1e-6 N over 1e-8 m/N, divided by a step of 1e-2; for a slope it is divided
      // by loads of some kN.
      const double left = n == 1 ? 1e-15 : 1e-12;
      EXPECT_LE(apart, 1e-6 * size + 1e-9 * value + left) << channel.name << " " << asked.paths[p];
      if (p == 3) {
        EXPECT_EQ(size, 0.0) << "the other axle moves " << channel.name;
      }
    }
    if (p == 0) {
      EXPECT_GT(std::abs(exact.find("toe_L")->slopes[0]), 0.0);
    }
  }
}

TEST_F(AxleOnKcRig, TellsTheSlopesThatAreAskedForAlone) {
  const Channels recorded =
      record("Fy_L = [\"1 kN\", \"2 kN\"]\nslopes_by = \"Fy_L\"\n",
             {{"toe_L_by_Fy_L"}, {"rear_suspension.bushing.trackrod_outer.y"}});
  for (const Channel& channel : recorded.all())
    EXPECT_EQ(channel.slopes.size(), channel.name == "toe_L_by_Fy_L" ? 1u : 0u) << channel.name;
}

TEST_F(AxleOnKcRig, OpposedLoadsAreThoseOfEachWheel) {
  const Channels opposed =
      record("mode = \"opposed\"\nFy = [\"1 kN\", \"2 kN\"]\nMz = \"50 N m\"\n");
  const Channels each = record(
      "Fy_L = [\"1 kN\", \"2 kN\"]\nFy_R = [\"1 kN\", \"2 kN\"]\nMz_L = \"50 N m\"\n"
      "Mz_R = \"50 N m\"\n");
  for (const char* name : {"dx_L", "toe_L", "camber_R", "dy_R"})
    EXPECT_EQ(opposed[name], each[name]) << name;
}

TEST_F(AxleOnKcRig, PadsOfEachWheelRollIt) {
  const Channels opposed = record("mode = \"opposed\"\ntravel = [\"0 mm\", \"10 mm\"]\n");
  const Channels each =
      record("travel_L = [\"0 mm\", \"10 mm\"]\ntravel_R = [\"0 mm\", \"-10 mm\"]\n");
  for (const char* name : {"camber_L", "camber_R", "pad_L", "pad_R"})
    EXPECT_EQ(opposed[name], each[name]) << name;
}

/// Wheel rate in N/m by virtual work, independent of bodies and bushings: F = (P0 + k (L - L0))
/// dL/dz of a spring of length L that a linkage of rigid rods moves (suspension/linkage.h), dF/dz
/// by differences.
double wheel_rate_of_linkage(const Document& suspension, double k, double preload, double z) {
  const suspension::SuspensionCorner corner = suspension::read_corner(suspension.root());
  suspension::KinematicCorner linkage(corner.geometry, suspension::TravelOf::wheel_center);
  const double at_rest = linkage.move_to(0.0, 0.0)->spring_length;
  constexpr double h = 1e-5;  // m
  const auto force = [&](double travel) {
    const double up = linkage.move_to(travel + h, 0.0)->spring_length,
                 down = linkage.move_to(travel - h, 0.0)->spring_length,
                 here = linkage.move_to(travel, 0.0)->spring_length;
    return (preload + k * (here - at_rest)) * (up - down) / (2.0 * h);
  };
  constexpr double d = 2e-4;
  return (force(z + d) - force(z - d)) / (2.0 * d);
}

// Regression for the shipped kerb car: 10 N m/rad in every joint changed 46.8 kN/m to 49.5 kN/m.
TEST(AxleOnKcRigOfRigidJoints, ItsWheelRateIsThatOfTheLinkage) {
  const SpecimenKind& kind = *language().find_kind("car");
  const Document numbers = kind.read(kCars / "kerb/baseline.toml");
  const auto specimen = kind.build(numbers);
  const auto car = specimen->find<Drives>()->car({});
  ASSERT_TRUE(car) << car.failure().reason;
  for (const std::string axle : {"front", "rear"}) {
    const int corner = axle == "front" ? car::kFL : car::kRL;
    const multibody::Strut& unit = (*car)->mechanism().struts()[static_cast<std::size_t>(
        (*car)->parts().corners[static_cast<std::size_t>(corner)].unit)];
    const auto test = language().read_test(
        Document::parse(
            "kind = \"axle_kc\"\naxle = \"" + axle +
                "\"\nat = \"wheel_center\"\ntravel = [\"-0.2 mm\", \"0.2 mm\", \"9.8 mm\", "
                "\"10.2 mm\", \"-10.2 mm\", \"-9.8 mm\"]\n",
            "test.toml")
            .root(),
        {});
    const auto recorded = test->run(*specimen);
    ASSERT_TRUE(recorded) << recorded.failure().reason;
    const std::vector<double>&pad = (*recorded)["pad_L"], &z = (*recorded)["dz_L"];
    const double places[] = {0.0, 0.010, -0.010};
    for (std::size_t i = 0; i < 3; ++i) {
      const double rate = (pad[2 * i + 1] - pad[2 * i]) / (z[2 * i + 1] - z[2 * i]);
      const double expected = wheel_rate_of_linkage(
          part_of(numbers, axle + "_suspension"), unit.stiffness, unit.preload, places[i]);
      EXPECT_NEAR(rate, expected, 1e-4 * expected) << axle << " at " << places[i];
    }
  }
}

TEST_F(AxleOnKcRig, ATravelThatTheWheelCannotMakeIsNamedAsTravel) {
  const auto said = [&](const std::string& travel) -> std::string {
    const auto specimen = language().find_kind("car")->build(numbers_);
    const auto found = test("springs = \"free\"\ntravel = " + travel + "\n")->run(*specimen);
    return found ? "" : found.failure().reason;
  };
  const std::string first = said("[\"-400 mm\"]");
  EXPECT_NE(first.find("state 1 of the K&C rig: travel -400 mm (left) and -400 mm (right) with the "
                       "rack at 0 mm cannot be reached from rest"),
            std::string::npos)
      << first;
  EXPECT_EQ(first.find("of the load"), std::string::npos) << first;
  const std::string second = said("[\"10 mm\", \"400 mm\"]");
  EXPECT_NE(second.find("state 2 of the K&C rig: travel 400 mm"), std::string::npos) << second;
  EXPECT_NE(second.find("cannot be reached from travel 10 mm (left)"), std::string::npos) << second;
}

}  // namespace
}  // namespace latsch::experiment
