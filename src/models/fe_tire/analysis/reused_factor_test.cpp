// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/reused_factor.h"

#include <gtest/gtest.h>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/analysis/ring_balance.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::fe_tire {
namespace {

using IfIndefinite = ReusedFactor::IfIndefinite;
using IfSlow = ReusedFactor::IfSlow;

constexpr double kInflationOfB = 2.6e5;
// Relative error of a solution with a single-precision factorization.
constexpr double kOfSinglePrecision = 1e-4;

/// Tire B off the ground, evaluated at a lower pressure than that of its equilibrium, so that its
/// forces are not in balance.
class UnbalancedTire {
 public:
  UnbalancedTire()
      : description_(coarse()),
        materials_(build_materials(description_)),
        ring_(build_mesh(description_), ElementKind::solid_shell),
        elements_(ring_, materials_),
        unknowns_(ring_, RingSymmetry::none, {}),
        tread_(unknowns_, TreadShape::smooth, 0.4),
        balance_(unknowns_, tread_, counts_),
        elimination_(numerics::eliminate(*balance_.assembly().pattern())) {
    FeTire tire(build_mesh(description_), materials_);
    const auto inflated = tire.inflate(kInflationOfB);
    state_.x = unknowns_.compress(inflated->u.replicate(1, ring_.sectors()));
    state_.alpha = inflated->alpha.replicate(unknowns_.sectors(), 1);
    evaluate(0.9);
  }

  /// Computes forces and tangent at a share of the inflation pressure.
  void evaluate(double share) {
    EXPECT_TRUE(balance_.begin(state_, {&elements_, share * kInflationOfB, nullptr}, true));
  }
  ReusedFactor factor(const ReusedFactorOptions& options = {}) {
    return {*balance_.assembly().pattern(), elimination_, tread_, options, counts_};
  }
  LinearizedRing at() { return {balance_.K(), nullptr, state_.x, balance_.residual()}; }
  /// |f - K d| / |f|
  double remains(const Eigen::VectorXd& d) {
    Eigen::VectorXd Kd(d.size());
    balance_.K().multiply(d.data(), Kd.data());
    return (balance_.residual() - Kd).norm() / balance_.residual().norm();
  }
  RingBalance& balance() { return balance_; }
  AssembledState& state() { return state_; }
  const SolverCounts& counts() const { return counts_; }

 private:
  static TireDescription coarse() {
    TireDescription tire = reference_tire_b();
    tire.section.meridional = 13;
    tire.section.sectors = 24;
    return tire;
  }
  TireDescription description_;
  Materials materials_;
  Ring ring_;
  RingElements elements_;
  RingUnknowns unknowns_;
  TreadSurface tread_;
  SolverCounts counts_;
  RingBalance balance_;
  numerics::Elimination elimination_;
  AssembledState state_;
};

TEST(ReusedFactor, ANewFactorSolvesItsOwnTangentWithoutIterations) {
  UnbalancedTire tire;
  ReusedFactor factor = tire.factor();
  EXPECT_FALSE(factor.exists());
  Eigen::VectorXd d;
  ASSERT_TRUE(factor.renew(tire.at(), kOfSinglePrecision, IfIndefinite::give_up, d));
  EXPECT_TRUE(factor.exists());
  EXPECT_FALSE(factor.is_stale());
  EXPECT_LT(tire.remains(d), kOfSinglePrecision);
  EXPECT_EQ(tire.counts().cg_iterations, 0);
  EXPECT_EQ(tire.counts().factorizations, 1);
  factor.forget();
  EXPECT_FALSE(factor.exists());
}

// The tangent's diagonal is made stiffer. The old factorization must correct the direction to the
// tolerance, and the iterations that this takes must become its age.
TEST(ReusedFactor, AFactorOfAnotherTangentIsCorrectedAndAges) {
  UnbalancedTire tire;
  ReusedFactorOptions options;
  options.iterations_worth_a_factor = 200;
  options.stale_age = 1;
  ReusedFactor factor = tire.factor(options);
  ASSERT_TRUE(factor.factorize(tire.balance().K(), nullptr));
  tire.balance().K().add_to_diagonal(0.1 * tire.balance().K().diagonal().minCoeff());
  Eigen::VectorXd d;
  ASSERT_TRUE(factor.find_first(tire.at(), d));
  const double first = tire.remains(d);
  constexpr double kTolerance = 1e-3;
  EXPECT_GT(first, kTolerance);
  ASSERT_TRUE(factor.correct(tire.at(), kTolerance, IfSlow::take_it, d));
  EXPECT_LE(tire.remains(d), 1.001 * kTolerance);
  EXPECT_GT(tire.counts().cg_iterations, options.stale_age);
  EXPECT_TRUE(factor.is_stale());
  EXPECT_EQ(tire.counts().factorizations, 1);
}

TEST(ReusedFactor, AnIndefiniteTangentIsGivenUpOrShiftedToADirectionOfDescent) {
  UnbalancedTire tire;
  const double least = tire.balance().K().diagonal().minCoeff();
  // Makes a diagonal entry negative, so the tangent is not positive definite.
  tire.balance().K().add_to_diagonal(-1.5 * least);
  ReusedFactor factor = tire.factor();
  Eigen::VectorXd d;
  EXPECT_FALSE(factor.renew(tire.at(), kOfSinglePrecision, IfIndefinite::give_up, d));
  EXPECT_EQ(tire.counts().shifts, 0);
  EXPECT_TRUE(factor.renew(tire.at(), kOfSinglePrecision, IfIndefinite::shift, d));
  EXPECT_GT(tire.counts().shifts, 0);
  EXPECT_GT(d.dot(tire.balance().residual()), 0.0);
}

TEST(RingBalance, ATangentBelongsToTheStateOfTheForcesOrToAnEarlierOne) {
  using Tangent = RingBalance::Tangent;
  UnbalancedTire tire;
  RingBalance& balance = tire.balance();
  const double off_balance = balance.residual().norm();
  EXPECT_EQ(balance.tangent(), Tangent::current);
  EXPECT_EQ(tire.counts().assemblies, 1);
  ASSERT_TRUE(balance.evaluate(tire.state(), false));
  const double by_forces_alone = balance.residual().norm();
  EXPECT_EQ(balance.tangent(), Tangent::earlier);
  ASSERT_TRUE(balance.begin(tire.state(), balance.load(), false));
  EXPECT_EQ(balance.tangent(), Tangent::none);
  EXPECT_EQ(balance.residual().norm(), by_forces_alone);
  ASSERT_TRUE(balance.ensure_tangent(tire.state()));
  ASSERT_TRUE(balance.ensure_tangent(tire.state()));  // the tangent was computed already
  EXPECT_EQ(balance.tangent(), Tangent::current);
  EXPECT_EQ(tire.counts().assemblies, 2);
  tire.evaluate(1.0);
  // The forces are in balance at the tire's own pressure.
  EXPECT_LT(balance.residual().norm(), 1e-3 * off_balance);
}

}  // namespace
}  // namespace latsch::fe_tire
