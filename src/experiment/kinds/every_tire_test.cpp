// SPDX-License-Identifier: Apache-2.0
// Properties of rigs and roads that hold for every tire.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>

#include "base/file.h"
#include "experiment/kinds/sparse_tir_testing.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "experiment/rigs/drum_rig.h"
#include "experiment/rigs/slip/flat_track.h"
#include "experiment/rigs/slip/lift_watch.h"
#include "experiment/rigs/static_stiffness.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"
#include "models/tire/tared_tire.h"

namespace latsch::experiment {
namespace {

class EveryTire : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    kind_ = language().find_kind(GetParam());
    ASSERT_NE(kind_, nullptr);
    if (GetParam() == "ring_tire") {
      numbers_ = kind_->read(std::filesystem::path(LATSCH_SOURCE_DIR) /
                             "studies/ring_tires/passenger_205_55R16.toml");
      numbers_.set("tread.blocks", 6.0);
      return;
    }
    const auto file = std::filesystem::temp_directory_path() /
                      ("every_tire_" + std::to_string(::getpid()) + ".tir");
    std::ofstream(file) << tir_with_a_belt();
    numbers_ = kind_->read(file);
    std::filesystem::remove(file);
  }
  std::unique_ptr<Tire> tire() const { return kind_->build(numbers_)->find<Rolls>()->tire(); }
  bool has_point_contact() const { return GetParam() == "magic_formula"; }

  const SpecimenKind* kind_ = nullptr;
  Document numbers_;
};

// For a tire it makes no difference whether its wheel rolls over a fixed cleat or a belt carries
// the cleat below a stationary wheel.
TEST_P(EveryTire, DoesNotKnowWhetherItOrTheRoadMoves) {
  constexpr double kSpeed = 40.0, kStep = 5e-4, kFrom = -0.6;
  constexpr int kSteps = 60;
  Eigen::Vector3d force[2], moment[2];
  for (const bool belt : {false, true}) {
    auto rolling = tire();
    road::ProfileRoad::Settings settings;
    settings.along = road::cleat_profile(0.01, 0.02, 0.003);
    if (belt) {
      settings.belt = kSpeed;
      settings.origin.x() = -kFrom;
    }
    const road::ProfileRoad road(settings);
    WheelMotion motion;
    motion.center = {belt ? 0.0 : kFrom, 0.0, rolling->free_radius() - 0.018};
    motion.velocity = {belt ? 0.0 : kSpeed, 0.5, 0.0};
    motion.spin_rate = kSpeed / (rolling->free_radius() - 0.005);
    ASSERT_TRUE(rolling->settle(motion, road, 0.0));
    for (int i = 1; i <= kSteps; ++i) {
      motion.center += kStep * motion.velocity;
      motion.spin += kStep * motion.spin_rate;
      const auto hub = rolling->advance(motion, road, i * kStep, kStep);
      ASSERT_TRUE(hub) << hub.failure().reason;
      force[belt] = hub->force;
      moment[belt] = hub->moment;
    }
  }
  EXPECT_LT((force[1] - force[0]).norm(), 2e-3 * force[0].norm());
  EXPECT_LT((moment[1] - moment[0]).norm(), 2e-3 * force[0].norm());
}

double rms_of_difference(const std::vector<double>& one, const std::vector<double>& other) {
  double sum = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) sum += std::pow(one[i] - other[i], 2);
  return std::sqrt(sum / static_cast<double>(one.size()));
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

// The free wheel of a tire with a belt rolls over a cleat. A tire with point contact rolls on the
// bare drum, from a speed that then changes. Halving the time step twice reduces the change sixteen
// times at order 2 and four times at order 1. Corners of the cleat, and blocks that gain or lose
// contact within a step, scatter the ratio from one halving and one channel to the next, so the
// mean is tested. A block of the ring makes contact within 0.3 ms; longer steps do not resolve
// this.
TEST_P(EveryTire, TheDrumIsOfOrderTwo) {
  DrumTest test{.speed = 30.0 / 3.6,
                .load = 3500.0,
                .diameter = 2.5,
                .run_in = 0.08,
                .duration = 0.1,
                .lead = 0.03,
                .sample_step = 1e-3,
                .cleat = Cleat{.height = 0.01, .length = 0.02, .bevel = 0.003}};
  if (has_point_contact()) {
    test.cleat.reset();
    test.run_in = 0.0;
  }
  std::vector<Channels> runs;
  const double longest = GetParam() == "ring_tire" ? 1.25e-4 : 2.5e-4;
  for (const double share : {1.0, 0.5, 0.25, 0.125}) {
    test.step = share * longest;
    auto channels = run(*tire(), test);
    ASSERT_TRUE(channels) << channels.failure().reason;
    runs.push_back(std::move(*channels));
  }
  std::vector<double> ratios;
  for (const char* name : {"Fx", "Fz", "wheel_speed"}) {
    if (has_point_contact() && std::string(name) == "Fz") continue;  // equal in all runs
    const double coarse = rms_of_difference(runs[0][name], runs[1][name]);
    const double fine = rms_of_difference(runs[2][name], runs[3][name]);
    EXPECT_GT(coarse, 4.5 * fine) << name << " " << coarse << " " << fine;
    ratios.push_back(coarse / fine);
  }
  EXPECT_GT(geometric_mean(ratios), 7.0);
}

// If the axle follows the load, the road carries that load at any speed, camber and slip; at a
// fixed height the load would depend on them.
TEST_P(EveryTire, OnTheFlatTrackCarriesTheLoadOfTheTest) {
  SlipSweep sweep{.speed = 25.0, .load = 3500.0, .camber = 0.05, .alpha_to = 0.12, .duration = 0.5};
  double most[2] = {};
  for (const AxleHold axle : {AxleHold::load, AxleHold::height}) {
    sweep.axle = axle;
    const auto channels = run(*tire(), sweep);
    ASSERT_TRUE(channels) << channels.failure().reason;
    for (const double Fz : (*channels)["Fz"])
      most[axle == AxleHold::height] =
          std::max(most[axle == AxleHold::height], std::abs(Fz - sweep.load));
  }
  EXPECT_LT(most[0], 0.01 * sweep.load);
  if (!has_point_contact()) {
    EXPECT_GT(most[1], 0.01 * sweep.load);
  }
}

// The forces of one test in three frames: C has the axes of the hub; H is C rotated back by the
// camber; W has the forces of H, and moments about the contact point, which is a loaded radius down
// the wheel plane.
TEST_P(EveryTire, ForcesAreThoseOfTheFrameThatIsAskedFor) {
  constexpr double camber = 0.06;
  SlipSweep sweep{.load = 3500.0, .camber = camber, .alpha_to = 0.05, .duration = 0.1};
  const auto in = [&](AxisFrame frame) {
    sweep.frames = {frame};
    return *run(*tire(), sweep);
  };
  const Channels C = in(AxisFrame::C), H = in(AxisFrame::H), W = in(AxisFrame::W);
  const double c = std::cos(camber), s = std::sin(camber);
  for (const std::size_t i : {0u, 50u, 199u}) {
    const double R = W["loaded_radius"][i];
    EXPECT_NEAR(H["Fy"][i], c * C["Fy"][i] - s * C["Fz"][i], 1e-9);
    EXPECT_NEAR(H["Fz"][i], s * C["Fy"][i] + c * C["Fz"][i], 1e-9);
    EXPECT_NEAR(H["Mz"][i], s * C["My"][i] + c * C["Mz"][i], 1e-9);
    EXPECT_EQ(W["Fx"][i], H["Fx"][i]);
    EXPECT_EQ(W["Fz"][i], H["Fz"][i]);
    EXPECT_NEAR(W["Mx"][i], H["Mx"][i] - R * (c * H["Fy"][i] + s * H["Fz"][i]), 1e-9);
    EXPECT_NEAR(W["My"][i], H["My"][i] + R * c * H["Fx"][i], 1e-9);
    EXPECT_NEAR(W["Mz"][i], H["Mz"][i] + R * s * H["Fx"][i], 1e-9);
  }
  // A Magic Formula without an overturning coefficient has no Mx in frame W at any camber.
  if (has_point_contact()) {
    EXPECT_NEAR(W["Mx"][199], 0.0, 1e-6 * 3500.0);
  }
}

TEST_P(EveryTire, OnTheDrumTheFrameIsTheSame) {
  DrumTest test{.speed = 10.0,
                .load = 3500.0,
                .camber = 0.06,
                .run_in = 0.02,
                .duration = 0.02,
                .lead = 0.01,
                .step = 1e-3,
                .sample_step = 1e-3};
  const Channels C = *run(*tire(), test);
  test.frames = {AxisFrame::H};
  const Channels H = *run(*tire(), test);
  for (std::size_t i = 0; i < C["Fz"].size(); ++i)
    EXPECT_NEAR(
        H["Fz"][i], std::sin(test.camber) * C["Fy"][i] + std::cos(test.camber) * C["Fz"][i], 1e-9);
}

/// Checks that the road carries the load of a test while the tire stands and while it rolls, and
/// that the rig records this load.
void expect_load_of_the_test(std::unique_ptr<Tire> tire) {
  constexpr double kLoad = 400.0;  // N; the belt of a tire weighs several tens of newtons
  const auto standing = tared(tire->clone());
  ASSERT_TRUE(height_under_load(*standing, road::PlaneRoad(), Eigen::Matrix3d::Identity(), kLoad));
  EXPECT_NEAR(*standing->road_load(), kLoad, 0.01);
  const auto force = load_at(*standing, 0.004);
  ASSERT_TRUE(force) << force.failure().reason;
  EXPECT_NEAR(*force, *standing->road_load(), 0.01);
  LiftLog lifts;
  const auto rolling = watched(std::move(tire), lifts);
  const auto channels =
      run(*rolling, SlipSweep{.load = kLoad, .alpha_to = 0.01, .duration = 0.1, .step = 1e-3});
  ASSERT_TRUE(channels) << channels.failure().reason;
  EXPECT_NEAR((*channels)["Fz"].back(), kLoad, 1.0);
  // The belt of a flexible ring enters the patch segment by segment, and its inertia lets the load
  // of the road vary by some newtons.
  EXPECT_NEAR(*rolling->road_load(), kLoad, 5.0);
}

// A rigid ring from a .tir file with gravity once stood on the road with the load plus the weight
// of its belt.
TEST_P(EveryTire, StandsAndRollsUnderTheLoadOfTheTest) {
  expect_load_of_the_test(tire());
  EXPECT_NEAR(weight_in_air(*tire()), GetParam() == "rigid_ring" ? 7.0 * 9.81 : 0.0, 1e-9);
}

TEST(EveryTireWithWeight, AFlexibleRingWithGravityStandsUnderTheLoadOfTheTest) {
  const SpecimenKind& kind = *language().find_kind("ring_tire");
  std::string text =
      read_text_file(LATSCH_SOURCE_DIR "/studies/ring_tires/passenger_205_55R16.toml");
  text.insert(text.find("[belt]\n") + 7, "gravity = \"9.81 m/s^2\"\n");
  const Document numbers = Document::parse(text, "ring.toml");
  const auto tire = [&] { return kind.build(numbers, nullptr)->find<Rolls>()->tire(); };
  EXPECT_NEAR(weight_in_air(*tire()), 4.52276 * 9.81, 1e-3);
  expect_load_of_the_test(tire());
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         EveryTire,
                         testing::Values("ring_tire", "rigid_ring", "magic_formula"),
                         [](const auto& kind) { return std::string(kind.param); });

}  // namespace
}  // namespace latsch::experiment
