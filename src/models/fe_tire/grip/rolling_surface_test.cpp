// SPDX-License-Identifier: Apache-2.0
// The surface of a drum rolled out, and tire B with few columns that rolls on it.
#include "models/fe_tire/grip/rolling_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/rolling/rolling_forces.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::fe_tire {
namespace {

constexpr double kDrumSpeed = 20.0, kPressed = 0.015, kDrum = 0.85;  // m/s, m, m

TEST(RollingSurface, AxesAreTheDerivativesOfPlaces) {
  const RollingSurface drum(1.0 / kDrum, Eigen::Vector2d(std::cos(0.2), std::sin(0.2)));
  const Eigen::Vector3d on = drum.point({0.05, -0.03});
  const RollingSurface::Place place = drum.place(on);
  EXPECT_LT((place.x - Eigen::Vector3d(0.05, -0.03, 0.0)).norm(), 1e-15);
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(k);
    const Eigen::Vector3d by = (drum.place(on + step).x - drum.place(on - step).x) / (2.0 * kStep);
    EXPECT_LT((by - place.turn.col(k)).norm(), 1e-8) << k;
  }
  EXPECT_LT((place.turn * place.turn.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  // The distance from the drum's axis is its radius.
  const Eigen::Vector3d axis(-std::sin(0.2), std::cos(0.2), 0.0);
  const Eigen::Vector3d from = on + Eigen::Vector3d(0.0, 0.0, kDrum);
  EXPECT_NEAR((from - axis.dot(from) * axis).norm(), kDrum, 1e-15);
}

TireDescription tire_on_drum() {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.section.meridional = 13;
  return tire;
}

class OnADrum : public testing::Test {
 protected:
  OnADrum() : tire_(tire_on_drum()), rolling_(tire_) {
    const Inflated inflated = *tire_.inflate(2.6e5);
    start_ = rolling_.start(tire_
                                .advance(tire_.over(inflated, {}, FeTire::Poses::any),
                                         {FeTire::below(inflated, kPressed)})
                                ->back());
  }
  /// Rolls under the load of the start, freely.
  RollingCase free_wheel(double curvature) const {
    RollingCase of;
    of.speed = kDrumSpeed;
    of.curvature = curvature;
    of.spin = kDrumSpeed / 0.312;
    of.load = start_.forces.force.z();
    of.drive = 0.0;
    return of;
  }
  RollingState roll(const RollingState& from, const RollingCase& of) {
    auto state = rolling_.roll(from, of);
    EXPECT_TRUE(state) << (state ? "" : state.failure().reason);
    return state ? *state : RollingState();
  }

  FeTire tire_;
  RollingTire rolling_;
  RollingState start_;
};

TEST_F(OnADrum, HasNeitherDragNorMomentWithoutFriction) {
  RollingCase of = free_wheel(1.0 / kDrum);
  of.load.reset();
  of.drive.reset();
  of.height = start_.of.height;
  of.friction.at_rest = 0.0;
  const RollingState state = roll(start_, of);
  of.curvature = 0.0;
  const double load = state.forces.force.z(), flat = roll(start_, of).forces.force.z();
  EXPECT_LT(load, 0.98 * flat);  // the drum gives way at the patch's ends
  EXPECT_GT(load, 0.85 * flat);  // the share of a layer without a belt
  EXPECT_NEAR(state.forces.force.x(), 0.0, 1e-6 * load);
  EXPECT_NEAR(state.forces.drive, 0.0, 1e-6 * load * state.of.height);
}

TEST_F(OnADrum, OfAWideRadiusRollsAsOnFlatGround) {
  const RollingState flat = roll(start_, free_wheel(0.0)), wide = roll(start_, free_wheel(1e-7));
  EXPECT_NEAR(wide.of.spin, flat.of.spin, 1e-7 * flat.of.spin);
  EXPECT_NEAR(wide.of.height, flat.of.height, 1e-7 * flat.of.height);
  EXPECT_LT((wide.forces.force - flat.forces.force).norm(), 1e-5 * flat.forces.force.z());
}

// The drum is held by the moment that the tractions have about its axis, however the force on the
// wheel and its moment divide it.
TEST_F(OnADrum, TractionsHaveTheMomentOfTheForceAboutTheDrumsAxis) {
  const RollingState free = roll(start_, free_wheel(1.0 / kDrum));
  EXPECT_NEAR(free.forces.force.z(), start_.forces.force.z(), 1e-6 * free.forces.force.z());
  EXPECT_NEAR(free.forces.drive, 0.0, 1e-6 * free.forces.force.z());
  EXPECT_LT(free.of.height, start_.of.height);
  RollingCase braked = free.of;
  braked.drive.reset();
  braked.spin = 0.985 * free.of.spin;
  const RollingState state = roll(free, braked);
  const RollingForces& forces = state.forces;
  EXPECT_LT(forces.traction.x(), -0.25 * forces.force.z());
  // The last step of Newton's method leaves the axes of the step before.
  EXPECT_NEAR(forces.moment.y() + kDrum * forces.force.x(),
              kDrum * forces.traction.x(),
              1e-5 * forces.force.z() * kDrum);
  // Power of drive and drum is that of sliding, but for the error of the discretization.
  EXPECT_NEAR(power_balance(state), 0.0, 0.005 * forces.force.z() * kDrumSpeed);
}

TEST_F(OnADrum, SlipAnglesOfBothSignsMirrorEachOther) {
  const RollingState free = roll(start_, free_wheel(1.0 / kDrum));
  RollingCase steered = free.of;
  steered.drive.reset();
  steered.spin = free.of.spin;
  steered.slip_angle = 0.02;
  const RollingState left = roll(free, steered);
  steered.slip_angle = -0.02;
  const RollingState right = roll(free, steered);
  EXPECT_LT(left.forces.force.y(), -100.0);
  // Ply steer is the difference of the plies.
  EXPECT_NEAR(left.forces.force.y(), -right.forces.force.y(), 0.2 * right.forces.force.y());
}

TEST_F(OnADrum, AWheelThatTurnsIsRefused) {
  RollingCase of = free_wheel(1.0 / kDrum);
  of.turn_slip = 0.1;
  EXPECT_FALSE(rolling_.roll(start_, of));
  of.turn_slip = 0.0;
  of.curvature = -1.0;
  EXPECT_FALSE(rolling_.roll(start_, of));
}

}  // namespace
}  // namespace latsch::fe_tire
