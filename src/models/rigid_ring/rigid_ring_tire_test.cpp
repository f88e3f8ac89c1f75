// SPDX-License-Identifier: Apache-2.0
#include "models/rigid_ring/rigid_ring_tire.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/magic_formula/round_tire_testing.h"
#include "models/rigid_ring/ring_doubts.h"
#include "models/road/plane_road.h"

namespace latsch::rigid_ring {
namespace {

using Eigen::Vector3d;
using magic_formula::MagicFormula;
using magic_formula::Parameters;
using road::PlaneRoad;

/// Returns the round tire with a belt, stiff enough sideways for the file's overall stiffness.
Parameters ring_tire() {
  Parameters p = magic_formula::round_tire();
  p.BELT_MASS = 7.0;
  p.BELT_IXX = 0.34;
  p.BELT_IYY = 0.6;
  p.FREQ_LONG = 80.0;
  p.FREQ_LAT = 45.0;
  p.FREQ_YAW = 55.0;
  p.FREQ_WINDUP = 70.0;
  p.DAMP_LONG = p.DAMP_LAT = p.DAMP_YAW = p.DAMP_WINDUP = 0.04;
  p.DAMP_RESIDUAL = 0.002;
  p.DAMP_VLOW = 0.001;
  p.GRAVITY = 0.0;  // so that forces can be compared with those of tires without mass
  p.ELLIPS_NWIDTH = 3.0;
  return p;
}

std::unique_ptr<RigidRingTire> make(const Parameters& p) {
  auto tire = RigidRingTire::make(p);
  EXPECT_TRUE(tire.ok());
  return std::move(*tire);
}

WheelMotion standing(double height) {
  WheelMotion motion;
  motion.center = {0.0, 0.0, height};
  return motion;
}

/// A flat road with a step up at x = 0.
class StepRoad : public road::Road {
 public:
  explicit StepRoad(double height) : height_(height) {}
  road::GroundPoint at(double x, double, double) const override {
    return {.height = x < 0.0 ? 0.0 : height_};
  }

 private:
  double height_;
};

TEST(RingConstants, OfTheSampleFile) {
  // Belt 7 kg, 80 Hz, 0.6 kg m^2, 70 Hz, C_z 314931 N/m, C_x 391220 N/m give 1.769e6, 1.161e5,
  // 3.83e5, 1.24e6 by the closed forms.
  Parameters p = ring_tire();
  p.VERTICAL_STIFFNESS = 314931.0;
  p.LONGITUDINAL_STIFFNESS = 391220.0;
  const RingConstants c = *ring_constants(p, 0.3716);
  EXPECT_NEAR(c.k_bx, 1.769e6, 0.001e6);
  EXPECT_NEAR(c.k_btheta, 1.161e5, 0.001e5);
  EXPECT_NEAR(c.c_rz, 3.83e5, 0.01e5);
  EXPECT_NEAR(c.c_rx, 1.24e6, 0.01e6);
  EXPECT_NEAR(1.0 / p.LONGITUDINAL_STIFFNESS,
              1.0 / c.k_bx + 0.3716 * 0.3716 / c.k_btheta + 1.0 / c.c_rx,
              1e-15);
  p.BELT_MASS = 0.0;
  EXPECT_FALSE(ring_constants(p, 0.37).ok());
}

TEST(RigidRing, AtRestItStandsAsTheMagicFormula) {
  const Parameters p = ring_tire();
  const auto tire = make(p);
  const auto rest = tire->settle(standing(0.28), PlaneRoad(), 0.0);
  ASSERT_TRUE(rest.ok());
  EXPECT_NEAR(rest->force.z(), 4000.0, 1e-6);  // 200 N/mm over 20 mm, whatever the belt does
  EXPECT_NEAR(tire->belt_displacement().z(), 4000.0 / tire->constants().k_bx, 1e-9);
  EXPECT_NEAR(rest->force.x(), 0.0, 1e-9);
  EXPECT_NEAR(rest->moment.norm(), 0.0, 1e-9);
}

TEST(RigidRing, AtRestItStandsOnTheLoadCurveOfTheFile) {
  Parameters p = ring_tire();
  p.curve_deflection = {0.0, 0.01, 0.02};
  p.curve_force = {0.0, 2000.0, 5000.0};
  const auto tire = make(p);
  for (const auto& [rho, Fz] : {std::pair{0.005, 1000.0}, {0.015, 3500.0}, {0.03, 8000.0}}) {
    const auto rest = tire->settle(standing(0.3 - rho), PlaneRoad(), 0.0);
    ASSERT_TRUE(rest.ok());
    EXPECT_NEAR(rest->force.z(), Fz, 1e-6 * Fz);
  }
  // The residual spring completes the slope of the curve at FNOMIN, 300 N/mm.
  const RingConstants& c = tire->constants();
  EXPECT_NEAR(1.0 / (1.0 / c.k_bx + 1.0 / c.c_rz), 3e5, 1e-3);
}

TEST(RigidRing, CamsAndBeltsOfNoTireAreRefusedByTheirCoefficient) {
  struct Odd {
    double Parameters::*member;
    double value;
    const char* name;
  };
  constexpr Odd kOdd[] = {{&Parameters::ELLIPS_SHIFT, 125.6, "ELLIPS_SHIFT is 125.6"},
                          {&Parameters::ELLIPS_SHIFT, 0.0, "ELLIPS_SHIFT"},
                          {&Parameters::ELLIPS_HEIGHT, -1.0, "ELLIPS_HEIGHT is -1"},
                          {&Parameters::ELLIPS_LENGTH, 0.0, "ELLIPS_LENGTH is 0"},
                          {&Parameters::ELLIPS_ORDER, 0.5, "ELLIPS_ORDER is 0.5"},
                          {&Parameters::Q_RA1, 39.0, "Q_RA1"},
                          {&Parameters::FREQ_LONG, 8.0, "FREQ_LONG = 8 Hz"}};
  for (const Odd& odd : kOdd) {
    Parameters p = ring_tire();
    p.*odd.member = odd.value;
    const auto tire = RigidRingTire::make(p);
    ASSERT_FALSE(tire.ok()) << odd.name;
    EXPECT_NE(tire.failure().reason.find(odd.name), std::string::npos) << tire.failure().reason;
  }
}

TEST(RigidRing, ContradictionsAndAssumptionsAreDoubted) {
  const auto doubts = [](const Parameters& p, const std::string& missing = "") {
    std::string all;
    for (const std::string& one :
         ring_doubts(p, [&](std::string_view name) { return !name.starts_with(missing + "_"); }))
      all += one + "\n";
    return all;
  };
  const auto expect_part = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  Parameters p = ring_tire();
  EXPECT_EQ(doubts(p, "NONE"), "");
  expect_part(doubts(p, "ELLIPS"),
              "ELLIPS_SHIFT = 0.8, ELLIPS_LENGTH = 1, ELLIPS_HEIGHT = 1, "
              "ELLIPS_ORDER = 1.8, ELLIPS_NWIDTH = 10 are assumed");
  expect_part(doubts(p, "DAMP"), "there is no DAMP_LONG");
  p.LATERAL_STIFFNESS = 97e6;
  expect_part(doubts(p, "NONE"), "LATERAL_STIFFNESS is 9.7e+04 N/mm, but the belt of FREQ_LAT");
  p.LATERAL_STIFFNESS = 1.5e5;
  p.LONGITUDINAL_STIFFNESS = 176.0;
  expect_part(doubts(p, "NONE"), "LONGITUDINAL_STIFFNESS is 0.176 N/mm, but the belt of FREQ_LONG");
  p.LONGITUDINAL_STIFFNESS = 3e5;
  p.FREQ_WINDUP = p.FREQ_LONG = 6866.0;
  expect_part(doubts(p, "NONE"), "times as stiff");
  p = ring_tire();
  p.GRAVITY = 9.81;
  expect_part(doubts(p, "NONE"), "GRAVITY is 9.81");
  p.ELLIPS_NWIDTH = 50.0;
  expect_part(doubts(p, "NONE"), "10 pairs of cams are used");
}

TEST(RigidRing, StandingItIsAsStiffAsTheFileSays) {
  const Parameters p = ring_tire();
  for (const bool sideways : {false, true}) {
    const auto tire = make(p);
    ASSERT_TRUE(tire->constants().too_soft.empty());
    WheelMotion motion = standing(0.28);
    ASSERT_TRUE(tire->settle(motion, PlaneRoad(), 0.0).ok());
    constexpr double kPush = 1e-4, kStep = 1e-3;
    constexpr int kSteps = 400;
    Result<HubForces> hub = HubForces{};
    for (int i = 0; i < 2 * kSteps; ++i) {
      // The rim is pushed smoothly over the first half, then held.
      const double rate = i < kSteps ? kPush / (kSteps * kStep) *
                                           (1.0 - std::cos(2.0 * std::numbers::pi * i / kSteps))
                                     : 0.0;
      const Vector3d v = sideways ? Vector3d(0.0, rate, 0.0) : Vector3d(rate, 0.0, 0.0);
      motion.velocity = v;
      motion.center += v * kStep;
      hub = tire->advance(motion, PlaneRoad(), 0.0, kStep);
      ASSERT_TRUE(hub.ok());
    }
    // Sideways the belt tilts, and its camber thrust reduces the force by 2 %.
    if (sideways)
      EXPECT_NEAR(-hub->force.y() / kPush, p.LATERAL_STIFFNESS, 0.03 * p.LATERAL_STIFFNESS);
    else
      EXPECT_NEAR(
          -hub->force.x() / kPush, p.LONGITUDINAL_STIFFNESS, 0.02 * p.LONGITUDINAL_STIFFNESS);
  }
}

TEST(RigidRing, RollingSteadilyItGivesTheMagicFormula) {
  const Parameters p = ring_tire();
  const auto tire = make(p);
  const MagicFormula formula(p);
  const double kappa = 0.03, speed = 15.0;
  const auto s = formula.evaluate({4000.0, kappa, 0.0, 0.0, 0.0, speed, 2.2e5});
  WheelMotion motion = standing(s.R_l);
  ASSERT_TRUE(tire->settle(motion, PlaneRoad(), 0.0).ok());
  motion.velocity.x() = speed;
  motion.spin_rate = (1.0 + kappa) * speed / s.R_e;
  Result<HubForces> hub = HubForces{};
  for (int i = 0; i < 3000; ++i) hub = tire->advance(motion, PlaneRoad(), 0.0, 1e-3);
  ASSERT_TRUE(hub.ok());
  EXPECT_NEAR(
      tire->contact_forces().Fz, 4000.0, 5.0);  // rotating dampers lift the ring by c Omega x/k
  const auto there =
      formula.evaluate({tire->contact_forces().Fz, kappa, 0.0, 0.0, 0.0, speed, 2.2e5});
  EXPECT_NEAR(hub->force.x(), there.Fx, 1e-3 * there.Fx);
  EXPECT_NEAR(hub->force.z(), tire->contact_forces().Fz, 1e-3);
}

/// Returns the frequency, Hz, of a hub force or moment while the rim, in the air, is held after a
/// jerk.
template <class Read>
double ringing(RigidRingTire& tire, const Vector3d& jerk, const Vector3d& twist, Read read) {
  constexpr double kStep = 1e-4;
  WheelMotion motion = standing(1.0);
  (void)tire.settle(motion, PlaneRoad(), 0.0);
  motion.velocity = jerk;
  motion.angular_velocity = twist;
  motion.spin_rate = twist.y();
  (void)tire.advance(motion, PlaneRoad(), 0.0, kStep);
  motion.velocity.setZero();
  motion.angular_velocity.setZero();
  motion.spin_rate = 0.0;
  std::vector<double> crossings;
  double before = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double now = read(*tire.advance(motion, PlaneRoad(), 0.0, kStep));
    if (before < 0.0 && now >= 0.0) crossings.push_back((i - now / (now - before)) * kStep);
    before = now;
  }
  return static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
}

TEST(RigidRing, InTheAirItRingsAtTheFrequenciesOfTheFile) {
  const Parameters p = ring_tire();
  const auto tire = make(p);
  const double damped = std::sqrt(1.0 - 0.04 * 0.04);
  const auto x = [](const HubForces& hub) { return hub.force.x(); };
  const auto y = [](const HubForces& hub) { return hub.force.y(); };
  const auto wind_up = [](const HubForces& hub) { return hub.moment.y(); };
  EXPECT_NEAR(ringing(*tire, {1.0, 0, 0}, {0, 0, 0}, x), 80.0 * damped, 0.05);
  EXPECT_NEAR(ringing(*tire, {0, 1.0, 0}, {0, 0, 0}, y), 45.0 * damped, 0.05);
  EXPECT_NEAR(ringing(*tire, {0, 0, 0}, {0, 1.0, 0}, wind_up), 70.0 * damped, 0.05);
}

TEST(RigidRing, OverAStepTheLoadRisesAndSettlesAgain) {
  const Parameters p = ring_tire();
  const auto tire = make(p);
  const StepRoad road(0.005);
  WheelMotion motion = standing(0.28);
  motion.center.x() = -0.5;
  ASSERT_TRUE(tire->settle(motion, road, 0.0).ok());
  motion.velocity.x() = 8.0;
  motion.spin_rate = 8.0 / 0.295;
  double highest = 0.0;
  Result<HubForces> hub = HubForces{};
  for (int i = 0; i < 500; ++i) {
    motion.center.x() += 8.0 * 1e-3;
    hub = tire->advance(motion, road, 1e-3 * i, 1e-3);
    ASSERT_TRUE(hub.ok());
    if (motion.center.x() > -0.2) highest = std::max(highest, hub->force.z());
  }
  EXPECT_GT(highest, 5000.0);                 // more than the static 200 N/mm times 25 mm
  EXPECT_NEAR(hub->force.z(), 5000.0, 50.0);  // final value
}

/// A wave A sin(k x), smooth where the cams touch it.
class SineRoad : public road::Road {
 public:
  explicit SineRoad(double A = 0.004, double k = 4.0) : A_(A), k_(k) {}
  road::GroundPoint at(double x, double, double) const override {
    return {.height = A_ * std::sin(k_ * x)};
  }
  road::GroundBounds bounds(const road::GroundBox& box, double) const override {
    const double quarter = 0.5 * std::numbers::pi, turn = 4.0 * quarter;
    const double crest = turn * std::ceil((k_ * box.x0 - quarter) / turn) + quarter;
    if (crest <= k_ * box.x1) return {A_, false};
    return {A_ * std::max(std::sin(k_ * box.x0), std::sin(k_ * box.x1)), false};
  }

 private:
  double A_, k_;
};

/// Returns the hub force after 0.04 s over a smooth wave, drifting, braked, in `parts` steps.
Vector3d after_a_ride(const Parameters& p, int parts) {
  constexpr double kTime = 0.04, kSpeed = 20.0, omega = 2.0 * std::numbers::pi * 12.0;
  const auto tire = make(p);
  const SineRoad road;
  WheelMotion motion;
  Vector3d force;
  for (int i = 0; i <= parts; ++i) {
    const double t = kTime * i / parts;
    motion.center = {kSpeed * t, 0.0, 0.28 + 0.002 * std::cos(omega * t)};
    motion.velocity = {kSpeed, 0.5 * std::sin(omega * t), -0.002 * omega * std::sin(omega * t)};
    motion.carrier =
        Eigen::AngleAxisd(0.02 * std::sin(omega * t), Vector3d::UnitX()).toRotationMatrix();
    motion.angular_velocity.x() = 0.02 * omega * std::cos(omega * t);
    motion.spin_rate = kSpeed / 0.295 * (1.0 - 0.03 * std::sin(0.7 * omega * t));
    const auto hub =
        i == 0 ? tire->settle(motion, road, 0.0) : tire->advance(motion, road, t, kTime / parts);
    EXPECT_TRUE(hub.ok());
    force = hub->force;
  }
  return force;
}

TEST(RigidRing, IsOfOrderTwoInItsStep) {
  Parameters p = ring_tire();
  p.Q_FCX = 0.2;
  p.Q_FCY = 0.3;
  std::vector<Vector3d> forces;
  for (const int parts : {160, 320, 640}) forces.push_back(after_a_ride(p, parts));
  for (int axis = 0; axis < 3; ++axis) {
    const double one = std::abs((forces[1] - forces[0])[axis]);
    const double other = std::abs((forces[2] - forces[1])[axis]);
    EXPECT_GT(one, 3.4 * other) << "axis " << axis << ": " << one << " " << other;
  }
}

// The number of substeps must depend on the distance that the patch rolls, not on that of the
// wheel: on a belt the wheel stands still.
TEST(RigidRing, OnAFastBeltItRollsAsOverAFastRoad) {
  Parameters p = ring_tire();
  p.PKX1 = 2.0;  // relaxation lengths of a centimeter
  p.PKY1 = -2.0;
  constexpr double kSpeed = 80.0, kStep = 1e-3;
  Vector3d forces[2];
  for (const bool belt : {false, true}) {
    const auto tire = make(p);
    const PlaneRoad road({.belt = belt ? kSpeed : 0.0});
    WheelMotion motion = standing(0.28);
    motion.spin_rate = kSpeed / 0.295;
    motion.velocity = {belt ? 0.0 : kSpeed, 1.0, 0.0};
    ASSERT_TRUE(tire->settle(motion, road, 0.0).ok());
    Result<HubForces> hub = HubForces{};
    for (int i = 1; i <= 60; ++i) {
      motion.center += kStep * motion.velocity;
      hub = tire->advance(motion, road, i * kStep, kStep);
      ASSERT_TRUE(hub.ok());
    }
    forces[belt] = hub->force;
  }
  EXPECT_LT((forces[1] - forces[0]).norm(), 1e-9 * forces[0].norm());
}

/// Returns a ring tire whose effective radius depends on the load, and which rolls without
/// resistance.
Parameters free_rolling_tire() {
  Parameters p = ring_tire();
  p.QSY1 = 0.0;
  p.FREFF = 0.3;  // gives a visible change of R_e: 6 mm over the nominal load
  return p;
}

/// Values in each step of a wheel that rolls freely at 2 m/s and constant height over a wave.
struct Rolled {
  double omega, R_e, beta, height, Fz;
  Vector3d center;  // center of the belt
};
std::vector<Rolled> roll_over(const Parameters& p, const SineRoad& road, double way) {
  constexpr double kSpeed = 2.0, kStep = 5e-4, kInertia = 1.0;
  const auto tire = make(p);
  const MagicFormula formula(p);
  WheelMotion motion = standing(0.28);
  EXPECT_TRUE(tire->settle(motion, road, 0.0).ok());
  motion.velocity.x() = kSpeed;
  motion.spin_rate = kSpeed / 0.295;
  std::vector<Rolled> rolled;
  for (int i = 1; motion.center.x() < way; ++i) {
    motion.center.x() += kStep * kSpeed;
    const auto hub = tire->advance(motion, road, i * kStep, kStep);
    EXPECT_TRUE(hub.ok());
    const double Fz = tire->contact_forces().Fz;
    const auto at = formula.evaluate({Fz, 0.0, 0.0, 0.0, 0.0, kSpeed, 2.2e5});
    const auto& plane = tire->effective_plane();
    const Vector3d center = motion.center + tire->belt_displacement();
    rolled.push_back({motion.spin_rate,
                      at.R_e,
                      std::atan2(-plane.normal.x(), plane.normal.z()),
                      plane.normal.dot(center - plane.point),
                      Fz,
                      center});
    motion.spin_rate += kStep / kInertia * hub->moment.y();
  }
  return rolled;
}

// On a long wave a slow free wheel turns at V/R_e with R_e of the instantaneous load.
TEST(RigidRing, OverALongWaveTheSpinFollowsTheRadiusOfTheLoad) {
  const auto rolled = roll_over(free_rolling_tire(), SineRoad(0.005, 0.5), 25.0);
  double off = 0.0, varies = 0.0, load = 0.0;
  for (std::size_t i = rolled.size() / 2; i < rolled.size(); ++i) {
    const Rolled& r = rolled[i];
    off = std::max(off, std::abs(r.omega * r.R_e / 2.0 - 1.0));
    varies = std::max(varies, std::abs(r.omega / rolled[rolled.size() / 2].omega - 1.0));
    load = std::max(load, r.Fz);
  }
  EXPECT_GT(load, 4900.0);
  EXPECT_GT(varies, 4e-3);
  EXPECT_LT(off, 0.005 * varies);
}

// On a shorter wave slope and curvature matter: omega R_e = V cos(beta) + (R_l - R_e) dbeta/dt,
// also for a tire whose axle follows the wave. A disk would turn as on flat ground.
TEST(RigidRing, OverAShortWaveTheSpinFollowsTheCurvature) {
  Parameters p = free_rolling_tire();
  p.FREFF = p.DREFF = 0.0;  // R_e is that of the free tire at every load
  const auto rolled = roll_over(p, SineRoad(0.004, 4.0), 16.0);
  double off = 0.0, varies = 0.0;
  // In the last quarter the vibration from the start has decayed.
  for (std::size_t i = rolled.size() * 3 / 4; i + 1 < rolled.size(); ++i) {
    const Rolled &r = rolled[i], &before = rolled[i - 1], &after = rolled[i + 1];
    const double turning = (after.beta - before.beta) / 1e-3;
    const Vector3d along(std::cos(r.beta), 0.0, std::sin(r.beta));
    const double speed = along.dot(after.center - before.center) / 1e-3;
    const double omega = (speed + (r.height - r.R_e) * turning) / r.R_e;
    off = std::max(off, std::abs(r.omega - omega));
    varies = std::max(varies, std::abs(r.omega - 2.0 / r.R_e));
  }
  EXPECT_GT(varies, 5e-3);
  EXPECT_LT(off, 0.01 * varies);
}

// The wheel is braked over a long wave at constant spin, straight on and in a corner, so the slip
// itself depends on the load. The force is that of the formula at kappa = omega R_e(Fz)/V - 1,
// delayed by the springs of patch and belt: d(sigma_c kappa')/dt = V (kappa - kappa') - dFx/dt /
// k_b.
TEST(RigidRing, BrakedOverALongWaveTheSlipFollowsTheRadiusOfTheLoad) {
  const Parameters p = free_rolling_tire();
  const MagicFormula formula(p);
  const SineRoad road(0.005, 0.5);
  constexpr double kSpeed = 2.0, kStep = 1e-3;
  for (const double alpha : {0.0, 0.03}) {
    const auto tire = make(p);
    WheelMotion motion = standing(0.28);
    ASSERT_TRUE(tire->settle(motion, road, 0.0).ok());
    motion.velocity = {kSpeed, kSpeed * std::tan(alpha), 0.0};
    motion.spin_rate = 0.97 * kSpeed / 0.294;
    double least = 0.0, most = -1.0, off = 0.0, u = 0.0, Fx_before = 0.0;
    for (int i = 1; i < 12000; ++i) {
      motion.center += kStep * motion.velocity;
      ASSERT_TRUE(tire->advance(motion, road, i * kStep, kStep).ok());
      const double Fz = tire->contact_forces().Fz;
      const auto still = formula.evaluate({Fz, 0.0, 0.0, 0.0, 0.0, kSpeed, 2.2e5});
      const double kappa = motion.spin_rate * still.R_e / kSpeed - 1.0;
      const auto& ring = tire->constants();
      const double by_belt = 1.0 / ring.k_bx + still.R_l * still.R_e / ring.k_btheta;
      const double Fx = tire->contact_forces().Fx, sigma_c = still.Kxk / ring.c_rx;
      u += kStep * kSpeed * (kappa - u / sigma_c) - (Fx - Fx_before) * by_belt;
      Fx_before = Fx;
      if (i < 3000) continue;
      const auto s = formula.evaluate({Fz, u / sigma_c, alpha, 0.0, 0.0, kSpeed, 2.2e5});
      off = std::max(off, std::abs(tire->contact_forces().Fx / s.Fx - 1.0));
      least = std::min(least, kappa);
      most = std::max(most, kappa);
    }
    EXPECT_LT(off, alpha == 0.0 ? 1e-3 : 0.01);  // the belt turns a little under Mz
    EXPECT_GT(most - least, 8e-3);               // compared with a slip of 3 %
  }
}

/// Returns the forces on a ring at rest after it was moved by the distance `way` and turned by
/// `angle` in a smooth bump of velocity that lasts `time`, and then held for as long.
HubForces moved(RigidRingTire& tire, const Vector3d& way, double angle, double time) {
  constexpr double kStep = 1e-3;
  WheelMotion motion = standing(0.28);
  EXPECT_TRUE(tire.settle(motion, PlaneRoad(), 0.0).ok());
  HubForces hub;
  const int steps = static_cast<int>(time / kStep);
  for (int i = 1; i <= 2 * steps; ++i) {
    const double rate =
        i < steps ? (1.0 - std::cos(2.0 * std::numbers::pi * i / steps)) / time : 0.0;
    motion.velocity = rate * way;
    motion.angular_velocity.z() = rate * angle;
    motion.center += kStep * motion.velocity;
    motion.carrier = Eigen::AngleAxisd(kStep * rate * angle, Vector3d::UnitZ()) * motion.carrier;
    const auto result = tire.advance(motion, PlaneRoad(), i * kStep, kStep);
    EXPECT_TRUE(result.ok());
    hub = *result;
  }
  return hub;
}

TEST(RigidRing, PushedFarWhileStandingItIsHeldByFriction) {
  const Parameters p = ring_tire();
  EXPECT_NEAR(moved(*make(p), {0.3, 0.0, 0.0}, 0.0, 3.0).force.x(), -4800.0, 60.0);
  EXPECT_NEAR(moved(*make(p), {0.0, 0.3, 0.0}, 0.0, 3.0).force.y(), -4000.0, 60.0);
}

// The limit is that of the file's turn slip, the slope its yaw stiffness: the belt's springs in
// series with the residual one.
TEST(RigidRing, TurnedOnTheSpotItIsHeldByYawStiffnessUpToTheFormulasTorque) {
  Parameters p = ring_tire();
  p.YAW_STIFFNESS = 5000.0;
  const double M_inf = 0.2 * 4000.0 * 0.3;
  EXPECT_NEAR(moved(*make(p), {0.0, 0.0, 0.0}, 0.6, 3.0).moment.z(), -M_inf, 0.01 * M_inf);
  EXPECT_NEAR(moved(*make(p), {0.0, 0.0, 0.0}, 1e-4, 1.0).moment.z(), -0.5, 0.01 * 0.5);
}

// The motion includes standstill, steered and pushed aside; then the same backward, mirrored across
// the road.
TEST(RigidRing, TheMirroredWayBackwardGivesMirroredForces) {
  Parameters p = ring_tire();
  p.YAW_STIFFNESS = 5000.0;
  constexpr double kStep = 1e-3;
  std::vector<HubForces> hubs[2];
  for (const int back : {0, 1}) {
    const double way = back ? -1.0 : 1.0;
    const auto tire = make(p);
    const SineRoad road(0.003, 4.0);
    WheelMotion motion = standing(0.28);
    motion.center.x() = std::numbers::pi / 8.0;  // a crest, from which both directions are alike
    double heading = 0.0;
    ASSERT_TRUE(tire->settle(motion, road, 0.0).ok());
    for (int i = 1; i <= 2000; ++i) {
      const double t = i * kStep, Vx = way * 2.0 * std::sin(0.5 * std::numbers::pi * t + 1.0);
      const double yaw_rate = way * 0.2 * std::sin(3.0 * t);
      motion.velocity = {Vx, 0.05 * std::sin(4.0 * t), 0.0};
      motion.angular_velocity.z() = yaw_rate;
      motion.spin_rate = 0.98 * Vx / 0.2946;
      motion.center += kStep * motion.velocity;
      heading += kStep * yaw_rate;
      motion.carrier = Eigen::AngleAxisd(heading, Vector3d::UnitZ()).toRotationMatrix();
      const auto hub = tire->advance(motion, road, t, kStep);
      ASSERT_TRUE(hub.ok());
      hubs[back].push_back(*hub);
    }
  }
  for (std::size_t i = 0; i < hubs[0].size(); ++i) {
    const HubForces &ahead = hubs[0][i], &back = hubs[1][i];
    ASSERT_LT((back.force - Vector3d(-ahead.force.x(), ahead.force.y(), ahead.force.z())).norm(),
              1e-3);
    ASSERT_LT(
        (back.moment - Vector3d(ahead.moment.x(), -ahead.moment.y(), -ahead.moment.z())).norm(),
        1e-3);
  }
}

TEST(RigidRing, AMotionThatIsNoneIsToldAndForgotten) {
  const auto tire = make(ring_tire());
  WheelMotion motion = standing(0.28);
  ASSERT_TRUE(tire->settle(motion, PlaneRoad(), 0.0).ok());
  motion.velocity.x() = 0.1;
  ASSERT_TRUE(tire->advance(motion, PlaneRoad(), 0.0, 1e-3).ok());
  const auto twin = tire->clone();
  WheelMotion none = motion;
  none.center.z() = std::nan("");
  EXPECT_FALSE(tire->advance(none, PlaneRoad(), 0.0, 1e-3).ok());
  EXPECT_FALSE(tire->advance(motion, PlaneRoad(), 0.0, -1e-3).ok());
  EXPECT_TRUE(tire->advance(motion, PlaneRoad(), 0.0, 0.0)->force.allFinite());
  const auto a = tire->advance(motion, PlaneRoad(), 0.0, 1e-3);
  const auto b = twin->advance(motion, PlaneRoad(), 0.0, 1e-3);
  EXPECT_EQ(a->force, b->force);
  EXPECT_EQ(a->moment, b->moment);
}

}  // namespace
}  // namespace latsch::rigid_ring
