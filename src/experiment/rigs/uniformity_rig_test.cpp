// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/uniformity_rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "base/scratch_folder_testing.h"
#include "experiment/kinds/sparse_tir_testing.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/plane_road.h"
#include "models/tire/free_trials.h"

namespace latsch::experiment {
namespace {

/// A spring on a wheel with run-out, a side force whose side does not depend on the direction of
/// rolling, one whose side does, and one of two periods a turn; the slip stiffness is high.
class UnevenSpring final : public Tire {
 public:
  double free_radius() const override { return 0.3; }
  Result<HubForces> settle(const WheelMotion& motion, const road::Road& road, double) override {
    return forces(motion, road, 0.0);
  }
  Result<HubForces> advance(const WheelMotion& motion,
                            const road::Road& road,
                            double time,
                            double) override {
    return forces(motion, road, time);
  }
  Result<HubForces> advance_free(WheelMotion& motion,
                                 FreeWheel& wheel,
                                 const road::Road& road,
                                 double time,
                                 double step) override {
    return advance_by_trials(*this, motion, wheel, road, time, step);
  }
  std::unique_ptr<Tire> clone() const override { return std::make_unique<UnevenSpring>(*this); }

  double k = 2e5, runout = 3e-4, cone = 40.0, plies = -60.0, twice = 5.0;

 private:
  HubForces forces(const WheelMotion& motion, const road::Road& road, double time) const {
    const road::GroundPoint ground = road.at(motion.center.x(), motion.center.y(), time);
    const double way = motion.spin_rate > 0.0 ? 1.0 : motion.spin_rate < 0.0 ? -1.0 : 0.0;
    HubForces hub;
    hub.force.x() = 1e4 * (motion.spin_rate * 0.3 - (motion.velocity.x() - ground.velocity.x()));
    hub.force.y() = cone + way * plies + twice * std::cos(2.0 * motion.spin);
    hub.force.z() =
        k * (0.3 + runout * std::cos(motion.spin - 0.7) - motion.center.z() + ground.height);
    hub.moment.y() = -0.3 * hub.force.x();
    return hub;
  }
};

// A wheel on a tire with a relaxation length of a meter swings for several turns; the tire itself
// is uniform.
TEST(Uniformity, OfAUniformTireOnLongRelaxationIsZeroAtEverySpeed) {
  const ScratchFolder folder;
  std::ofstream(folder.path() / "tire.tir")
      << sparse_tir(std::string(kLongitudinalForce) + kSideForce +
                    "[STRUCTURAL]\nLONGITUDINAL_STIFFNESS = 88000\nLATERAL_STIFFNESS = 60000\n");
  const SpecimenKind& kind = *language().find_kind("magic_formula");
  const auto specimen = kind.build(kind.read(folder.path() / "tire.tir"));
  for (const double speed : {2.0, 10.0, 30.0}) {
    const auto tire = specimen->find<Rolls>()->tire();
    const auto found =
        run(*tire,
            UniformityTest{.load = 4000.0, .speed = speed, .step = std::min(1e-3, 0.02 / speed)});
    ASSERT_TRUE(found) << found.failure().reason;
    EXPECT_LT(found->tangential.all, 0.1) << speed;
    EXPECT_LT(found->radial.all, 1e-3) << speed;
  }
}

// In a tire with run-out the radial force varies by 2 a k once a turn and the lateral force by 2 l
// twice a turn.
TEST(Uniformity, OfASpringThatRunsOutIsItsRunOutTimesItsStiffness) {
  for (const double diameter : {0.0, 2.0}) {
    UnevenSpring tire;
    const auto found = run(tire, UniformityTest{.load = 4000.0, .diameter = diameter});
    ASSERT_TRUE(found) << found.failure().reason;
    EXPECT_NEAR(found->load, 4000.0, 1.0);
    EXPECT_NEAR(found->radial.first, 2.0 * 3e-4 * 2e5, 1e-3);
    EXPECT_NEAR(found->radial.all, found->radial.first, 2e-3);
    EXPECT_NEAR(found->lateral.all, 2.0 * 5.0, 1e-3);
    EXPECT_NEAR(found->lateral.first, 0.0, 1e-3);
    EXPECT_NEAR(found->tangential.all, 0.0, 1e-2);
    EXPECT_NEAR(found->conicity, 40.0, 1e-2);
    EXPECT_NEAR(found->ply_steer, -60.0, 1e-2);
  }
}

TEST(Uniformity, AVariationIsThatOfItsHarmonics) {
  std::vector<double> values;
  constexpr int kCount = 1440;
  const auto wave = [](int n, int i) { return std::cos(2.0 * std::numbers::pi * n * i / kCount); };
  for (int i = 0; i < kCount; ++i)
    values.push_back(100.0 + 3.0 * wave(1, i) + 2.0 * wave(2, i) + 7.0 * wave(60, i));
  const ForceVariation found = variation_of(values, 10);
  EXPECT_NEAR(found.first, 6.0, 1e-9);
  // The sum 3 cos x + 2 cos 2x ranges from -2 - 9/16, at cos x = -3/8, to 5.
  EXPECT_NEAR(found.all, 7.0 + 9.0 / 16.0, 1e-4);
  EXPECT_NEAR(variation_of(values, 1).all, 6.0, 1e-4);
}

ring_tire::RingParameters coarse_ring() {
  ring_tire::RingParameters ring = ring_tire::passenger_ring();
  ring.nodes = 60;
  ring.tread.blocks = 8;
  ring.belt.bending_in_plane = 10.0;
  return ring;
}

/// Returns the stiffness, N/m, of the ring without rotation.
double standing_stiffness_of(const ring_tire::RingParameters& ring, double load) {
  double height[2];
  const double step = 50.0;  // N
  for (const int i : {0, 1}) {
    ring_tire::RingTire tire(ring);
    WheelMotion motion;
    double low = tire.free_radius() - 0.04, high = tire.free_radius();
    for (int halving = 0; halving < 24; ++halving) {
      motion.center.z() = 0.5 * (low + high);
      const auto hub = tire.settle(motion, road::PlaneRoad(), 0.0);
      EXPECT_TRUE(hub);
      (hub->force.z() > load + (i == 0 ? -step : step) ? low : high) = motion.center.z();
    }
    height[i] = motion.center.z();
  }
  return 2.0 * step / (height[0] - height[1]);
}

// The rolling ring has the stiffness of the standing ring except for friction in the patch; the
// patch averages some percent of the wave away.
TEST(Uniformity, OfARingThatRunsOutIsNearItsRunOutTimesItsStiffness) {
  ring_tire::RingParameters ring = coarse_ring();
  const double k = standing_stiffness_of(ring, 3500.0);
  ring.uniformity.radial_runout = {{.amplitude = 3e-4, .angle = 0.4}};
  ring_tire::RingTire tire(ring);
  const auto found = run(tire, UniformityTest{.load = 3500.0});
  ASSERT_TRUE(found) << found.failure().reason;
  EXPECT_NEAR(found->load, 3500.0, 10.0);
  EXPECT_NEAR(found->radial.first / (2.0 * 3e-4 * k), 1.0, 0.06);
  EXPECT_LT(found->radial.all, 1.1 * found->radial.first);
  EXPECT_LT(found->lateral.all, 1.0);
}

/// Returns the side force, N, to the left of a ring that rolls straight ahead at a constant height,
/// as a mean over 0.2 m after 2.8 m.
double straight_on(const ring_tire::RingParameters& ring, double height, double way) {
  ring_tire::RingTire tire(ring);
  WheelMotion motion;
  const double speed = 2.0, h = 1e-3;
  motion.center.z() = height;
  motion.velocity.x() = way * speed;
  motion.spin_rate = way * speed / 0.3085;
  EXPECT_TRUE(tire.settle(motion, road::PlaneRoad(), 0.0));
  double sum = 0.0;
  for (int i = 1; i <= 1500; ++i) {
    motion.center.x() += h * motion.velocity.x();
    motion.spin += h * motion.spin_rate;
    const auto hub = tire.advance(motion, road::PlaneRoad(), i * h, h);
    EXPECT_TRUE(hub);
    if (i > 1400) sum += hub->force.y() / 100.0;
  }
  return sum;
}

// Half the sum and half the difference of the forces at straight rolling, forward and backward. In
// that run the wheel is held at a speed near free rolling, on the machine it is free.
TEST(Uniformity, ConicityAndPlySteerAreThoseOfStraightRolling) {
  ring_tire::RingParameters ring = coarse_ring();
  ring.belt.bending_twist = 5.0;
  ring.belt.conicity = 0.002;
  ring_tire::RingTire tire(ring);
  const UniformityTest test{.load = 3500.0};
  const auto found = run(tire, test);
  ASSERT_TRUE(found) << found.failure().reason;
  WheelMotion motion;
  motion.center.z() = tire.free_radius() - 0.02;
  const double height = motion.center.z();
  const double forward = straight_on(ring, height, 1.0), back = straight_on(ring, height, -1.0);
  EXPECT_LT(found->ply_steer, -20.0);
  EXPECT_GT(found->conicity, 5.0);
  EXPECT_NEAR(found->ply_steer, 0.5 * (forward - back), 0.05 * std::abs(found->ply_steer));
  EXPECT_NEAR(found->conicity, 0.5 * (forward + back), 0.05 * std::abs(found->conicity));
}

}  // namespace
}  // namespace latsch::experiment
