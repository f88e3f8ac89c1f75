// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/spin.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/analysis/modes.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/motion/spinning_harmonics.h"
#include "models/fe_tire/motion/spinning_tire.h"

namespace latsch::fe_tire {
namespace {

TireDescription few_sectors() {
  TireDescription tire = reference_tire_b();
  tire.section.sectors = 24;
  tire.section.meridional = 12;
  return tire;
}

/// The small tire on sectors of several widths, narrow at the contact.
TireDescription few_sectors_in_zones() {
  TireDescription tire = few_sectors();
  tire.section.sector_zones = {{4, 0.05}, {3, 0.12}};
  return tire;
}

// X' W X is twice the kinetic energy of a rigid rotation by 1 rad/s, and a translation has none, in
// sectors of every width.
TEST(FlowInertia, moves_a_rigid_rotation_exactly_and_a_translation_not_at_all) {
  const TireDescription description = few_sectors_in_zones();
  const Ring ring(build_mesh(description), description.element);
  const Materials materials = build_materials(description);
  ASSERT_GT(ring.widths(), 2);
  for (int s = 0; s < ring.sectors(); ++s) {
    for (int e = 0; e < ring.elements_per_sector(); ++e) {
      const Element& element = ring.mesh().elements[e];
      const FlowInertia inertia = flow_inertia(ring.shape(s, e), materials, element);
      Matrix38 X;
      for (int a = 0; a < 8; ++a) {
        const int node = element.node[a] % ring.mesh().nodes_per_sector();
        X.col(a) = ring.mesh().X.col(node);
      }
      X = ring.in_element_frame(s, e, X);
      const double mass = inertia.M.sum();
      const double turned = X.row(0).dot(X.row(0) * inertia.M) + X.row(2).dot(X.row(2) * inertia.M);
      double by_flow = 0.0;
      for (int i = 0; i < 3; ++i) by_flow += X.row(i).dot(X.row(i) * inertia.W);
      ASSERT_NEAR(by_flow, turned, 1e-12 * turned);
      ASSERT_LT((inertia.W * Vector8::Ones()).norm(), 1e-12 * inertia.W.norm());
      ASSERT_LT((inertia.G * Vector8::Ones()).norm(), 1e-12 * inertia.G.norm());
      ASSERT_GT(mass, 0.0);
    }
  }
}

TEST(FlowInertia, loads_a_zoned_ring_as_one_of_equal_sectors) {
  const TireDescription zoned = few_sectors_in_zones();
  const Ring ring(build_mesh(zoned), zoned.element);
  const RingElements elements(ring, build_materials(zoned));
  const RingUnknowns unknowns(ring, RingSymmetry::none, {});
  const Eigen::Matrix3Xd none = Eigen::Matrix3Xd::Zero(3, ring.mesh().nodes());
  const Eigen::VectorXd f = flow_forces(unknowns, elements, none);
  // All forces are outward and together nearly none; the rest, of second order in the sectors'
  // widths, acts on the rim's nodes.
  const Eigen::Matrix3Xd forces = unknowns.expand(f);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const int n = ring.mesh().nodes_per_sector();
  double outward = 0.0;
  for (int k = 0; k < forces.cols(); ++k) {
    sum += ring.mesh().frame(k / n) * forces.col(k);
    outward -= forces(2, k);
  }
  EXPECT_LT(sum.norm(), 5e-3 * outward);
  EXPECT_GT(outward, 0.0);
  // W u is the change of these forces with u.
  const RingAssembly assembly(unknowns);
  const numerics::SymmetricMatrix W = flow_stiffness(assembly, elements);
  Eigen::Matrix3Xd u = none;
  for (int k = 0; k < u.cols(); ++k) {
    if (ring.sector_dof(k % n) >= 0) u.col(k) << std::sin(0.1 * k), std::cos(0.3 * k), 0.2;
  }
  Eigen::MatrixXd Wu(unknowns.size(), 1);
  W.multiply(unknowns.compress(u), Wu);
  const Eigen::VectorXd change = flow_forces(unknowns, elements, u) - f;
  EXPECT_LT((change - Wu.col(0)).norm(), 1e-11 * change.norm());
}

TEST(SpinningTire, grows_with_the_square_of_a_small_speed) {
  FeTire tire(few_sectors());
  const Inflated at_rest = *tire.inflate(2e5);
  SpinningTire spinning(tire);
  const auto slow = spinning.inflate(at_rest, 10.0), twice = spinning.inflate(at_rest, 20.0);
  ASSERT_TRUE(slow && twice);
  const double growth = slow->growth - at_rest.growth;
  EXPECT_GT(growth, 0.0);
  EXPECT_NEAR((twice->growth - at_rest.growth) / growth, 4.0, 0.02);
  EXPECT_EQ(at_rest.spin, 0.0);
  EXPECT_EQ(twice->spin, 20.0);
}

TEST(SpinningTire, at_rest_has_the_modes_of_the_standing_tire) {
  FeTire tire(few_sectors());
  const Inflated at_rest = *tire.inflate(2e5);
  const auto usual = tire.modes(at_rest, 20);
  const auto by_waves = SpinningTire(tire).modes(at_rest, {}, 20);
  ASSERT_TRUE(usual && by_waves);
  ASSERT_EQ(by_waves->size(), 20u);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_NEAR((*by_waves)[k].frequency, (*usual)[k].frequency, 1e-6 * (*usual)[k].frequency);
    EXPECT_EQ((*by_waves)[k].label(), (*usual)[k].label());
    EXPECT_EQ((*by_waves)[k].sense, Sense::none);
  }
}

// A wave with the spin and one against it are one pair at rest: their frequencies come from it as
// the speed rises, one up and one down.
TEST(SpinningTire, splits_pairs_into_waves_with_and_against_the_spin) {
  FeTire tire(few_sectors());
  const Inflated at_rest = *tire.inflate(2e5);
  SpinningTire spinning(tire);
  constexpr double kSpeed = 30.0;
  const auto modes = spinning.modes(*spinning.inflate(at_rest, kSpeed), {}, 16);
  ASSERT_TRUE(modes) << modes.failure().reason;
  int with = 0, against = 0;
  for (const SpinningMode& mode : *modes) {
    EXPECT_EQ(mode.sense == Sense::none, mode.n == 0);
    const double shift = mode.n * kSpeed / (2.0 * std::numbers::pi);
    if (mode.sense == Sense::with) {
      ++with;
      EXPECT_NEAR(mode.frequency - mode.frequency_on_tire, shift, 1e-9);
    } else if (mode.sense == Sense::against) {
      ++against;
      EXPECT_NEAR(mode.frequency_on_tire - mode.frequency, shift, 1e-9);
    }
  }
  EXPECT_GT(with, 2);
  EXPECT_GT(against, with);
}

// Short waves of a coarse mesh are not lost below the standing-wave speed, and none is held above.
TEST(SpinningTire, has_modes_up_to_its_standing_wave) {
  FeTire tire(few_sectors());
  const Inflated at_rest = *tire.inflate(2e5);
  SpinningTire spinning(tire);
  const auto wave = spinning.standing_wave(at_rest);
  ASSERT_TRUE(wave) << wave.failure().reason;
  EXPECT_LE(wave->n, 8);
  const auto below = spinning.inflate(at_rest, 0.99 * wave->speed);
  ASSERT_TRUE(below) << below.failure().reason;
  const auto modes = spinning.modes(*below, {}, 6);
  ASSERT_TRUE(modes) << modes.failure().reason;
  EXPECT_EQ(modes->front().sense, Sense::against);
  EXPECT_FALSE(spinning.inflate(at_rest, 1.01 * wave->speed));
}

// The wave travels with the spin: material, which moves toward decreasing theta, and the crest of
// Re(shape exp(i omega t)) move in the same direction.
TEST(SpinningTire, waves_with_the_spin_travel_with_the_material) {
  FeTire tire(few_sectors());
  SpinningTire spinning(tire);
  const auto modes = spinning.modes(*spinning.inflate(*tire.inflate(2e5), 30.0), {}, 16);
  ASSERT_TRUE(modes);
  const int n = tire.mesh().nodes_per_sector();
  for (const SpinningMode& mode : *modes) {
    if (mode.sense == Sense::none) continue;
    Eigen::Index largest;
    mode.shape.col(0).cwiseAbs().maxCoeff(&largest);
    int node = 0;
    double most = 0.0;
    for (int k = 0; k < n; ++k) {
      if (mode.shape.col(k).norm() > most) {
        most = mode.shape.col(k).norm();
        node = k;
      }
    }
    mode.shape.col(node).cwiseAbs().maxCoeff(&largest);
    // Phase over theta: exp(i (n theta + omega t)) travels toward decreasing theta.
    const double phase = std::arg(mode.shape(largest, n + node) / mode.shape(largest, node));
    EXPECT_NEAR(
        phase, (mode.sense == Sense::with ? 1.0 : -1.0) * mode.n * tire.mesh().angle(1), 1e-6)
        << mode.label();
  }
}

Rim moving_rim(RimMotion motion, double mass, double spin, double diametral) {
  return {motion, {.mass = mass, .spin_inertia = spin, .diametral_inertia = diametral}};
}

TEST(Rim, that_is_very_heavy_is_held) {
  FeTire tire(few_sectors());
  SpinningTire spinning(tire);
  const Inflated state = *spinning.inflate(*tire.inflate(2e5), 40.0);
  const auto held = spinning.modes(state, {}, 10);
  const auto heavy = spinning.modes(state, moving_rim(RimMotion::free, 1e9, 1e9, 0.75e9), 12);
  ASSERT_TRUE(held && heavy) << heavy.failure().reason;
  std::size_t k = 0;
  for (const SpinningMode& mode : *held) {
    // Nutation at Omega I_spin / I_diameter is the only mode that a held rim does not have.
    while (k < heavy->size() && std::abs((*heavy)[k].frequency / mode.frequency - 1.0) > 1e-6) ++k;
    ASSERT_LT(k, heavy->size()) << mode.label();
  }
}

// A wheel on which nothing acts precesses freely: it nutates at Omega I_spin / I_diameter of the
// whole if the tire is stiff beside its speed.
TEST(Rim, that_is_free_nutates_as_a_rigid_body) {
  FeTire tire(few_sectors());
  SpinningTire spinning(tire);
  constexpr double kSpeed = 8.0;
  const Inflated state = *spinning.inflate(*tire.inflate(2e5), kSpeed);
  const auto modes = spinning.modes(state, moving_rim(RimMotion::free, 10.0, 0.25, 0.2), 3);
  ASSERT_TRUE(modes) << modes.failure().reason;
  const MassProperties mass = tire.mass_properties(state);
  const double nutation =
      kSpeed * (mass.spin_inertia + 0.25) / (mass.diametral_inertia + 0.2) / 2.0 / std::numbers::pi;
  EXPECT_EQ((*modes)[0].n, 1);
  EXPECT_EQ((*modes)[0].sense, Sense::with);
  EXPECT_NEAR((*modes)[0].frequency, nutation, 5e-3 * nutation);
}

TEST(Rim, on_soft_springs_moves_with_the_whole_wheel) {
  FeTire tire(few_sectors());
  const Inflated at_rest = *tire.inflate(2e5);
  Rim rim = moving_rim(RimMotion::rigid, 10.0, 0.25, 0.2);
  rim.body.lateral_spring = 2e4;
  const auto modes = SpinningTire(tire).modes(at_rest, rim, 4);
  ASSERT_TRUE(modes) << modes.failure().reason;
  const double mass = 10.0 + tire.mass_properties(at_rest).mass;
  const double rigid = std::sqrt(2e4 / mass) / 2.0 / std::numbers::pi;
  EXPECT_EQ((*modes)[0].label(), "lateral n=0");
  EXPECT_NEAR((*modes)[0].frequency, rigid, 0.05 * rigid);
  EXPECT_LT((*modes)[0].frequency, rigid);
}

// The whole wheel can be moved without force, which springs on the rim alone then hold: without
// them a free wheel has no mode between rest and those of the tire, in the air under pressure too.
TEST(Rim, is_moved_with_the_tire_without_force) {
  FeTire tire(few_sectors());
  const Inflated at_rest = *tire.inflate(2e5);
  const Ring ring(tire.mesh(), ElementKind::solid_shell);
  const RingElements elements(ring, tire.materials());
  const auto harmonics =
      SpinningHarmonics::about(elements, at_rest, moving_rim(RimMotion::free, 10.0, 0.25, 0.2));
  ASSERT_TRUE(harmonics);
  for (int n = 0; n <= 1; ++n) {
    const auto equations = harmonics->equations(n);
    ASSERT_TRUE(equations);
    const auto& K = equations->problem.K;
    Eigen::MatrixXcd rigid(K.size(), 2), held(K.size(), 2);
    for (int node = 0; node < ring.mesh().nodes_per_sector(); ++node) {
      if (ring.sector_dof(node) < 0) continue;
      const Eigen::Vector3d x = ring.mesh().X.col(node) + at_rest.u.col(node);
      rigid.middleRows<3>(ring.sector_dof(node)) = rim_displacements(n, x);
    }
    rigid.bottomRows<2>().setIdentity();
    K.multiply(rigid, held);
    held.bottomRows<2>() -=
        equations->soft.cast<std::complex<double>>().asDiagonal() * Eigen::Matrix2cd::Identity();
    for (int motion = 0; motion < 2; ++motion)
      EXPECT_LT(held.col(motion).norm(), 1e-9 * K.border.col(motion).norm()) << n << motion;
  }
}

}  // namespace
}  // namespace latsch::fe_tire
