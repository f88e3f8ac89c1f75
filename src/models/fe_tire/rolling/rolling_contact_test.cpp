// SPDX-License-Identifier: Apache-2.0
// Line contact against Carter's exact solution (longitudinal, and lateral: antiplane), the brush
// model, full sliding, and random slip states.
#include "models/fe_tire/rolling/rolling_contact.h"

#include <gtest/gtest.h>

#include <random>

#include "models/fe_tire/rolling/line_contact_testing.h"

namespace latsch::fe_tire {
namespace {

const double kHalf = LineContact::half_width(), kPeak = LineContact::peak();
constexpr double kFull = LineContact::kMu * LineContact::kP;

RollingGrip grip_of(const LineContact& body, double per_length = 1e4) {
  return {body.lines(), {.at_rest = LineContact::kMu}, per_length * LineContact::kEStar / kHalf};
}

Result<RollingContactState> rolled(LineContact& body, const RollingGrip& grip) {
  return roll(body, grip, body.rest(), GripState(grip.lines().points()));
}

/// xi/(mu a/R) at Q/(mu P).
double carter_creep(double share) {
  return LineContact::kMu * kHalf / LineContact::kR * (1.0 - std::sqrt(1.0 - share));
}

TEST(RollingContact, CartersLoadAndPressureAreThoseOfThePage) {
  EXPECT_NEAR(kHalf, 9.77205e-3, 1e-8);
  EXPECT_NEAR(kPeak, 130.294e3, 1.0);
  EXPECT_NEAR(carter_creep(1.0), 0.016287, 1e-6);
  EXPECT_NEAR(carter_creep(0.25), 0.00218201, 1e-8);
}

TEST(RollingContact, CreepGivesCartersForceAndStickBorder) {
  LineContact body(40);
  const RollingGrip grip = grip_of(body);
  for (const bool lateral : {false, true}) {
    for (const double share : {0.25, 0.5, 0.75}) {
      const double creep = carter_creep(share) * (lateral ? 2.0 : 1.0);
      body.set_creep(lateral ? 0.0 : creep, lateral ? creep : 0.0);
      const auto state = rolled(body, grip);
      ASSERT_TRUE(state.ok()) << state.failure().reason;
      const Eigen::Vector2d Q = body.force(state->tractions);
      EXPECT_NEAR(-Q[lateral ? 1 : 0], share * kFull, 0.02 * share * kFull) << lateral << share;
      EXPECT_NEAR(Q[lateral ? 0 : 1], 0.0, 1e-6 * kFull);
      // Stick next to the leading edge over 2c, c = a sqrt(1 - Q/mu P).
      int sticking = 0;
      for (const Grip at : state->state.grip) sticking += at == Grip::sticks ? 1 : 0;
      const double border = kHalf - sticking * body.width();
      EXPECT_NEAR(border, kHalf * (1.0 - 2.0 * std::sqrt(1.0 - share)), body.width());
      EXPECT_LE(state->passes, 9);
    }
  }
}

TEST(RollingContact, TractionsAreCarters) {
  LineContact body(80);
  const RollingGrip grip = grip_of(body);
  for (const double share : {0.25, 0.5, 0.75}) {
    body.set_creep(carter_creep(share), 0.0);
    const auto state = rolled(body, grip);
    ASSERT_TRUE(state.ok());
    const double c = kHalf * std::sqrt(1.0 - share), d = kHalf - c;
    for (int k = 1; k <= 80; ++k) {
      const double x = body.places()[k], at = (x - d) / c;
      const double exact = std::sqrt(1.0 - std::pow(x / kHalf, 2)) -
                           (std::abs(at) < 1.0 ? c / kHalf * std::sqrt(1.0 - at * at) : 0.0);
      EXPECT_NEAR(-state->tractions.t(0, k) / (LineContact::kMu * kPeak), exact, 0.03) << x / kHalf;
    }
  }
}

TEST(RollingContact, ForceConvergesWithTheNumberOfPlaces) {
  double before = 0.0;
  for (const int count : {20, 40, 80}) {
    LineContact body(count);
    body.set_creep(carter_creep(0.5), 0.0);
    const auto state = rolled(body, grip_of(body, 1e5));
    ASSERT_TRUE(state.ok());
    const double error = std::abs(-body.force(state->tractions).x() / (0.5 * kFull) - 1.0);
    if (before > 0.0) {
      EXPECT_LT(error, 0.65 * before);
    }
    before = error;
  }
  EXPECT_LT(before, 0.005);
}

TEST(RollingContact, PenaltyIsASpringInSeries) {
  // Initial stiffness 2 P R/a against stick that is exact, with the penalties of the page.
  LineContact body(40);
  const auto stiffness = [&](double per_length) {
    body.set_creep(1e-6, 0.0);
    const auto state = rolled(body, grip_of(body, per_length));
    EXPECT_TRUE(state.ok()) << state.failure().reason;
    return -body.force(state->tractions).x() / 1e-6;
  };
  const double exact = stiffness(1e6);
  EXPECT_NEAR(exact, 122.80e3, 0.02 * 122.80e3);
  EXPECT_NEAR(stiffness(10.0) / exact, 1.0 - 0.088, 0.01);
  EXPECT_NEAR(stiffness(100.0) / exact, 1.0 - 0.012, 0.002);
  EXPECT_NEAR(stiffness(1000.0) / exact, 1.0 - 0.0013, 0.0003);
}

TEST(RollingContact, FoundStatesObeyTheLawPointByPoint) {
  // (F.1), evaluated from the leading edge on the positions found, gives the same tractions.
  LineContact body(40);
  const RollingGrip grip = grip_of(body, 300.0);
  for (const double spin : {0.0, 0.01}) {
    body.set_creep(0.003, 0.004, spin);
    const auto state = rolled(body, grip);
    ASSERT_TRUE(state.ok()) << state.failure().reason;
    GripState again = state->state;
    const GripTractions law = grip.explicit_tractions(state->input, again);
    EXPECT_LT((law.t - state->tractions.t).cwiseAbs().maxCoeff(), 1e-6 * kPeak);
    for (int k = 0; k < 41; ++k) {
      if (state->state.grip[k] != Grip::slides) continue;
      // The point slides against its traction.
      const Eigen::Vector2d w = state->tractions.w.col(k), t = state->tractions.t.col(k);
      EXPECT_NEAR(w.dot(t), -w.norm() * t.norm(), 1e-6 * w.norm() * t.norm() + 1e-12);
    }
  }
}

TEST(RollingContact, APointThatComesDownSticksOrSlidesAsTheLawSays) {
  // Four points of one line, of which the third and the fourth have no state yet.
  const double stiffness = 1e9, time = 1e-4;
  const RollingGrip grip(
      {{{0, 4}}, Eigen::VectorXd::Constant(4, time)}, {.at_rest = 0.5}, stiffness);
  RollingInput input{Eigen::Matrix2Xd::Zero(2, 4),
                     Eigen::VectorXd::Constant(4, 2e5),
                     Eigen::VectorXd::Ones(4),
                     Eigen::Matrix2Xd::Zero(2, 4)};
  for (const double creep : {0.1, 0.9, 3.0}) {  // relative to that of mu p at the fourth point
    input.V_g.row(1).setConstant(creep * 1e5 / (3.0 * stiffness * time));
    GripState state(4);
    state.grip[2] = state.grip[3] = Grip::none;
    grip.admit(input, state);
    GripState law(4);
    grip.explicit_tractions(input, law);
    EXPECT_EQ(state.grip[2], law.grip[2]) << creep;
    EXPECT_EQ(state.grip[3], law.grip[3]) << creep;
    if (law.grip[3] == Grip::slides) {
      EXPECT_LT((state.direction.col(3) - Eigen::Vector2d(0.0, 1.0)).norm(), 1e-12);
    }
  }
  input.p[2] = 0.0;
  GripState state(4);
  grip.admit(input, state);
  EXPECT_EQ(state.grip[2], Grip::none);
}

TEST(RollingContact, EverythingSlidesAtLargeSlip) {
  // Along or across; in other directions the body, twice as soft across, turns the velocities of
  // its points a little, unless they slide much faster than it deforms, as under a locked wheel.
  LineContact body(40);
  const RollingGrip grip = grip_of(body);
  const std::vector<Eigen::Vector2d> creeps{
      {0.1, 0.0}, {0.0, -1.0}, {-3e3, 4e3}, {1e4, 1e2}, {0.3, 0.4}};
  for (const Eigen::Vector2d& creep : creeps) {
    body.set_creep(creep.x(), creep.y());
    const auto state = rolled(body, grip);
    ASSERT_TRUE(state.ok());
    const Eigen::Vector2d Q = body.force(state->tractions);
    const double tolerance = creep.norm() == 0.5 ? 1e-4 : 1e-6;
    EXPECT_NEAR(Q.norm(), kFull, tolerance * kFull) << creep.transpose();
    EXPECT_LT((Q.normalized() + creep.normalized()).norm(), 0.01) << creep.transpose();
  }
}

TEST(RollingContact, BrushModelHasItsClosedForm) {
  // A rigid belt and the penalty alone under a parabolic pressure: F/(mu Fz) = 3 s - 3 s^2 + s^3,
  // trail/a = (1 - s)^3/(3 - 3 s + s^2), where s is the slip over that of full sliding.
  const int m = 2000;
  const double a = 0.05, h = 2.0 * a / m, stiffness = 1e9, mu = 0.8, speed = 20.0, p_0 = 4e5;
  RollingLines lines{{{0, m + 1}}, Eigen::VectorXd::Constant(m + 1, h / speed)};
  const RollingGrip grip(lines, {.at_rest = mu}, stiffness);
  struct Row {
    double s, F, trail;
  };
  for (const Row& row :
       {Row{0.2, 0.488, 0.20984}, Row{0.4, 0.784, 0.11020}, Row{0.6, 0.936, 0.04103}}) {
    // Full sliding begins at s = 1: the traction's slope at the leading edge is that of mu p.
    const double sigma = row.s * mu * 2.0 * p_0 / (a * stiffness);
    RollingInput input{Eigen::Matrix2Xd::Zero(2, m + 1),
                       Eigen::VectorXd::Zero(m + 1),
                       Eigen::VectorXd::Constant(m + 1, 0.5),
                       Eigen::Matrix2Xd::Zero(2, m + 1)};
    double load = 0.0, force = 0.0, moment = 0.0;
    for (int k = 0; k <= m; ++k) {
      const double x = a + 0.5 * h - k * h;
      input.x.col(k) << x, 0.0;
      input.V_g.col(k) << -speed, -speed * sigma;
      if (k > 0) input.p[k] = p_0 * (1.0 - x * x / (a * a));
      load += h * input.p[k];
    }
    GripState state(m + 1);
    const GripTractions found = grip.explicit_tractions(input, state);
    for (int k = 0; k <= m; ++k) {
      force -= h * found.t(1, k);
      moment += h * found.t(1, k) * input.x(0, k);
    }
    EXPECT_NEAR(force / (mu * load), row.F, 0.002 * row.F);
    EXPECT_NEAR(moment / force / a, row.trail, 0.002);
  }
}

TEST(RollingContact, FrictionDependsOnPressureAndSpeedAsStated) {
  const RollingFriction friction{
      .at_rest = 1.0, .p_0 = 2e5, .a = 0.2, .peak = 1.5, .peak_speed = 2.0, .width = 1.3};
  EXPECT_NEAR(friction.at(2e5, 0.0), 1.0, 1e-14);
  EXPECT_NEAR(friction.at(2e5, 2.0), 1.5, 1e-14);
  EXPECT_NEAR(friction.at(4e5, 0.0), std::pow(2.0, -0.2), 1e-14);
  const double step = 1.0;
  const auto limit = [&](double p) { return p * friction.at(p, 0.7); };
  EXPECT_NEAR(
      (limit(3e5 + step) - limit(3e5 - step)) / (2.0 * step), friction.limit_slope(3e5, 0.7), 1e-8);
}

TEST(RollingContact, RandomSlipStatesEachEndInAStateOrInWords) {
  LineContact body(20);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int failed = 0;
  const int count = 1500;
  for (int trial = 0; trial < count; ++trial) {
    // Near and beyond the limit of grip: up to some three times the creep of full sliding.
    const double size = 0.05 * std::pow(10.0, -1.5 * std::abs(uniform(random)));
    body.set_creep(size * uniform(random), size * uniform(random), size * uniform(random));
    const auto state = rolled(body, grip_of(body, std::pow(10.0, 3.0 + 2.0 * uniform(random))));
    if (!state.ok()) {
      ++failed;
      EXPECT_NE(state.failure().reason.find("residual"), std::string::npos);
      continue;
    }
    for (int k = 0; k < 21; ++k)
      EXPECT_LE(state->tractions.t.col(k).norm(), (1.0 + 1e-6) * state->tractions.limit[k]);
  }
  EXPECT_LE(failed, count / 100);
}

}  // namespace
}  // namespace latsch::fe_tire
