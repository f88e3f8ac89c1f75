// SPDX-License-Identifier: Apache-2.0
// Tests properties that the Magic Formula has for every tire. Agreement with another program is
// tested in verification/magic_formula.
#include "models/magic_formula/magic_formula.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "base/random.h"
#include "models/magic_formula/round_tire_testing.h"
#include "numerics/kernels/kernel_set.h"

namespace latsch::magic_formula {
namespace {

State random_state(std::uint64_t i) {
  RandomStream random(3, i);
  const auto within = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  return {within(-200, 9000),
          within(-1, 1),
          within(-0.5, 0.5),
          within(-0.2, 0.2),
          within(-0.2, 0.2),
          within(-30, 30),
          within(1.5e5, 3e5)};
}

TEST(MagicFormula, StiffnessesAreTheSlopesAtZeroSlip) {
  const MagicFormula tire(round_tire());
  const State still{4000.0, 0.0, 0.0, 0.0, 0.0, 20.0, 2.2e5};
  const SteadyState s = tire.evaluate(still);
  constexpr double kSmall = 1e-6;
  State slip = still;
  slip.kappa = kSmall;
  EXPECT_NEAR((tire.evaluate(slip).Fx - s.Fx) / kSmall, s.Kxk, 1e-4 * s.Kxk);
  slip = still;
  slip.alpha = kSmall;
  EXPECT_NEAR((tire.evaluate(slip).Fy - s.Fy) / kSmall, s.Kya, 1e-4 * std::abs(s.Kya));
  EXPECT_DOUBLE_EQ(s.Kxk, 25.0 * 4000.0);                                       // (4.E15)
  EXPECT_NEAR(s.Kya, -20.0 * 4000.0 * std::sin(2 * std::atan(1 / 1.5)), 1e-9);  // (4.E25)
  EXPECT_NEAR(s.sigma_y, std::abs(s.Kya) / 1.5e5, 1e-15);                       // (19)
}

TEST(MagicFormula, WithoutLimitsALoadBelowTheRangeIsUsedAsItIs) {
  Parameters p = round_tire();
  Conventions off;
  off.limits = false;
  for (const Version version : {Version::mf61, Version::mf62}) {
    p.version = version;
    p.FZMIN = 0.0;
    const MagicFormula without(p, off);
    p.FZMIN = 500.0;
    const MagicFormula tire(p, off), limited(p);
    const State light{50.0, 0.02, 0.03, 0.05, 0.0, 20.0, 2.2e5};
    const SteadyState s = tire.evaluate(light), expected = without.evaluate(light);
    EXPECT_EQ(std::memcmp(&s, &expected, sizeof s), 0);
    if (version == Version::mf61) EXPECT_LT(s.rho, 0.2 * limited.evaluate(light).rho);
    EXPECT_NEAR(tire.evaluate({0.0, 0.0, 0.0, 0.0, 0.0, 20.0, 2.2e5}).rho, 0.0, 1e-11);
  }
}

/// The stiffness against spin is that of the camber force over 1 - epsilon_gamma (4.89), and so is
/// that of the residual torque (4.98): the spin of a small camber gives force and torque of the
/// camber without turn slip.
TEST(MagicFormula, TheSpinOfCamberGivesItsForceAndTorqueWithTheSignOfTheBook) {
  Parameters p = round_tire();
  p.PVY3 = 0.0;
  struct Slopes {
    double Fy, Mzr;
  };
  const auto by_camber = [&](bool turn_slip, bool of_book) -> Slopes {
    Conventions conventions;
    conventions.turn_slip = turn_slip;
    conventions.spin_of_book = of_book;
    constexpr double kSmall = 1e-4;
    const MagicFormula tire(p, conventions);
    const State leaning{4000.0, 0.0, 0.0, kSmall, 0.0, 20.0, 2.2e5};
    State upright = leaning;
    upright.gamma = 0.0;
    const SteadyState a = tire.evaluate(leaning), b = tire.evaluate(upright);
    return {(a.Fy - b.Fy) / kSmall, (a.Mzr - b.Mzr) / kSmall};
  };
  const Slopes without = by_camber(false, false), book = by_camber(true, true);
  EXPECT_LT(without.Fy, -1000.0);  // N/rad, toward the side to which the tire leans
  EXPECT_LT(without.Mzr, -50.0);   // N m/rad
  // The spin is omega sin(gamma)/V, and omega is V/Re, a little more than V/R0.
  EXPECT_NEAR(book.Fy / without.Fy, 1.0, 0.05);
  EXPECT_NEAR(book.Mzr / without.Mzr, 1.0, 0.05);
  EXPECT_NEAR(by_camber(true, false).Fy / without.Fy, -1.0, 0.05);
}

/// A tire that leans into its turn rolls like a cone: at sin(gamma)(1 - epsilon) omega = -V phit, a
/// right turn having phit above 0, it has the side force of an upright tire on a straight path.
TEST(MagicFormula, ATireThatLeansIntoItsTurnHasNoSpinWithTheSignOfTheBook) {
  Parameters p = round_tire();
  p.PVY3 = 0.0;
  Conventions conventions;
  conventions.turn_slip = conventions.spin_of_book = true;
  const MagicFormula tire(p, conventions);
  State cone{4000.0, 0.0, 0.0, 0.1, 0.0, 20.0, 2.2e5}, flat = cone;
  flat.gamma = 0.0;
  const SteadyState straight = tire.evaluate(flat);
  cone.phit = std::sin(cone.gamma) * straight.omega / cone.Vx;  // round_tire has epsilon 0.5
  cone.phit *= 1.0 - p.PECP1;
  flat.phit = cone.phit;
  EXPECT_GT(std::abs(tire.evaluate(flat).Fy - straight.Fy), 100.0);
  EXPECT_NEAR(tire.evaluate(cone).Fy, straight.Fy, 2.0);
}

/// MF 5.2 has gamma_z = LGAZ gamma in every term of the pure aligning moment [Adams/Tire, PAC2002,
/// aligning moment]: a tire with LGAZ has the moment of one without it whose coefficients of gamma
/// are multiplied instead.
TEST(MagicFormula, TheInclinationOfTheAligningMomentIsScaledInEveryTerm) {
  constexpr double kScale = 0.7;
  Parameters scaled = round_tire();
  scaled.version = Version::mf52;
  scaled.QHZ3 = 0.3, scaled.QHZ4 = 0.1, scaled.QEZ4 = 0.2, scaled.QEZ5 = -1.5;
  scaled.QBZ4 = 0.4, scaled.QBZ5 = -0.3, scaled.QDZ3 = 0.5, scaled.QDZ4 = -2.0;
  scaled.QDZ8 = -0.4, scaled.QDZ9 = 0.1, scaled.SSZ3 = 0.2, scaled.SSZ4 = 0.1;
  Parameters plain = scaled;
  scaled.LGAZ = kScale;
  for (double* linear : {&plain.QHZ3,
                         &plain.QHZ4,
                         &plain.QEZ5,
                         &plain.QBZ4,
                         &plain.QBZ5,
                         &plain.QDZ3,
                         &plain.QDZ8,
                         &plain.QDZ9})
    *linear *= kScale;
  plain.QDZ4 *= kScale * kScale, plain.QDZ10 *= kScale * kScale;
  const MagicFormula tire(scaled), other(plain);
  double effect = 0.0;
  for (int i = 0; i < 200; ++i) {
    State state = random_state(i);
    const double Mz = tire.evaluate(state).Mz;
    EXPECT_NEAR(Mz, other.evaluate(state).Mz, 1e-9 * (1.0 + std::abs(Mz)));
    state.gamma = 0.0;
    effect = std::max(effect, std::abs(Mz - tire.evaluate(state).Mz));
  }
  EXPECT_GT(effect, 10.0);  // N m
}

TEST(MagicFormula, ThePeakIsFrictionTimesLoad) {
  const MagicFormula tire(round_tire());
  double largest = 0.0;
  for (int i = 0; i < 4000; ++i)
    largest = std::max(largest, tire.evaluate({4000.0, i * 5e-5, 0.0, 0.0, 0.0, 20.0, 2.2e5}).Fx);
  EXPECT_NEAR(largest, 1.2 * 4000.0, 1e-3);  // the sine reaches 1 because C > 1
}

TEST(MagicFormula, TheDeflectionCarriesTheLoad) {
  for (const Version version : {Version::mf61, Version::mf62}) {
    Parameters p = round_tire();
    p.version = version;
    p.Q_FZ2 = 3.0;
    p.Q_FCX = 0.1;
    p.Q_FCY = 0.3;
    p.Q_FCY2 = version == Version::mf62 ? 0.2 : 0.0;
    p.Q_V2 = 0.03;
    p.PFZ1 = 0.7;
    const MagicFormula tire(p);
    const SteadyState s = tire.evaluate({5000.0, 0.05, 0.03, 0.0, 0.0, 25.0, 2.5e5});
    EXPECT_NEAR(tire.vertical_force(s.rho, s.omega, 0.0, 2.5e5, s.Fx, s.Fy), 5000.0, 1e-6);
  }
}

TEST(MagicFormula, ASymmetricTireIsItsMirrorImage) {
  for (const bool turn_slip : {false, true}) {
    Conventions here, there;
    here.turn_slip = there.turn_slip = turn_slip;
    there.mirrored = true;
    Parameters p = round_tire();
    p.QDZ10 = 0.3;
    const MagicFormula tire(p, here), mirror(p, there);
    for (int i = 0; i < 200; ++i) {
      const State s = random_state(i);
      const SteadyState a = tire.evaluate(s), b = mirror.evaluate(s);
      EXPECT_NEAR(a.Fx, b.Fx, 1e-8);
      EXPECT_NEAR(a.Fy, b.Fy, 1e-8);
      EXPECT_NEAR(a.Mx, b.Mx, 1e-8);
      EXPECT_NEAR(a.My, b.My, 1e-8);
      EXPECT_NEAR(a.Mz, b.Mz, 1e-8);
    }
  }
}

TEST(MagicFormula, FiniteWhereverAWheelCanBe) {
  for (const bool limits : {false, true}) {
    for (const bool turn_slip : {false, true}) {
      Conventions c;
      c.limits = limits;
      c.turn_slip = turn_slip;
      const MagicFormula tire(round_tire(), c);
      for (int i = 0; i < 64; ++i) {
        const State s{i & 1 ? 0.0 : 4000.0,
                      i & 2 ? -1.0 : 0.0,
                      i & 4 ? 0.1 : 0.0,
                      i & 8 ? 0.05 : 0.0,
                      i & 16 ? 0.1 : 0.0,
                      i & 32 ? 0.0 : 10.0,
                      2.2e5};
        const SteadyState f = tire.evaluate(s);
        for (const double v : {f.Fx, f.Fy, f.Mx, f.My, f.Mz, f.R_e, f.R_l, f.a, f.b, f.t, f.Cz})
          EXPECT_TRUE(std::isfinite(v)) << i << " " << limits << turn_slip;
      }
    }
  }
}

struct Columns {
  explicit Columns(std::size_t count) : Fx(count), Fy(count), Mx(count), My(count), Mz(count) {}
  std::vector<double> Fx, Fy, Mx, My, Mz;
};

Columns forces(const MagicFormula& tire, const std::vector<State>& states) {
  const auto column = [&](double State::*member) {
    std::vector<double> values;
    for (const State& s : states) values.push_back(s.*member);
    return values;
  };
  const auto Fz = column(&State::Fz), kappa = column(&State::kappa), alpha = column(&State::alpha),
             gamma = column(&State::gamma), phit = column(&State::phit), Vx = column(&State::Vx),
             p = column(&State::p);
  Columns f(states.size());
  tire.forces({Fz, kappa, alpha, gamma, phit, Vx, p}, {f.Fx, f.Fy, f.Mx, f.My, f.Mz});
  return f;
}

MagicFormula tire_of(Version version, Angles angles) {
  Conventions c;
  c.angles = angles;
  c.turn_slip = true;
  Parameters p = round_tire();
  p.version = version;
  return MagicFormula(p, c);
}

constexpr Version kVersions[] = {Version::mf52, Version::mf61, Version::mf62};

class OfKernelSet : public testing::TestWithParam<KernelSet> {
 protected:
  WithKernelSet with_{GetParam()};
};

TEST_P(OfKernelSet, ManyStatesAtOnceGiveTheBitsThatEachGivesAlone) {
  for (const Version version : kVersions)
    for (const Angles angles : {Angles::direct, Angles::tangent}) {
      const MagicFormula tire = tire_of(version, angles);
      std::vector<State> states;
      for (int i = 0; i < 1003; ++i) states.push_back(random_state(i));
      std::vector<SteadyState> results(states.size());
      tire.evaluate(states, results);
      const Columns f = forces(tire, states);
      for (std::size_t i = 0; i < states.size(); ++i) {
        const SteadyState alone = tire.evaluate(states[i]);
        EXPECT_EQ(std::memcmp(&results[i], &alone, sizeof alone), 0) << i;
        EXPECT_EQ(f.Fx[i], alone.Fx);
        EXPECT_EQ(f.Fy[i], alone.Fy);
        EXPECT_EQ(f.Mx[i], alone.Mx);
        EXPECT_EQ(f.My[i], alone.My);
        EXPECT_EQ(f.Mz[i], alone.Mz);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(MagicFormula,
                         OfKernelSet,
                         testing::ValuesIn(kernel_sets()),
                         [](const auto& info) { return std::string(name(info.param)); });

// Kernel sets with a fused multiply-add must give identical bits. The baseline set has none, so its
// results may differ by the rounding of some hundred successive operations.
TEST(MagicFormula, EveryKernelSetGivesTheSameForces) {
  for (const Version version : kVersions) {
    const MagicFormula tire = tire_of(version, Angles::direct);
    for (int i = 0; i < 500; ++i) {
      const State state = random_state(i);
      const auto by = [&](KernelSet set) {
        const WithKernelSet with(set);
        return tire.evaluate(state);
      };
      const SteadyState best = by(kernel_sets().back()), baseline = by(KernelSet::baseline);
      const auto near = [](double a, double b) { EXPECT_NEAR(a, b, 1e-11 * (1e3 + std::abs(b))); };
      near(best.Fx, baseline.Fx);
      near(best.Fy, baseline.Fy);
      near(best.Mx, baseline.Mx);
      near(best.My, baseline.My);
      near(best.Mz, baseline.Mz);
      for (const KernelSet set : kernel_sets()) {
        if (set == KernelSet::baseline) continue;
        const SteadyState here = by(set);
        EXPECT_EQ(std::memcmp(&here, &best, sizeof best), 0) << name(set);
      }
    }
  }
}

}  // namespace
}  // namespace latsch::magic_formula
