// SPDX-License-Identifier: Apache-2.0
// Line contact against Carter's exact solution (longitudinal, and lateral: antiplane), the brush
// model, full sliding, and random slip states.
#include "models/fe_tire/grip/rolling_contact.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <vector>

#include "models/fe_tire/grip/line_contact_testing.h"

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

/// The law of docs/fe_tire_motion.md, written out: mu at pressure p, Pa, and sliding speed w, m/s.
double written_law(const RollingFriction& of, double p, double w) {
  const double at_rest = of.at_rest * std::pow(p / of.p_0, -of.a), top = of.peak * at_rest;
  if (!(w > 0.0)) return at_rest;
  const double log = std::log(w / of.peak_speed);
  return at_rest + (top - at_rest) * std::exp(-log * log / (of.width * of.width));
}

TEST(RollingContact, EveryPointHasTheFrictionOfItsPressureAndSpeed) {
  LineContact body(40);
  for (const double peak_speed : {0.03, 0.2, 1.0}) {
    const RollingFriction law{.at_rest = LineContact::kMu,
                              .p_0 = kPeak,
                              .a = 0.15,
                              .peak = 1.4,
                              .peak_speed = peak_speed,
                              .width = 1.5};
    const RollingGrip grip(body.lines(), law, 1e4 * LineContact::kEStar / kHalf);
    for (const double creep : {0.004, 0.01, 0.03}) {
      body.set_creep(creep, 0.3 * creep);
      const auto state = rolled(body, grip);
      ASSERT_TRUE(state.ok()) << peak_speed << " " << creep << ": " << state.failure().reason;
      int sliding = 0;
      for (int k = 0; k < grip.lines().points(); ++k) {
        const double p = state->input.p[k], t = state->tractions.t.col(k).norm();
        if (!(p > 0.0)) continue;
        const double w = state->tractions.w.col(k).norm();
        if (state->state.grip[k] == Grip::slides) {
          ++sliding;
          EXPECT_GT(w, 0.0);
          EXPECT_NEAR(t, written_law(law, p, w) * p, 1e-6 * t) << peak_speed << creep << k;
        } else {
          EXPECT_LE(t, (1.0 + 1e-6) * written_law(law, p, 0.0) * p);
        }
      }
      EXPECT_GT(sliding, 4) << peak_speed << " " << creep;
    }
  }
}

/// A rigid belt under a parabolic pressure along 2a = 0.1 m, which the ground passes at 20 m/s with
/// the slip sigma: a brush whose bristles are the penalty, Pa/m.
struct Brush {
  static constexpr int kPlaces = 4000;
  static constexpr double kHalfLength = 0.05, kSpeed = 20.0, kTop = 4e5;
  RollingGrip grip;
  RollingInput input;
  double step = 2.0 * kHalfLength / kPlaces;

  Brush(const RollingFriction& law, double stiffness, double sigma, bool is_even = false)
      : grip({{{0, kPlaces + 1}},
              Eigen::VectorXd::Constant(kPlaces + 1, 2.0 * kHalfLength / kPlaces / kSpeed)},
             law,
             stiffness),
        input{Eigen::Matrix2Xd::Zero(2, kPlaces + 1),
              Eigen::VectorXd::Zero(kPlaces + 1),
              Eigen::VectorXd::Constant(kPlaces + 1, 0.5),
              Eigen::Matrix2Xd::Zero(2, kPlaces + 1)} {
    for (int k = 0; k <= kPlaces; ++k) {
      const double x = kHalfLength + 0.5 * step - k * step, share = x / kHalfLength;
      input.x.col(k) << x, 0.0;
      input.V_g.col(k) << -kSpeed, -kSpeed * sigma;
      if (k > 0) input.p[k] = is_even ? kTop : kTop * (1.0 - share * share);
    }
  }
  /// Side force for each meter of width, N/m.
  double force() const {
    GripState state(kPlaces + 1);
    return -step * grip.explicit_tractions(input, state).t.row(1).sum();
  }
};

TEST(RollingContact, ABrushThatSlidesAsAWholeHasItsClosedFormAlongPeakAndFallingBranch) {
  // F = mu(w) p_0^(1-a') a sqrt(pi) Gamma(2-a')/Gamma(5/2-a') with the exponent a' of the pressure,
  // since the integral of (1 - x^2)^(1-a') over -1 to 1 is sqrt(pi) Gamma(2-a')/Gamma(5/2-a').
  const RollingFriction law{
      .at_rest = 0.9, .p_0 = 2e5, .a = 0.2, .peak = 1.5, .peak_speed = 2.0, .width = 1.2};
  const double by_shape = std::pow(Brush::kTop / law.p_0, -law.a) * Brush::kTop *
                          Brush::kHalfLength * std::sqrt(std::numbers::pi) *
                          std::tgamma(2.0 - law.a) / std::tgamma(2.5 - law.a);
  std::vector<double> forces;
  for (const double w : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    forces.push_back(Brush(law, 1e14, w / Brush::kSpeed).force());
    const double mu = written_law(law, law.p_0, w);
    EXPECT_NEAR(forces.back(), mu * by_shape, 1e-4 * mu * by_shape) << w;
  }
  EXPECT_NEAR(forces[2], 1.5 * 0.9 * by_shape, 1e-4 * forces[2]);  // the peak
  for (const int k : {0, 1, 3, 4}) EXPECT_LT(forces[k], forces[2]);
  EXPECT_NEAR(forces[1], forces[3], 1e-9 * forces[1]);  // the peak is even in log w
}

TEST(RollingContact, ABrushUnderEvenPressureSlidesFasterAndFasterAsTheQuadratureSays) {
  // Bristles come down with t = 0, stick until t = mu p at rest, then dt/ds = k (sigma - w/V) with
  // t = mu(w) p: s = int p mu'(w)/(k (sigma - w/V)) dw, as long as mu rises.
  const RollingFriction law{
      .at_rest = 0.8, .p_0 = Brush::kTop, .a = 0.0, .peak = 1.5, .peak_speed = 4.0, .width = 1.1};
  const double k = 1e9, sigma = 0.1, p = Brush::kTop, full = Brush::kSpeed * sigma;
  ASSERT_LT(full, law.peak_speed);
  const auto t = [&](double w) { return written_law(law, p, w) * p; };
  double s = t(0.0) / (k * sigma), force = 0.5 * t(0.0) * s;
  const double length = 2.0 * Brush::kHalfLength;
  // Steps in u, w = (1 - e^-u) V sigma, end at 1e-9 of the last speed.
  constexpr int kSteps = 200000;
  double before = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    const double u = 21.0 * (i - 0.5) / kSteps, w = -std::expm1(-21.0 * i / kSteps) * full;
    const double ds = (t(w) - t(before)) / (k * sigma * std::exp(-u));
    force += 0.5 * (t(w) + t(before)) * ds;
    s += ds;
    before = w;
  }
  ASSERT_LT(s, length);
  force += t(full) * (length - s);
  const double found = Brush(law, k, sigma, true).force();
  EXPECT_NEAR(found, force, 1e-3 * force);
  EXPECT_GT(std::abs(t(full) * (length - s) / force - 1.0), 0.05);  // the way there counts
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
