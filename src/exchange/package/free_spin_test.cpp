// SPDX-License-Identifier: Apache-2.0
// Tests the spin of the wheel inside a tire's unit (exchange/unit/tire_unit.h, equation (3)).
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/error.h"
#include "exchange/package/unit_folder.h"
#include "exchange/unit/tire_unit.h"
#include "experiment/language/specimen_models.h"
#include "models/road/plane_road.h"

namespace latsch::exchange {
namespace {

constexpr const char* kSpinningRing = "ring_tires/passenger_205_55R16.toml";
constexpr const char* kSpinningRigidRing = "tire_model_comparison/rigid_ring.tir";
constexpr const char* kSpinningFormula = "tire_model_comparison/magic_formula.tir";

/// A wheel that rolls straight ahead, on the road or lifted off it.
class SpinningWheel {
 public:
  SpinningWheel(const std::string& file, double height, double speed, double spin_rate) {
    const std::filesystem::path tire = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies" / file;
    const auto& kind = experiment::language().kind_of_file(tire);
    unit_ = unit_of(kind, kind.read(tire));
    set("wheel.z", height);
    set("wheel.vx", speed);
    set("wheel.spin_rate", spin_rate);
    speed_ = speed;
  }
  void make_free(double inertia) {
    set("spin.is_free", 1.0);
    set("spin.inertia", inertia);
  }
  void start() {
    const Status done = unit_->start(0.0);
    ASSERT_TRUE(done.ok()) << done.failure().reason;
  }
  void step(double step) {
    const Status done = unit_->step(time_, step);
    ASSERT_TRUE(done.ok()) << done.failure().reason;
    time_ += step;
    set("wheel.x", speed_ * time_);
  }
  std::size_t number(const std::string& name) const {
    for (std::size_t i = 0; i < unit_->variables().size(); ++i)
      if (unit_->variables()[i].name == name) return i;
    throw std::runtime_error("no variable " + name);
  }
  void set(const std::string& name, double value) { unit_->set(number(name), value); }
  double get(const std::string& name) const { return unit_->value(number(name)); }
  double time() const { return time_; }
  ExchangedModel& unit() { return *unit_; }

 private:
  std::unique_ptr<ExchangedModel> unit_;
  double time_ = 0.0, speed_ = 0.0;
};

// Off the road the tire has no moment, so the spin is that of a mass under a constant torque, for
// which the trapezoidal rule is exact; then the brake stops the wheel and holds it. A Magic Formula
// has no mass of its own.
TEST(FreeSpin, OffTheRoadIsThatOfAMassUnderConstantTorque) {
  constexpr double kInertia = 0.5, kTorque = 20.0, kStep = 1e-3;
  SpinningWheel wheel(kSpinningFormula, 2.0, 0.0, 10.0);
  wheel.make_free(kInertia);
  wheel.set("spin.drive", kTorque);
  wheel.start();
  for (int i = 0; i < 500; ++i) wheel.step(kStep);
  const double t = wheel.time();
  EXPECT_NEAR(wheel.get("spin.rate"), 10.0 + kTorque / kInertia * t, 1e-9);
  EXPECT_NEAR(wheel.get("spin.angle"), 10.0 * t + 0.5 * kTorque / kInertia * t * t, 1e-9);
  EXPECT_NEAR(wheel.get("carrier.My"), -kTorque, 1e-9);
  wheel.set("spin.brake", 100.0);
  for (int i = 0; i < 500; ++i) wheel.step(kStep);
  EXPECT_NEAR(wheel.get("spin.rate"), 0.0, 1e-9);
  EXPECT_NEAR(wheel.get("carrier.My"), 0.0, 1e-9);  // the brake holds against the drive
}

/// Returns the spin rate at 0.6 s of a wheel of 0.3 kg m^2 at 20 m/s whose brake pulls from 0.3 s
/// on. If `inside` is false, the rate is integrated beside the unit, as programs couple units.
double rate_of_braked_wheel(const std::string& tire, double height, double step, bool inside) {
  constexpr double kInertia = 0.3, kSpeed = 20.0, kBrake = 400.0;
  double rate = kSpeed / 0.306, angle = 0.0;
  SpinningWheel wheel(tire, height, kSpeed, rate);
  if (inside) wheel.make_free(kInertia);
  wheel.start();
  const int steps = static_cast<int>(std::lround(0.6 / step));
  for (int i = 0; i < steps; ++i) {
    const double brake = 2 * i >= steps ? kBrake : 0.0;
    if (inside) {
      wheel.set("spin.brake", brake);
    } else {
      wheel.set("wheel.spin", angle);
      wheel.set("wheel.spin_rate", rate);
    }
    wheel.step(step);
    if (inside) continue;
    angle += step * rate;
    rate += step * (wheel.get("hub.My") - brake) / kInertia;
  }
  return inside ? wheel.get("spin.rate") : rate;
}

// The reference is the coupling of a wheel beside the unit in short steps, which has no solution at
// steps of a few milliseconds. Its errors are of first order, so it is extrapolated to steps of 0.
TEST(FreeSpin, UnderABrakeIsThatOfACouplingInShortSteps) {
  constexpr double kHeight = 0.297, kShort = 1e-4;
  for (const char* tire : {kSpinningRing, kSpinningRigidRing}) {
    const double reference = 2.0 * rate_of_braked_wheel(tire, kHeight, kShort, false) -
                             rate_of_braked_wheel(tire, kHeight, 2.0 * kShort, false);
    ASSERT_GT(reference, 50.0) << tire;
    for (const auto& [step, limit] : {std::pair(1e-4, 2e-4), {1e-3, 1.3e-3}, {5e-3, 3e-3}})
      EXPECT_NEAR(rate_of_braked_wheel(tire, kHeight, step, true), reference, limit * reference)
          << tire << ", " << step;
  }
}

// The contact point of a Magic Formula has no mass, so its coupling is stiffer and needs shorter
// steps; a step of 5 ms is long for it, with an error of 0.8 percent.
TEST(FreeSpin, OnAMagicFormulaIsThatOfACouplingInVeryShortSteps) {
  constexpr double kHeight = 0.297, kShort = 1e-5;
  const double reference = 2.0 * rate_of_braked_wheel(kSpinningFormula, kHeight, kShort, false) -
                           rate_of_braked_wheel(kSpinningFormula, kHeight, 2.0 * kShort, false);
  for (const auto& [step, limit] : {std::pair(1e-4, 2e-4), {1e-3, 1.3e-3}, {5e-3, 1e-2}})
    EXPECT_NEAR(
        rate_of_braked_wheel(kSpinningFormula, kHeight, step, true), reference, limit * reference)
        << step;
}

TEST(FreeSpin, TheReactionOnTheCarrierIsTheTorqueOfTheBrake) {
  SpinningWheel wheel(kSpinningFormula, 0.3, 20.0, 65.0);
  wheel.make_free(0.5);
  wheel.set("spin.brake", 150.0);
  wheel.start();
  for (int i = 0; i < 100; ++i) wheel.step(1e-3);
  ASSERT_GT(wheel.get("spin.rate"), 1.0);
  EXPECT_NEAR(wheel.get("carrier.My"), 150.0, 1e-9);  // forward, as the wheel turns
}

TEST(FreeSpin, ACopyGoesOnWithTheSameBits) {
  SpinningWheel wheel(kSpinningRing, 0.297, 20.0, 65.0);
  wheel.make_free(0.5);
  wheel.set("spin.drive", 100.0);
  wheel.start();
  for (int i = 0; i < 10; ++i) wheel.step(1e-3);
  const auto copy = wheel.unit().clone();
  ASSERT_TRUE(copy->step(wheel.time(), 1e-3).ok());
  wheel.step(1e-3);
  for (const char* output : {"spin.angle", "spin.rate", "carrier.My", "hub.Fx"})
    EXPECT_EQ(copy->value(wheel.number(output)), wheel.get(output)) << output;
}

TEST(FreeSpin, WithoutItTheOutputsAreTheInputs) {
  SpinningWheel wheel(kSpinningFormula, 0.3, 20.0, 65.0);
  wheel.start();
  wheel.set("spin.drive", 500.0);
  wheel.step(1e-3);
  EXPECT_EQ(wheel.get("spin.rate"), 65.0);
  EXPECT_EQ(wheel.get("carrier.My"), 0.0);
}

TEST(FreeSpin, RefusesAWheelWithoutInertiaAndTellsABrakeThatDrives) {
  for (const double inertia : {0.0, -1.0}) {
    SpinningWheel wheel(kSpinningFormula, 0.3, 0.0, 0.0);
    wheel.make_free(inertia);
    try {
      (void)wheel.unit().start(0.0);
      ADD_FAILURE() << inertia;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("spin.inertia"), std::string::npos);
    }
  }
  SpinningWheel wheel(kSpinningFormula, 2.0, 0.0, 10.0);
  wheel.make_free(1.0);
  wheel.set("spin.brake", -50.0);
  wheel.start();
  wheel.step(1e-3);
  EXPECT_NEAR(wheel.get("spin.rate"), 10.0, 1e-12);
  const auto limits = wheel.unit().limits_met();
  ASSERT_FALSE(limits.empty());
  EXPECT_NE(limits.back().find("spin.brake was -50 N m"), std::string::npos) << limits.back();
}

}  // namespace
}  // namespace latsch::exchange
