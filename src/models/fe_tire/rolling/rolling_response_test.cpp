// SPDX-License-Identifier: Apache-2.0
// Relaxation of the side force of tire B with few columns, beside differences of steady states.
#include "models/fe_tire/rolling/rolling_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/motion/spinning_tire.h"
#include "models/fe_tire/motion/tire_response.h"
#include "models/fe_tire/passage/rolling_transient.h"
#include "models/fe_tire/rolling/rolling_tire.h"
#include "models/fe_tire/rolling/rolling_vibration.h"

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
    return free_wheel(speed, rolling.start(pressed).forces.force.z(), 5.0);
  }
  /// With a friction of 5 hardly any point slides.
  RollingState free_wheel(double speed, double load, double friction) {
    const RollingState start = rolling.start(pressed);
    RollingCase of;
    of.speed = speed;
    of.spin = speed / 0.312;
    of.load = load;
    of.drive = 0.0;
    of.friction.at_rest = friction;
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

/// Amplitude of what follows e^(i omega t) in samples of one period.
std::complex<double> swing(const std::vector<double>& values) {
  std::complex<double> sum = 0.0;
  const double n = static_cast<double>(values.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    sum += values[k] * std::polar(2.0 / n, -2.0 * std::numbers::pi * static_cast<double>(k) / n);
  return sum;
}

/// Returns the side forces, N, of a wheel that rolls in time through slip angles.
std::vector<double> in_time(RelaxingTireB& of,
                            const RollingState& from,
                            const std::vector<double>& angles,
                            double step) {
  RollingTransient passage(of.tire);
  EXPECT_TRUE(passage.start(from, {.step = step, .rho = 0.0, .enough = 1e-7}));
  std::vector<double> side;
  for (const double angle : angles) {
    WheelMoment to{.of = from.of};
    to.of.slip_angle = angle;
    to.of.speed = from.of.speed / std::cos(angle);
    const auto now = passage.advance(to);
    EXPECT_TRUE(now) << now.failure().reason;
    side.push_back(now ? now->ground.force.y() : 0.0);
  }
  return side;
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

// Whatever the friction, steady states, rolling in time and the response have one slope, as long as
// no point changes between sticking and sliding. At 4 kN two points at the rear of the shoulders
// slide, each with mu times its pressure, so the slope falls with the friction.
TEST(RollingResponse, AgreesWithSteadyStatesAndWithTimeAtEveryFriction) {
  constexpr double kFrequency = 0.4, kSpeed = 5.0, kSwing = 1e-5, kTime = 5e-3;
  RelaxingTireB of;
  double steeper = 0.0;
  for (const double friction : {5.0, 2.0, 1.0}) {
    const RollingState free = of.free_wheel(kSpeed, 4000.0, friction);
    const auto response = of.about(free);
    ASSERT_TRUE(response) << response.failure().reason;
    const double slope = response->by(SlipInput::angle, 0.0, Axle::follows).force.y().real();
    EXPECT_LT(slope, steeper) << friction;
    steeper = slope;
    RollingCase base = free.of;
    base.drive.reset();
    const auto above = of.rolling.roll(free, changed(base, SlipInput::angle, kSwing));
    const auto below = of.rolling.roll(free, changed(base, SlipInput::angle, -kSwing));
    ASSERT_TRUE(above && below);
    EXPECT_NEAR(difference(*above, *below, 2.0 * kSwing).force.y().real() / slope, 1.0, 1e-3)
        << friction;
    const int period = static_cast<int>(std::lround(1.0 / (kFrequency * kTime)));
    const double phase = 2.0 * std::numbers::pi / period;
    std::vector<double> angles;
    for (int k = 1; k <= period + period / 2; ++k) angles.push_back(kSwing * std::sin(phase * k));
    std::vector<double> side = in_time(of, free, angles, kTime);
    side.erase(side.begin(), side.begin() + period / 2);
    // The samples begin one step after half a period, at -sin.
    const std::complex<double> found =
        swing(side) * std::polar(1.0 / kSwing, -phase) * std::complex<double>(0.0, -1.0);
    const auto expected = response->by(SlipInput::angle, kFrequency, Axle::follows).force.y();
    EXPECT_LT(std::abs(found / expected - 1.0), 4e-3) << friction;
  }
}

// A larger swing leaves the range of this slope, and rolling in time then follows the steady states
// and not the response: with a friction of 5 at 4 kN the force over 0.1 deg is 40 % larger than the
// slope says.
TEST(RollingResponse, HoldsForSwingsInWhichHardlyAnyPointChanges) {
  constexpr double kAngle = 2e-3, kSpeed = 5.0, kTime = 1e-2;
  RelaxingTireB of;
  const RollingState free = of.free_wheel(kSpeed, 4000.0, 5.0);
  RollingCase base = free.of;
  base.drive.reset();
  const auto steady = of.rolling.roll(free, changed(base, SlipInput::angle, kAngle));
  ASSERT_TRUE(steady) << steady.failure().reason;
  const double force = steady->forces.force.y();
  std::vector<double> angles;
  for (int k = 1; k <= 120; ++k) angles.push_back(kAngle * std::min(1.0, k / 20.0));
  EXPECT_NEAR(in_time(of, free, angles, kTime).back() / force, 1.0, 5e-3);
  const double slope = of.about(free)->by(SlipInput::angle, 0.0, Axle::follows).force.y().real();
  EXPECT_GT(force / (slope * kAngle), 1.3);
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

// At 0 Hz there is no inertia but that of steady rolling: forces are those of relaxation, and the
// hub has those of the ground.
TEST(RollingVibration, WithoutFrequencyIsTheSlopeOfSteadyForces) {
  RelaxingTireB of;
  const RollingState free = of.free_wheel(20.0);
  const auto vibration = RollingVibration::about(of.tire, free, {.highest = 40.0});
  ASSERT_TRUE(vibration) << vibration.failure().reason;
  const auto relaxation = RollingResponse::about(of.tire, free);
  ASSERT_TRUE(relaxation);
  const std::vector<VibrationInput> inputs = {
      {VibrationInput::Of::angle}, {VibrationInput::Of::spin}, {VibrationInput::Of::camber}};
  const auto slow = vibration->at(0.0, inputs);
  const auto slopes =
      relaxation->at(0.0, {SlipInput::angle, SlipInput::spin, SlipInput::camber}, Axle::held);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const double force = slopes[k].force.norm();
    EXPECT_LT((slow[k].patch.force - slopes[k].force).norm(), 1e-9 * force) << k;
    EXPECT_LT((slow[k].patch.moment - slopes[k].moment).norm(), 1e-9 * slopes[k].moment.norm());
    // The rest is the error of the sums by which G moves nothing.
    EXPECT_LT((slow[k].hub_force - slow[k].patch.force).norm(), 2e-3 * force) << k;
  }
}

// A fast wheel whose slip angle swings has the forces of rolling in time, (V.5), whose inertia is
// integrated step by step. Without inertia Fy would differ by 9 %. Of the 1.3 % that are left, the
// step of time takes 0.5 %, and another 0.3 % is the ground's velocity, which (F.5) takes at the
// end of the way between two points. Points hardly slide, and the swing is small, since the sliding
// rear edge of the patch changes with a larger one.
TEST(RollingVibration, IsRollingInTime) {
  constexpr double kFrequency = 4.0, kSwing = 1e-4, kStep = 1e-3, kSpeed = 30.0;
  RelaxingTireB of;
  const RollingState free = of.free_wheel(kSpeed);
  const auto vibration = RollingVibration::about(of.tire, free, {.highest = 40.0});
  ASSERT_TRUE(vibration) << vibration.failure().reason;
  const VibrationResponse expected =
      vibration->at(kFrequency, {{VibrationInput::Of::angle}}).front();
  const std::complex<double> without =
      RollingResponse::about(of.tire, free)->by(SlipInput::angle, kFrequency).force.y();
  RollingTransient passage(of.tire);
  ASSERT_TRUE(passage.start(free, {.step = kStep, .rho = 0.3, .enough = 1e-6}));
  const int period = static_cast<int>(std::lround(1.0 / (kFrequency * kStep)));
  std::vector<double> side, aligning, hub;
  const double omega = 2.0 * std::numbers::pi * kFrequency;
  for (int k = 1; k <= 3 * period; ++k) {
    const double phase = omega * kStep * k;
    WheelMoment to{.of = free.of};
    // The first period begins smoothly, so that the wheel does not ring.
    const double quarter = phase / 4.0;
    const double share = k < period ? std::pow(std::sin(quarter), 2) : 1.0;
    const double rate = k < period ? 0.25 * omega * std::sin(2.0 * quarter) : 0.0;
    to.of.slip_angle = kSwing * share * std::sin(phase);
    to.of.speed = kSpeed / std::cos(to.of.slip_angle);
    // The wheel's velocity to the side is V tan(alpha).
    to.acceleration.y() =
        kSpeed * kSwing * (rate * std::sin(phase) + share * omega * std::cos(phase));
    const auto now = passage.advance(to);
    ASSERT_TRUE(now) << now.failure().reason;
    if (k <= 2 * period) continue;
    side.push_back(now->ground.force.y());
    aligning.push_back(now->ground.moment.z());
    hub.push_back(now->force.y());
  }
  // The samples begin one step after two periods, at sin.
  const std::complex<double> turn =
      std::polar(1.0 / kSwing, -omega * kStep) * std::complex<double>(0.0, 1.0);
  const auto error = [&](const std::vector<double>& found, const std::complex<double>& value) {
    return std::abs(swing(found) * turn / value - 1.0);
  };
  EXPECT_GT(error(side, without), 0.08);
  EXPECT_LT(error(side, expected.patch.force.y()), 0.02);
  EXPECT_LT(error(aligning, expected.patch.moment.z()), 0.02);
  EXPECT_LT(error(hub, expected.hub_force.y()), 0.02);
}

/// A tire that spins off the ground.
RollingState off_the_ground(FeTire& tire, const Inflated& spinning) {
  const TireState over = tire.over(spinning, {}, FeTire::Poses::any);
  RollingState state;
  state.of.height = 2.0 * spinning.radius;
  state.of.spin = spinning.spin;
  state.of.speed = spinning.spin * spinning.radius;
  state.pressure = spinning.pressure;
  state.u = over.u;
  state.alpha = over.alpha;
  state.grip = GripState(0);
  return state;
}

// Off the ground a point that is hit answers most at the frequencies of the waves with and against
// the spin, which another eigenvalue problem in axes that spin along has found.
TEST(RollingVibration, OffTheGroundHasThePeaksOfWavesWithAndAgainstTheSpin) {
  constexpr double kSpin = 60.0;  // rad/s
  FeTire tire(RelaxingTireB::description());
  const Inflated at_rest = *tire.inflate(2.6e5);
  SpinningTire spinning(tire);
  const Inflated grown = *spinning.inflate(at_rest, kSpin);
  const auto modes = spinning.modes(grown, {}, 8);
  ASSERT_TRUE(modes);
  const Mesh& mesh = tire.mesh();
  int node = 0;  // the outermost node of the first plane
  for (int a = 0; a < mesh.nodes_per_sector(); ++a)
    if (mesh.X.col(a).norm() > mesh.X.col(node).norm()) node = a;
  const auto vibration = RollingVibration::about(
      tire,
      off_the_ground(tire, grown),
      {.highest = 100.0, .points = {{node, Eigen::Vector3d(0.2, 1.0, 1.0).normalized()}}});
  ASSERT_TRUE(vibration) << vibration.failure().reason;
  for (const SpinningMode& mode : *modes) {
    // The peaks of n = 2 are 0.7 and 0.9 % higher. The mass is another one here: the consistent.
    if (mode.n > 1) continue;
    // 1/receptance passes 0 at a natural frequency of a tire that nothing damps.
    const auto stiffness = [&](double f) {
      return 1.0 / vibration->at(f, {{VibrationInput::Of::point}}).front().points[0].real();
    };
    double low = 0.98 * mode.frequency, high = 1.02 * mode.frequency, nearest = 0.0;
    constexpr int kScan = 400;
    for (int k = 0; k < kScan; ++k) {
      const double f = low + (high - low) * k / kScan, next = f + (high - low) / kScan;
      const double a = stiffness(f), b = stiffness(next);
      if (a * b > 0.0 || std::abs(a - b) > 1e9) continue;
      const double root = f + (next - f) * a / (a - b);
      if (std::abs(root - mode.frequency) < std::abs(nearest - mode.frequency)) nearest = root;
    }
    EXPECT_NEAR(nearest / mode.frequency, 1.0, 5e-3) << mode.label();
  }
}

// A wheel that moves slowly takes the mass of the tire along.
TEST(RollingVibration, OffTheGroundTheHubCarriesTheMass) {
  FeTire tire(RelaxingTireB::description());
  const Inflated at_rest = *tire.inflate(2.6e5);
  const Inflated grown = *SpinningTire(tire).inflate(at_rest, 60.0);
  const auto vibration =
      RollingVibration::about(tire, off_the_ground(tire, grown), {.highest = 40.0});
  ASSERT_TRUE(vibration) << vibration.failure().reason;
  constexpr double kSlowly = 0.5;  // Hz
  const double omega = 2.0 * std::numbers::pi * kSlowly, mass = tire.total_mass();
  for (int axis = 0; axis < 3; ++axis) {
    const auto moved =
        vibration->at(kSlowly, {{.of = VibrationInput::Of::wheel, .axis = axis}}).front();
    EXPECT_NEAR(moved.hub_force[axis].real() / (omega * omega * mass), 1.0, 2e-3) << axis;
  }
}

}  // namespace
}  // namespace latsch::fe_tire
