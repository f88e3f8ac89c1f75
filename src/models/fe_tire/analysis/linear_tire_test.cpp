// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/linear_tire.h"

#include <gtest/gtest.h>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/description/reference_tires.h"
#include "numerics/sparse/elimination.h"

namespace latsch::fe_tire {
namespace {

constexpr double kInflation = 2.6e5;

TireDescription coarse(TireDescription tire) {
  tire.section.meridional = 13;
  tire.section.sectors = 24;
  return tire;
}

// Checks solutions of (L.1) with the uncondensed contact forces: for half a ring and a whole one,
// for heights alone without friction, and for all directions with friction and on a cleat.
TEST(LinearTire, AnswersTheGroundExactly) {
  const TireDescription description = coarse(reference_tire_b());
  const Materials materials = build_materials(description);
  FeTire tire(build_mesh(description), materials);
  const auto inflated = tire.inflate(kInflation);
  ASSERT_TRUE(inflated);
  const Ring ring(build_mesh(description), ElementKind::solid_shell);
  const RingElements elements(ring, materials);
  const auto mirror = find_mirror(ring.mesh(), materials);
  ASSERT_TRUE(mirror);
  const Ground flat, rough{.mu = 0.6},
      cleat{.bar = Bar{.height = 4e-3, .length = 0.03, .bevel = 2e-3, .angle = 0.4}};
  for (const RingSymmetry symmetry : {RingSymmetry::even, RingSymmetry::none}) {
    for (const Ground& ground : {flat, rough, cleat}) {
      const RingUnknowns unknowns(ring, symmetry, *mirror);
      const TreadSurface tread(unknowns, TreadShape::smooth, 0.4);
      const RingAssembly assembly(unknowns, &tread);
      TreadContact contact(tread, ground);
      AssembledState state{unknowns.compress(inflated->u.replicate(1, ring.sectors())),
                           inflated->alpha.replicate(unknowns.sectors(), 1)};
      contact.start(FeTire::below(*inflated, -5e-3), state.x, {});
      contact.move(FeTire::below(*inflated, 0.008));
      numerics::SymmetricMatrix K(*assembly.pattern());
      Eigen::VectorXd g, d;
      ASSERT_TRUE(assembly.assemble(elements, state, kInflation, g, &K, nullptr));
      const auto of_ground = [&](const Eigen::VectorXd& x) {
        Eigen::VectorXd c = Eigen::VectorXd::Zero(x.size());
        add_forces(tread, contact.touches(tread.displacements(x)), c);
        return c;
      };
      LinearTire linear(*assembly.pattern(), numerics::eliminate(*assembly.pattern()), tread);
      ASSERT_TRUE(linear.factorize(K, &contact));
      ASSERT_TRUE(linear.step(&contact, state.x, g + of_ground(state.x), d));

      const Eigen::VectorXd before = of_ground(state.x), after = of_ground(state.x - d);
      Eigen::VectorXd Kd(d.size());
      K.multiply(d.data(), Kd.data());
      // Points have come into contact, so the ground's forces differ much from those at the start
      // of the step.
      EXPECT_GT((after - before).norm(), 0.5 * after.norm());
      // The factorization has single precision. The errors are 0.8 to 1.0e-4 in all six cases; in
      // double precision they would be below 2e-9.
      EXPECT_LT((g - Kd + after).norm(), 2e-4 * after.norm());
      EXPECT_LT(linear.residual(K, d).norm(), 2e-4 * after.norm());
    }
  }
}

// A coefficient of friction of 1e-12 has no effect, except that the solver then works with all
// directions instead of heights alone. Every equilibrium with heights alone is polished, so its
// forces agree with those of a reference with a hundred times smaller tolerance, in more digits
// than are displayed.
TEST(LinearTire, EquilibriaAreTheSameByNodesAndByHeights) {
  for (const TireDescription& description :
       {coarse(reference_tire_a()), coarse(reference_tire_b())}) {
    FeTire tire(description);
    const auto inflated = tire.inflate(kInflation);
    ASSERT_TRUE(inflated);
    const std::vector<double> deflections = {0.005, 0.01, 0.015, 0.02, 0.025};
    const auto by_heights = tire.press(*inflated, Ground{}, deflections);
    SolverSettings exact{.element = description.element};
    exact.tolerance *= 0.01;
    FeTire judge(build_mesh(description), build_materials(description), exact);
    const auto by_nodes = judge.press(*inflated, Ground{.mu = 1e-12}, deflections);
    ASSERT_TRUE(by_heights) << by_heights.failure().reason;
    ASSERT_TRUE(by_nodes) << by_nodes.failure().reason;
    for (std::size_t k = 0; k < deflections.size(); ++k) {
      const double Fz = judge.stand((*by_nodes)[k]).force.z();
      EXPECT_NEAR(tire.stand((*by_heights)[k]).force.z(), Fz, 1e-7 * Fz) << k;
    }
    EXPECT_LT((by_heights->back().u - by_nodes->back().u).norm(), 1e-6 * by_nodes->back().u.norm());
  }
}

// Points that come into contact or lift off must neither need evaluations of the elements nor make
// a tangent indefinite.
TEST(LinearTire, AnEquilibriumTakesAsManyPassesAsItsElementsNeed) {
  for (const TireDescription& description :
       {coarse(reference_tire_a()), coarse(reference_tire_b()), reference_tire_b()}) {
    FeTire tire(description);
    const auto inflated = tire.inflate(kInflation);
    ASSERT_TRUE(inflated);
    for (const std::vector<double>& deflections :
         {std::vector{0.001}, std::vector{0.008}, std::vector{0.005, 0.01, 0.015, 0.02, 0.025}}) {
      tire.reset_counts();
      ASSERT_TRUE(tire.press(*inflated, Ground{}, deflections));
      EXPECT_LE(tire.counts().assemblies, 5 * static_cast<int>(deflections.size()));
      EXPECT_EQ(tire.counts().shifts, 0);
    }
  }
}

}  // namespace
}  // namespace latsch::fe_tire
