// SPDX-License-Identifier: Apache-2.0
// Relaxation of the side force of tire B with few columns, beside differences of steady states.
#include "models/fe_tire/rolling/rolling_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/motion/tire_response.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::fe_tire {
namespace {

struct RelaxingTireB {
  RelaxingTireB() : tire(description()), rolling(tire), inflated(*tire.inflate(2.6e5)) {
    pressed =
        tire.advance(tire.over(inflated, {}, FeTire::Poses::any), {FeTire::below(inflated, 0.02)})
            ->back();
  }
  static TireDescription description() {
    TireDescription tire = reference_tire_b();
    tire.element = ElementKind::solid_shell;
    tire.section.meridional = 13;
    return tire;
  }
  RollingState free_wheel(double speed) {
    const RollingState start = rolling.start(pressed);
    RollingCase of;
    of.speed = speed;
    of.spin = speed / 0.312;
    of.load = start.forces.force.z();
    of.drive = 0.0;
    of.friction.at_rest = 5.0;  // hardly any point slides
    return *rolling.roll(start, of);
  }
  Result<RollingResponse> about(const RollingState& state) const {
    return RollingResponse::about(
        tire.mesh(), tire.materials(), {.element = ElementKind::solid_shell}, state);
  }
  FeTire tire;
  RollingTire rolling;
  Inflated inflated;
  TireState pressed;
};

TEST(RollingResponse, SlowlyIsTheCorneringStiffness) {
  RelaxingTireB of;
  const RollingState free = of.free_wheel(20.0);
  constexpr double kAngle = 2e-4;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const double sign : {1.0, -1.0}) {
    RollingCase slipping = free.of;
    slipping.drive.reset();
    slipping.slip_angle = sign * kAngle;
    slipping.speed = 20.0 / std::cos(kAngle);
    const auto state = of.rolling.roll(free, slipping);
    ASSERT_TRUE(state) << state.failure().reason;
    sum += sign * Eigen::Vector3d(0.0, state->forces.force.y(), state->forces.moment.z());
  }
  const Eigen::Vector3d slope = sum / (2.0 * kAngle);
  const auto response = of.about(free);
  ASSERT_TRUE(response) << response.failure().reason;
  const SlipResponse slow = response->by_slip_angle(1e-3);
  EXPECT_NEAR(slow.Fy.real() / slope[1], 1.0, 5e-3);
  EXPECT_NEAR(slow.Mz.real() / slope[2], 1.0, 1e-2);
  EXPECT_LT(std::abs(slow.Fy.imag()), 1e-2 * std::abs(slow.Fy.real()));
}

// Without inertia the response depends on the distance rolled alone, but for centrifugal forces; it
// falls and lags more and more, nearly as a slip that lags by the relaxation length.
TEST(RollingResponse, LagsByADistance) {
  RelaxingTireB of;
  const auto slow = of.about(of.free_wheel(5.0)), fast = of.about(of.free_wheel(10.0));
  ASSERT_TRUE(slow && fast);
  const SlipResponse at_low = slow->by_slip_angle(0.5), at_high = fast->by_slip_angle(1.0);
  EXPECT_NEAR(at_low.relaxation / at_high.relaxation, 1.0, 2e-2);
  // A stretched string relaxes over its cornering stiffness by its lateral stiffness at rest
  // [Pacejka, Tire and Vehicle Dynamics, chapter 5], which holds roughly for a tire.
  const auto rough = of.tire.advance(of.tire.over(of.inflated, {.mu = 5.0}, FeTire::Poses::any),
                                     {FeTire::below(of.inflated, 0.02)});
  const auto standing =
      TireResponse::about(of.tire,
                          build_losses(RelaxingTireB::description()),
                          rough->back(),
                          {{.of = ResponsePort::Of::ground, .axis = Eigen::Vector3d::UnitY()}},
                          {.highest = 30.0});
  const double lateral = standing->at(0.01)(0, 0).real();
  const double cornering = -slow->by_slip_angle(1e-3).Fy.real();
  EXPECT_NEAR(at_low.relaxation / (cornering / lateral), 1.0, 0.1);
  const double sigma = at_low.relaxation, C = slow->by_slip_angle(1e-3).Fy.real();
  for (const double frequency : {0.4, 0.8, 1.6}) {
    const std::complex<double> lag(1.0, 2.0 * std::numbers::pi * frequency * sigma / 5.0);
    const std::complex<double> Fy = slow->by_slip_angle(frequency).Fy;
    EXPECT_LT(std::abs(Fy - C / lag), 0.01 * std::abs(C / lag)) << frequency;
  }
}

}  // namespace
}  // namespace latsch::fe_tire
