// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/ring/linear_tire.h"

#include <gtest/gtest.h>

#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/ring/fe_tire.h"
#include "models/fe_tire/ring/ring_assembly.h"

namespace latsch::fe_tire {
namespace {

constexpr double kInflation = 2.6e5;

TireDescription coarse(TireDescription tire) {
  tire.section.meridional = 13;
  tire.section.sectors = 24;
  return tire;
}

// (L.1) with the forces of the ground as the elements' assembly knows them, which sees neither the
// window nor heights; for half a ring and for a whole one.
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
  for (const RingSymmetry symmetry : {RingSymmetry::even, RingSymmetry::none}) {
    const RingUnknowns unknowns(ring, symmetry, *mirror);
    const RingAssembly assembly(unknowns);
    const ContactWindow window(unknowns);
    GroundContact contact(unknowns, Ground{});
    contact.set_height(-inflated->radius + 0.008);
    RingState state{unknowns.compress(inflated->u.replicate(1, ring.sectors())),
                    inflated->alpha.replicate(unknowns.sectors(), 1)};
    numerics::SymmetricMatrix K(*assembly.pattern());
    Eigen::VectorXd f, d;
    ASSERT_TRUE(assembly.assemble(elements, state, kInflation, &contact, f, &K, nullptr, &window));
    LinearTire linear(*assembly.pattern(), window);
    ASSERT_TRUE(linear.factorize(K, true));
    ASSERT_TRUE(linear.step(contact, state.x, f, d));

    const auto ground = [&](const Eigen::VectorXd& x) {
      RingState at{x, state.alpha}, again = at;
      Eigen::VectorXd with, without;
      EXPECT_TRUE(assembly.assemble(elements, at, kInflation, &contact, with, nullptr, nullptr));
      EXPECT_TRUE(
          assembly.assemble(elements, again, kInflation, nullptr, without, nullptr, nullptr));
      return Eigen::VectorXd(with - without);
    };
    const Eigen::VectorXd before = ground(state.x), after = ground(state.x - d);
    Eigen::VectorXd Kd(d.size());
    K.multiply(d.data(), Kd.data());
    // Points came down: the ground is another one than where the step began.
    EXPECT_GT((after - before).norm(), 0.5 * after.norm());
    EXPECT_LT((f - before - Kd + after).norm(), 1e-4 * after.norm());
    EXPECT_LT(linear.residual(K, d).norm(), 1e-4 * after.norm());
  }
}

// A coefficient of friction of 1e-12 is none, but its ground stands in the tangent, point by point,
// as Newton's method alone would have it. Every equilibrium is polished: whichever way led there,
// the forces agree in more digits than are shown.
TEST(LinearTire, EquilibriaAreThoseOfNewtonsMethodAlone) {
  for (const TireDescription& description :
       {coarse(reference_tire_a()), coarse(reference_tire_b())}) {
    FeTire tire(description);
    const auto inflated = tire.inflate(kInflation);
    ASSERT_TRUE(inflated);
    const std::vector<double> deflections = {0.005, 0.01, 0.015, 0.02, 0.025};
    const auto apart = tire.load(*inflated, deflections, Ground{});
    const auto within = tire.load(*inflated, deflections, Ground{2.0e10, 1e-12});
    ASSERT_TRUE(apart && within);
    for (std::size_t k = 0; k < deflections.size(); ++k) {
      EXPECT_NEAR(apart->curve[k].Fz, within->curve[k].Fz, 1e-7 * within->curve[k].Fz) << k;
    }
    EXPECT_LT((apart->u - within->u).norm(), 1e-6 * within->u.norm());
  }
}

// Points that come down or lift off take no passes over the elements and leave no tangent
// indefinite.
TEST(LinearTire, AnEquilibriumTakesAsManyPassesAsItsElementsNeed) {
  for (const TireDescription& description :
       {coarse(reference_tire_a()), coarse(reference_tire_b()), reference_tire_b()}) {
    FeTire tire(description);
    const auto inflated = tire.inflate(kInflation);
    ASSERT_TRUE(inflated);
    for (const std::vector<double>& deflections :
         {std::vector{0.001}, std::vector{0.008}, std::vector{0.005, 0.01, 0.015, 0.02, 0.025}}) {
      tire.reset_counts();
      ASSERT_TRUE(tire.load(*inflated, deflections, Ground{}));
      EXPECT_LE(tire.counts().assemblies, 5 * static_cast<int>(deflections.size()));
      EXPECT_EQ(tire.counts().shifts, 0);
    }
  }
}

}  // namespace
}  // namespace latsch::fe_tire
