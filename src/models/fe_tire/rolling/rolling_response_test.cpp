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
  /// Differences of steady forces over small steps need equilibria without any residual.
  RelaxingTireB()
      : meshed(description()),
        tire(meshed.mesh(),
             meshed.materials(),
             {.element = ElementKind::solid_shell, .tolerance = 1e-10}),
        rolling(tire),
        inflated(*tire.inflate(2.6e5)) {
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
    return RollingResponse::about(tire, state);
  }
  FeTire meshed, tire;
  RollingTire rolling;
  Inflated inflated;
  TireState pressed;
};

/// Changes of force and moment between two steady states, per unit of their difference.
SlipResponse difference(const RollingState& above, const RollingState& below, double change) {
  return {((above.forces.force - below.forces.force) / change).cast<std::complex<double>>(),
          ((above.forces.moment - below.forces.moment) / change).cast<std::complex<double>>()};
}

/// Returns the case whose slip is changed, at the same speed along the heading.
RollingCase changed(RollingCase of, SlipInput slip, double by) {
  const double along = of.speed * std::cos(of.slip_angle);
  if (slip == SlipInput::angle) of.slip_angle += by;
  if (slip == SlipInput::spin) of.spin *= 1.0 + by;
  if (slip == SlipInput::turn) of.turn_slip += by;
  if (slip == SlipInput::camber) of.camber += by;
  of.speed = along / std::cos(of.slip_angle);
  return of;
}

/// Step of a slip between steady states: no point begins to slide or to touch.
constexpr double kSlopeStep[] = {2e-5, 2e-5, 1e-4, 2e-4};

// At 0 Hz the responses are the slopes of steady forces: of a free wheel, most of which sticks, and
// of a wheel that corners, leans, is driven and turns, where four of five points slide.
TEST(RollingResponse, SlowlyIsTheSlopeOfSteadyForces) {
  RelaxingTireB of;
  const RollingState free = of.free_wheel(20.0);
  RollingCase skewed = free.of;
  skewed.drive.reset();
  skewed.slip_angle = 0.03;
  skewed.camber = 0.03;
  skewed.turn_slip = 0.02;
  skewed.spin *= 1.01;
  skewed.friction.at_rest = 1.0;
  const auto skew = of.rolling.roll(free, skewed);
  ASSERT_TRUE(skew) << skew.failure().reason;
  const std::vector<SlipInput> inputs = {
      SlipInput::angle, SlipInput::spin, SlipInput::turn, SlipInput::camber};
  for (const RollingState* state : {&free, &*skew}) {
    const auto response = of.about(*state);
    ASSERT_TRUE(response) << response.failure().reason;
    for (const Axle axle : {Axle::follows, Axle::held}) {
      const std::vector<SlipResponse> at_rest = response->at(0.0, inputs, axle);
      for (std::size_t k = 0; k < inputs.size(); ++k) {
        RollingCase base = state->of;
        base.drive.reset();
        if (axle == Axle::held) base.load.reset();
        const double step = kSlopeStep[k];
        const auto above = of.rolling.roll(*state, changed(base, inputs[k], step));
        const auto below = of.rolling.roll(*state, changed(base, inputs[k], -step));
        ASSERT_TRUE(above && below);
        const SlipResponse slope = difference(*above, *below, 2.0 * step);
        const double force = slope.force.norm(), moment = slope.moment.norm();
        EXPECT_LT((at_rest[k].force - slope.force).norm(), 1e-4 * force) << k;
        EXPECT_LT((at_rest[k].moment - slope.moment).norm(), 1e-4 * moment) << k;
      }
    }
  }
}

// Without inertia the response depends on the distance rolled alone, but for centrifugal forces; it
// falls and lags more and more, nearly as a slip that lags by the relaxation length.
TEST(RollingResponse, LagsByADistance) {
  RelaxingTireB of;
  const auto slow = of.about(of.free_wheel(5.0)), fast = of.about(of.free_wheel(10.0));
  ASSERT_TRUE(slow && fast);
  const auto length = [](const RollingResponse& response, double frequency, double speed) {
    return relaxation_length(response.by(SlipInput::angle, frequency).force.y(), frequency, speed);
  };
  const double sigma = length(*slow, 0.5, 5.0);
  EXPECT_NEAR(sigma / length(*fast, 1.0, 10.0), 1.0, 2e-2);
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
  const double cornering = -slow->by(SlipInput::angle, 0.0).force.y().real();
  EXPECT_NEAR(sigma / (cornering / lateral), 1.0, 0.1);
  for (const double frequency : {0.4, 0.8, 1.6}) {
    const std::complex<double> lag(1.0, 2.0 * std::numbers::pi * frequency * sigma / 5.0);
    const std::complex<double> Fy = slow->by(SlipInput::angle, frequency).force.y();
    EXPECT_LT(std::abs(Fy + cornering / lag), 0.01 * std::abs(cornering / lag)) << frequency;
  }
}

}  // namespace
}  // namespace latsch::fe_tire
