// SPDX-License-Identifier: Apache-2.0
// Damped modes of tire B with few columns. The references do not depend on the tested sums over
// points: modes of tires with other moduli, and a halved ring compared with a whole ring.
#include "models/fe_tire/motion/damped_tire.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/fe_tire/description/reference_tires.h"

namespace latsch::fe_tire {
namespace {

constexpr double kDampedPressure = 2.6e5;  // Pa

TireDescription relaxing_tire(const PronyTerms& of_rubber, const PronyTerms& of_cords = {}) {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.cord_model = CordModel::rebar;
  tire.section.meridional = 13;
  tire.section.sectors = 40;
  tire.section.sector_zones.clear();
  for (Rubber& rubber : tire.rubbers) rubber.prony = of_rubber;
  for (CordPly& ply : tire.plies) ply.prony = of_cords;
  return tire;
}

Materials with_shear(Materials materials, double factor) {
  for (Solid& solid : materials.solids)
    if (auto* rubber = std::get_if<Hyperelastic>(&solid.law)) {
      rubber->C10 *= factor;
      rubber->C01 *= factor;
    }
  return materials;
}

Materials with_cords(Materials materials, double factor) {
  for (CordLayer& layer : materials.layers) {
    layer.E_tension *= factor;
    layer.E_compression *= factor;
    layer.pretension *= factor;
  }
  return materials;
}

double squared(const Mode& mode) { return std::pow(2.0 * std::numbers::pi * mode.frequency, 2); }

// Without pressure nothing is stressed, so d(omega^2)/d(ln G) of a mode is phi^T K_iso phi.
TEST(DampedTire, StiffnessOfRubberAndCordsIsTheSlopeOfTheModes) {
  const TireDescription tire = relaxing_tire({{0.2, 1e-3}}, {{0.1, 1e-3}});
  const LossMaterials losses = build_losses(tire);
  FeTire fe(tire);
  const Materials as_is = fe.materials();
  const Inflated flat = *fe.inflate(0.0);
  constexpr int kCount = 6;
  const std::vector<Mode> modes = *fe.modes(flat, kCount);
  const auto projected = DampedTire(fe, losses).project(as_is, flat, modes);
  ASSERT_TRUE(projected) << projected.failure().reason;
  for (int i = 0; i < kCount; ++i)
    EXPECT_NEAR(projected->elements(i, i) / squared(modes[i]), 1.0, 1e-4) << i;
  Eigen::VectorXd rubber = Eigen::VectorXd::Zero(kCount), cords = rubber;
  for (const RelaxingStiffness& part : projected->parts)
    (part.terms.front().beta == 0.2 ? rubber : cords) += part.K.diagonal();
  constexpr double kChange = 1e-3;
  const auto slopes = [&](const auto& changed) {
    fe.set(changed(as_is, 1.0 + kChange));
    const std::vector<Mode> more = *fe.modes(*fe.inflate(0.0), kCount);
    fe.set(changed(as_is, 1.0 - kChange));
    const std::vector<Mode> less = *fe.modes(*fe.inflate(0.0), kCount);
    Eigen::VectorXd slope(kCount);
    for (int i = 0; i < kCount; ++i)
      slope[i] = (squared(more[i]) - squared(less[i])) / (2.0 * kChange);
    return slope;
  };
  const Eigen::VectorXd of_rubber = slopes(with_shear), of_cords = slopes(with_cords);
  for (int i = 0; i < kCount; ++i) {
    EXPECT_NEAR(rubber[i], of_rubber[i], 1e-4 * squared(modes[i])) << i;
    EXPECT_NEAR(cords[i], of_cords[i], 1e-4 * squared(modes[i])) << i;
  }
}

// Terms far slower than the vibration leave the unrelaxed moduli, without loss; far faster ones the
// relaxed moduli.
TEST(DampedTire, SlowTermsStiffenAndFastOnesDoNothing) {
  constexpr double kShare = 0.3;
  constexpr int kCount = 8;
  const TireDescription slow = relaxing_tire({{kShare, 1e4}});
  FeTire fe(slow);
  const LossMaterials slow_losses = build_losses(slow),
                      fast_losses = build_losses(relaxing_tire({{kShare, 1e-9}}));
  const Inflated flat = *fe.inflate(0.0);
  const auto stiff = DampedTire(fe, slow_losses).modes(flat, kCount);
  const auto soft = DampedTire(fe, fast_losses).modes(flat, kCount);
  ASSERT_TRUE(stiff && soft);
  const std::vector<Mode> relaxed = *fe.modes(flat, kCount);
  fe.set(with_shear(fe.materials(), 1.0 + kShare));
  const std::vector<Mode> unrelaxed = *fe.modes(*fe.inflate(0.0), kCount);
  for (int i = 0; i < kCount; ++i) {
    EXPECT_NEAR((*stiff)[i].mode.frequency / unrelaxed[i].frequency, 1.0, 2e-3) << i;
    EXPECT_GT((*stiff)[i].mode.frequency / relaxed[i].frequency, 1.01) << i;
    EXPECT_LT((*stiff)[i].damping, 1e-5) << i;
    EXPECT_NEAR((*soft)[i].mode.frequency / relaxed[i].frequency, 1.0, 1e-6) << i;
  }
}

// A tire that stands: half of the ring represents all of it, or the whole is computed.
TEST(DampedTire, HalfOfAStandingTireRepresentsAllOfIt) {
  constexpr int kCount = 6;
  const TireDescription tire = relaxing_tire(*constant_loss_factor(0.15, 1.0, 1000.0));
  const LossMaterials losses = build_losses(tire);
  FeTire fe(tire);
  const Inflated inflated = *fe.inflate(kDampedPressure);
  std::vector<std::vector<DecayingMode>> found;
  for (const auto poses : {FeTire::Poses::below, FeTire::Poses::any}) {
    const auto state = fe.advance(fe.over(inflated, {}, poses), {FeTire::below(inflated, 0.01)});
    ASSERT_TRUE(state) << state.failure().reason;
    EXPECT_EQ(state->back().is_halved, poses == FeTire::Poses::below);
    const auto modes = DampedTire(fe, losses).modes(state->back(), kCount);
    ASSERT_TRUE(modes) << modes.failure().reason;
    found.push_back(*modes);
  }
  for (int i = 0; i < kCount; ++i) {
    const DecayingMode &half = found[0][i], &whole = found[1][i];
    EXPECT_NEAR(half.mode.frequency / whole.mode.frequency, 1.0, 1e-5) << i;
    EXPECT_NEAR(half.damping / whole.damping, 1.0, 1e-4) << i;
    // Rubber with tan delta = 0.15 carries a part of the stiffness: D is below 0.075.
    EXPECT_GT(half.damping, 0.005) << half.mode.label();
    EXPECT_LT(half.damping, 0.075) << half.mode.label();
  }
}

TEST(DampedTire, MoreModesOfTheRelaxedTireHardlyChangeADampedOne) {
  const TireDescription tire = relaxing_tire(*constant_loss_factor(0.15, 1.0, 1000.0));
  const LossMaterials losses = build_losses(tire);
  FeTire fe(tire);
  const Inflated inflated = *fe.inflate(kDampedPressure);
  const auto few = DampedTire(fe, losses).modes(inflated, 6);
  const auto many = DampedTire(fe, losses).modes(inflated, 24);
  ASSERT_TRUE(few && many);
  for (std::size_t i = 0; i < few->size(); ++i) {
    EXPECT_NEAR((*few)[i].mode.frequency / (*many)[i].mode.frequency, 1.0, 2e-3) << i;
    EXPECT_NEAR((*few)[i].damping / (*many)[i].damping, 1.0, 0.01) << i;
  }
}

}  // namespace
}  // namespace latsch::fe_tire
