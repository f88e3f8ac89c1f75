// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_tire.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "base/document.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/motion/spin.h"

namespace latsch::fe_tire {
namespace {

constexpr double kInflation = 2.6e5, kSpeed = 20.0, kDeflection = 0.02;

TireDescription few_columns() {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.section.meridional = 13;
  return tire;
}

/// Tire B with few columns, standing at a deflection and, with friction 1, rolling freely under the
/// load found there.
class RollingTireB : public testing::Test {
 protected:
  RollingTireB() : tire_(few_columns()), rolling_(tire_), inflated_(*tire_.inflate(kInflation)) {
    start_ = rolling_.start(standing(kDeflection));
    load_ = start_.forces.force.z();
  }

  TireState standing(double deflection) {
    return tire_
        .advance(tire_.over(inflated_, {}, FeTire::Poses::any),
                 {FeTire::below(inflated_, deflection)})
        ->back();
  }
  RollingCase frictionless(double spin) const {
    RollingCase of;
    of.speed = kSpeed;
    of.height = start_.of.height;
    of.spin = spin;
    of.friction.at_rest = 0.0;
    return of;
  }
  RollingState free_wheel() {
    RollingCase of;
    of.speed = kSpeed;
    of.spin = kSpeed / 0.312;
    of.load = load_;
    of.drive = 0.0;
    return *rolling_.roll(start_, of);
  }
  /// The case of a free wheel's neighbor with these slips.
  RollingCase slipping(const RollingState& free, double kappa, double alpha) const {
    RollingCase of = free.of;
    of.drive.reset();
    of.slip_angle = alpha;
    of.speed = kSpeed / std::cos(alpha);
    of.spin = (1.0 + kappa) * free.of.spin;
    return of;
  }

  FeTire tire_;
  RollingTire rolling_;
  Inflated inflated_;
  RollingState start_;
  double load_ = 0.0;
};

TEST_F(RollingTireB, RollsSlowlyWithoutFrictionAsItStands) {
  const auto state = rolling_.roll(start_, frictionless(1e-3));
  ASSERT_TRUE(state) << state.failure().reason;
  EXPECT_NEAR(state->forces.force.z(), load_, 1e-6 * load_);
  EXPECT_LT((state->u - start_.u).cwiseAbs().maxCoeff(), 1e-7);
}

TEST_F(RollingTireB, HasNeitherDragNorMomentWithoutFriction) {
  const auto state = rolling_.roll(start_, frictionless(kSpeed / 0.312));
  ASSERT_TRUE(state) << state.failure().reason;
  EXPECT_NEAR(state->forces.force.x(), 0.0, 1e-6 * load_);
  EXPECT_NEAR(state->forces.moment.y(), 0.0, 1e-6 * load_ * state->of.height);
  EXPECT_NEAR(state->forces.drive, 0.0, 1e-6 * load_ * state->of.height);
}

// With the energy E*(h, Omega^2) of the tire at the height h, Fz = -dE*/dh and dE*/d(Omega^2) =
// -T, where T = w_0 u + u W u/2 is what (W.1) adds to the kinetic energy. So dFz/d(Omega^2) =
// dT/dh, and T is that of tires which stand (Maxwell's relation).
TEST_F(RollingTireB, GainsLoadBySpinAsTheKineticEnergyOfStandingTiresSays) {
  const Ring ring(tire_.mesh(), ElementKind::solid_shell);
  const RingElements elements(ring, tire_.materials());
  const RingUnknowns whole(ring, RingSymmetry::none, {});
  const Eigen::VectorXd w_0 = flow_forces(whole, elements, 0.0 * start_.u);
  const auto T = [&](double deflection) {
    const Eigen::Matrix3Xd u = standing(deflection).u;
    return 0.5 * whole.compress(u).dot(w_0 + flow_forces(whole, elements, u));
  };
  // Within this step no point comes down or lifts off.
  const double step = 2e-5,
               by_height = -(T(kDeflection + step) - T(kDeflection - step)) / (2 * step);
  const double spin = 15.0;
  const auto state = rolling_.roll(start_, frictionless(spin));
  ASSERT_TRUE(state) << state.failure().reason;
  const double gain = (state->forces.force.z() - load_) / (spin * spin);
  EXPECT_GT(gain, 0.0);
  EXPECT_NEAR(gain, by_height, 1e-3 * by_height);
}

TEST_F(RollingTireB, RollsFreelyUnderItsLoad) {
  const RollingState free = free_wheel();
  EXPECT_NEAR(free.forces.force.z(), load_, 1e-6 * load_);
  EXPECT_NEAR(free.forces.drive, 0.0, 1e-6 * load_ * free.of.height);
  EXPECT_LT(std::abs(free.forces.force.x()),
            1e-3 * load_);  // friction's alone: the tire is elastic
  EXPECT_GE(free.forces.friction_power, 0.0);
  // The effective radius lies between the loaded and the inflated one.
  const double R_e = kSpeed / free.of.spin;
  EXPECT_GT(R_e, free.loaded_radius());
  EXPECT_LT(R_e, inflated_.radius);
}

TEST_F(RollingTireB, GetsGripAfterItRolledWithoutFriction) {
  const auto smooth = rolling_.roll(start_, frictionless(kSpeed / 0.312));
  ASSERT_TRUE(smooth) << smooth.failure().reason;
  RollingCase of = smooth->of;
  of.load = load_;
  of.drive = 0.0;
  of.friction.at_rest = 1.0;
  const auto free = rolling_.roll(*smooth, of);
  ASSERT_TRUE(free) << free.failure().reason;
  EXPECT_LT((free->forces.force - free_wheel().forces.force).norm(), 1e-5 * load_);
}

// The height of a case that asks for a load is that of the state before, whatever the case says.
TEST_F(RollingTireB, FindsTheNextStateWhateverHeightItsCaseStates) {
  const RollingState free = free_wheel();
  RollingCase of = slipping(free, 0.0, 0.005);
  const auto next = rolling_.roll(free, of);
  of.height += 2e-3;
  const auto other = rolling_.roll(free, of);
  ASSERT_TRUE(next && other);
  EXPECT_EQ(other->iterations, next->iterations);
  EXPECT_LT((other->forces.force - next->forces.force).norm(), 1e-5 * load_);
}

TEST_F(RollingTireB, SideForceAndAligningMomentTurnWithTheSlipAngle) {
  // Tire B's section and smeared cords are mirrored at its middle plane.
  const RollingState free = free_wheel();
  const auto left = rolling_.roll(free, slipping(free, 0.0, 0.01));
  const auto right = rolling_.roll(free, slipping(free, 0.0, -0.01));
  ASSERT_TRUE(left && right);
  const RollingForces &a = left->forces, &b = right->forces;
  EXPECT_LT(a.force.y(), -0.2 * load_);
  EXPECT_GT(a.moment.z(), 0.0);  // turns the wheel back toward its velocity
  EXPECT_NEAR(a.force.y(), -b.force.y(), 1e-5 * load_);
  EXPECT_NEAR(a.force.x(), b.force.x(), 1e-5 * load_);
  EXPECT_NEAR(a.moment.z(), -b.moment.z(), 1e-5 * load_ * free.of.height);
}

TEST_F(RollingTireB, ASteadyStateDoesNotDependOnThePath) {
  const RollingState free = free_wheel();
  const auto at_once = rolling_.roll(free, slipping(free, 0.0, 0.04));
  ASSERT_TRUE(at_once) << at_once.failure().reason;
  const auto braked = rolling_.roll(free, slipping(free, -0.03, 0.0));
  ASSERT_TRUE(braked) << braked.failure().reason;
  const auto around = rolling_.roll(*braked, slipping(free, 0.0, 0.04));
  ASSERT_TRUE(around) << around.failure().reason;
  EXPECT_LT((at_once->forces.force - around->forces.force).norm(), 1e-4 * load_);
}

TEST_F(RollingTireB, ALockedWheelSlidesAsAWhole) {
  const RollingState free = free_wheel();
  const auto state = rolling_.roll(free, slipping(free, -1.0, 0.0));
  ASSERT_TRUE(state) << state.failure().reason;
  const RollingForces& at = state->forces;
  EXPECT_NEAR(at.force.x(), -at.force.z(), 1e-6 * load_);
  EXPECT_NEAR(at.friction_power, kSpeed * load_, 1e-4 * kSpeed * load_);
}

TEST_F(RollingTireB, SaysWhatIsOutOfRange) {
  RollingCase of = frictionless(10.0);
  of.speed = 0.0;
  EXPECT_NE(rolling_.roll(start_, of).failure().reason.find("above 0"), std::string::npos);
  of = frictionless(-10.0);
  EXPECT_NE(rolling_.roll(start_, of).failure().reason.find("forward"), std::string::npos);
  of = frictionless(10.0);
  of.drive = 50.0;
  EXPECT_NE(rolling_.roll(start_, of).failure().reason.find("torque"), std::string::npos);
  of.friction.at_rest = 0.8;
  of.load = load_;
  of.drive = 0.9 * load_ * start_.of.height;
  const std::string said = rolling_.roll(start_, of).failure().reason;
  EXPECT_NE(said.find("the ground carries at most"), std::string::npos) << said;
}

// The message of a state that is not found names the state to which the path was followed.
TEST_F(RollingTireB, SaysHowFarThePathWent) {
  RollingCase of = frictionless(1200.0);  // far above the standing-wave speed
  const auto state = rolling_.roll(start_, of);
  ASSERT_FALSE(state);
  for (const char* part : {"rad/s", "slip angle", "camber", "expected a lower speed"})
    EXPECT_NE(state.failure().reason.find(part), std::string::npos) << state.failure().reason;
}

/// mu p of a friction law at a point of the patch, Pa, with its terms written out.
double limit_of(const RollingFriction& law, const RollingPatchPoint& at) {
  const double log = std::log(std::hypot(at.slide_x, at.slide_y) / law.peak_speed) / law.width;
  const double by_speed = at.sticks ? 1.0 : 1.0 + (law.peak - 1.0) * std::exp(-log * log);
  return law.at_rest * std::pow(at.pressure / law.p_0, -law.a) * by_speed * at.pressure;
}

// A wheel that slides as a whole has the force of the law at each point's pressure and speed, and
// under less load more grip.
TEST_F(RollingTireB, ALockedWheelSlidesWithTheFrictionOfItsPressuresAndSpeeds) {
  RollingCase locked;
  locked.speed = kSpeed;
  locked.height = start_.of.height;
  locked.load = load_;
  locked.friction = {
      .at_rest = 1.2, .p_0 = 2e5, .a = 0.25, .peak = 1.3, .peak_speed = 8.0, .width = 1.5};
  const auto state = rolling_.roll(start_, locked);
  ASSERT_TRUE(state) << state.failure().reason;
  const double log = std::log(kSpeed / 8.0) / 1.5;
  double force = 0.0, by_speed = 1.0 + 0.3 * std::exp(-log * log);
  for (const RollingPatchPoint& point : state->patch)
    force += 1.2 * by_speed * std::pow(point.pressure / 2e5, -0.25) * point.pressure * point.area;
  EXPECT_NEAR(-state->forces.force.x(), force, 1e-6 * force);
  locked.load = 0.6 * load_;
  const auto lighter = rolling_.roll(*state, locked);
  ASSERT_TRUE(lighter) << lighter.failure().reason;
  const auto grip = [](const RollingState& of) {
    return -of.forces.force.x() / of.forces.force.z();
  };
  EXPECT_GT(grip(*lighter), grip(*state));
}

// Braking over the peak: every point has the friction of its own speed, and the force rises with
// the law, has its peak and falls.
TEST_F(RollingTireB, BrakesOverThePeakOfAFrictionThatDependsOnTheSpeed) {
  RollingState at = free_wheel();
  const RollingState free = at;
  const RollingFriction law{
      .at_rest = 0.8, .p_0 = 2.5e5, .a = 0.1, .peak = 1.5, .peak_speed = 2.0, .width = 1.3};
  std::vector<double> forces;
  for (const double kappa : {-0.02, -0.05, -0.1, -0.2, -0.4, -0.7, -1.0}) {
    RollingCase of = slipping(free, kappa, 0.0);
    of.friction = law;
    const auto next = rolling_.roll(at, of);
    ASSERT_TRUE(next) << kappa << ": " << next.failure().reason;
    at = *next;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double tractions = 0.0;
    for (const RollingPatchPoint& point : at.patch) {
      const Eigen::Vector2d t(point.shear_x, point.shear_y);
      sum += point.area * t;
      tractions += point.area * t.norm();
      const double limit = limit_of(law, point);
      if (point.sticks) {
        EXPECT_LE(t.norm(), (1.0 + 1e-6) * limit) << kappa;
      } else {
        EXPECT_NEAR(t.norm(), limit, 1e-6 * limit) << kappa;
      }
    }
    EXPECT_NEAR(at.forces.force.x(), sum.x(), 1e-6 * load_) << kappa;
    if (kappa == -1.0) {  // every point slides straight ahead
      EXPECT_NEAR(-sum.x(), tractions, 1e-6 * tractions) << kappa;
    }
    forces.push_back(-at.forces.force.x());
  }
  const auto top = std::ranges::max_element(forces) - forces.begin();
  EXPECT_EQ(top, 2);                      // w = 2 m/s at kappa = -0.1
  EXPECT_GT(forces[2], 1.3 * forces[6]);  // the falling branch
  EXPECT_TRUE(std::ranges::is_sorted(forces.begin() + 2, forces.end(), std::greater<>()));
}

// A tire whose belts cross has a side force and an aligning moment at no slip (ply steer). The
// mirror image of its angles is the mirror image of the tire, so that both change their signs and
// nothing else does. Tire B, of smeared cords without belts of its own angles, has neither.
TEST(PlySteer, ChangesItsSignWithTheMirrorImageOfTheAngles) {
  TireDescription tire = read_tire(Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) /
                                                  "studies/tires/passenger_205_55R16.toml")
                                       .root());
  tire.section.sectors = 40;
  tire.section.sector_zones = {{4, 0.06}};
  const auto free_wheel = [](const TireDescription& of) {
    FeTire rolled(of);
    RollingTire rolling(rolled);
    const Inflated inflated = *rolled.inflate(of.pressure);
    const auto pressed = rolled.advance(rolled.over(inflated, {}, FeTire::Poses::any),
                                        {FeTire::below(inflated, 0.015)});
    const RollingState start = rolling.start(pressed->back());
    RollingCase free;
    free.speed = kSpeed;
    free.spin = kSpeed / 0.31;
    free.load = 3000.0;
    free.drive = 0.0;
    const auto state = rolling.roll(start, free);
    EXPECT_TRUE(state) << state.failure().reason;
    return state->forces;
  };
  const RollingForces own = free_wheel(tire);
  for (CordPly& ply : tire.plies) ply.cords.angle = -ply.cords.angle;
  const RollingForces image = free_wheel(tire);
  EXPECT_GT(std::abs(own.force.y()), 20.0);   // N
  EXPECT_GT(std::abs(own.moment.z()), 0.05);  // N m
  constexpr double kRounding = 1e-10 * 3000.0;
  EXPECT_NEAR(own.force.y(), -image.force.y(), kRounding);
  EXPECT_NEAR(own.moment.z(), -image.moment.z(), kRounding);
  EXPECT_NEAR(own.force.x(), image.force.x(), kRounding);
  EXPECT_NEAR(own.moment.x(), -image.moment.x(), kRounding);
}

}  // namespace
}  // namespace latsch::fe_tire
