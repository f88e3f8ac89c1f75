// SPDX-License-Identifier: Apache-2.0
// Tests that no mode is missed. By Sylvester's law of inertia K - sigma M has as many negative
// pivots as there are modes below sigma [Parlett, The Symmetric Eigenvalue Problem, 1998, section
// 3.3]. This test counts them with Eigen's LDL' factorization; the modes were found by this
// program's Lanczos method.
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <numbers>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/contact/contact.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::fe_tire {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// Half angle of the part of the tread that may touch the ground, rad.
constexpr double kHalfAngle = 0.4;

Sparse sparse(const numerics::SymmetricMatrix& A) {
  const numerics::SymmetricPattern& pattern = A.pattern();
  const int b = pattern.block_size();
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < pattern.block_rows(); ++i)
    for (int k = pattern.row_start()[i]; k < pattern.row_start()[i + 1]; ++k)
      for (int column = 0; column < b; ++column)
        for (int row = 0; row < b; ++row)
          entries.emplace_back(b * i + row,
                               b * pattern.column()[k] + column,
                               A.values()[static_cast<std::size_t>(b * (b * k + column) + row)]);
  Sparse lower(A.size(), A.size());
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;  // diagonal blocks are stored fully, but only the lower triangle is read
}

/// Returns the number of negative pivots of K - (2 pi f)^2 M.
int modes_below(double frequency, const Sparse& K, const Sparse& M) {
  const double omega = 2.0 * std::numbers::pi * frequency;
  const Sparse shifted = K - omega * omega * M;
  const Eigen::SimplicialLDLT<Sparse> factor(shifted);
  EXPECT_EQ(factor.info(), Eigen::Success);
  return static_cast<int>((factor.vectorD().array() < 0.0).count());
}

/// Tangent and mass matrices of the motions about a state: for even and odd motions, or for all
/// motions at once.
struct Motions {
  std::vector<Sparse> K, M;

  Motions(const TireDescription& description, const TireState& at) {
    const Ring ring(build_mesh(description), description.element);
    const Materials materials = build_materials(description);
    const RingElements elements(ring, materials);
    const auto mirror = find_mirror(ring.mesh(), materials);
    const TreadShape shape = SolverSettings{.element = description.element}.tread_shape();
    const std::vector<int> none;
    const RingUnknowns even(ring,
                            at.is_halved ? RingSymmetry::even : RingSymmetry::none,
                            at.is_halved ? *mirror : none);
    const TreadSurface tread(even, shape, kHalfAngle);
    const RingAssembly assembly(even, &tread);
    TreadContact contact(tread, at.ground);
    AssembledState state{even.compress(at.u), at.alpha};
    contact.start(at.pose, state.x, at.anchors);
    EXPECT_FALSE(contact.misses(state.x));
    const auto add = [&](const RingAssembly& motions, const TreadSurface& moved) {
      numerics::SymmetricMatrix tangent(*assembly.pattern());
      int worst = 0;
      ASSERT_TRUE(assembly.assemble_tangent(
          elements, state, at.inflated->pressure, motions.unknowns(), tangent, &worst));
      add_stiffness(moved, contact.stuck(state.x), assembly.first_cell(), tangent);
      K.push_back(sparse(tangent));
      M.push_back(sparse(motions.mass(elements)));
    };
    add(assembly, tread);
    if (!at.is_halved) return;
    const RingUnknowns odd(ring, RingSymmetry::odd, *mirror);
    add(RingAssembly(odd, assembly.pattern()), TreadSurface(odd, shape, kHalfAngle));
  }

  int below(double frequency) const {
    int count = 0;
    for (std::size_t i = 0; i < K.size(); ++i) count += modes_below(frequency, K[i], M[i]);
    return count;
  }
};

TireDescription described(bool is_a, CordModel cords, ElementKind element) {
  TireDescription tire = is_a ? reference_tire_a() : reference_tire_b();
  tire.section.meridional = 18;
  tire.section.sectors = 36;
  tire.cord_model = cords;
  tire.element = element;
  return tire;
}

TEST(ModeCount, NoLoadedModeIsMissed) {
  constexpr int kModes = 24;
  for (const bool is_a : {true, false})
    for (const double friction : {0.0, 0.8}) {
      const TireDescription tire =
          described(is_a,
                    CordModel::rebar,
                    friction > 0 ? ElementKind::solid_shell : ElementKind::full_integration);
      FeTire model(tire);
      const auto inflated = model.inflate(tire.pressure);
      ASSERT_TRUE(inflated);
      const auto loaded = model.press(*inflated, Ground{2e10, friction}, {0.005, 0.012});
      ASSERT_TRUE(loaded);
      const auto modes = model.modes(loaded->back(), kModes);
      ASSERT_TRUE(modes);
      const Motions motions(tire, loaded->back());
      EXPECT_EQ(motions.below(0.0), 0);  // the state is stable
      // Modes are counted at frequencies between two successive modes whose frequencies differ.
      // Pairs of modes with equal frequencies, as on the tire off the ground, are skipped.
      for (int i = 0; i + 1 < kModes; ++i) {
        const double f = (*modes)[i].frequency, next = (*modes)[i + 1].frequency;
        if (i % 6 != 5 || next < 1.0001 * f) continue;
        EXPECT_EQ(motions.below(0.5 * (f + next)), i + 1) << tire.name << " mode " << i + 1;
      }
    }
}

// A tire under vacuum carries the load until it buckles, and beyond that Newton's method still
// finds the round equilibrium, which is unstable. LAPACK's factorization of the harmonics, off the
// ground, shows this, and press() must report it.
TEST(ModeCount, AnEquilibriumThatIsNotStableIsToldByPressing) {
  const TireDescription tire = described(false, CordModel::rebar, ElementKind::solid_shell);
  for (const double vacuum : {0.1e5, 0.2e5}) {
    FeTire model(tire);
    const auto inflated = model.inflate(-vacuum);
    ASSERT_TRUE(inflated);
    const auto loaded = model.press(*inflated, Ground{}, {0.002});
    EXPECT_EQ(loaded.ok(), model.modes(*inflated, 4).ok());
    if (loaded) {
      EXPECT_EQ(Motions(tire, loaded->back()).below(0.0), 0);
    } else {
      EXPECT_NE(loaded.failure().reason.find("deflection 2 mm: the equilibrium is not stable"),
                std::string::npos)
          << loaded.failure().reason;
    }
    EXPECT_EQ(loaded.ok(), vacuum < 0.15e5);
  }
}

// Regression test. With the ground condensed to the part of the tread that may touch, no tangent on
// the usual path is indefinite. Both tires need six factorizations for five steps, and two more to
// show that the last state is stable.
TEST(ModeCount, TiresAAndBNeedTheSameFactorsAndNoShifts) {
  for (const TireDescription& tire : {reference_tire_a(), reference_tire_b()}) {
    FeTire model(tire);
    const auto inflated = model.inflate(tire.pressure);
    ASSERT_TRUE(inflated);
    model.reset_counts();
    ASSERT_TRUE(model.press(*inflated, Ground{}, {0.005, 0.010, 0.015, 0.020, 0.025}));
    EXPECT_EQ(model.counts().shifts, 0) << tire.name;
    EXPECT_LE(model.counts().factorizations, 9) << tire.name;
  }
}

}  // namespace
}  // namespace latsch::fe_tire
