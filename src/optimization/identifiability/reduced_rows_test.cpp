// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/reduced_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/random.h"
#include "optimization/identifiability/cross_validation.h"
#include "optimization/identifiability/identification.h"

namespace latsch {
namespace {

Evaluated random_rows(Eigen::Index m, Eigen::Index n) {
  RandomStream random(7, 0);
  Evaluated one(Eigen::VectorXd(m), Eigen::MatrixXd(m, n));
  for (double& x : one.r) x = random.uniform() - 0.5;
  for (double& x : one.J.reshaped()) x = random.uniform() - 0.5;
  return one;
}

TEST(ReducedRows, HaveTheProductsOfTheirGroup) {
  const Evaluated whole = random_rows(40, 3);
  RowGroups groups(3);
  for (Eigen::Index k = 0; k < 38; ++k) groups[k % 5 == 0 ? 1 : 0].push_back(k);
  groups[2] = {38, 39};  // fewer than n + 1
  const Evaluated reduced = reduced_rows(whole, groups);
  const std::vector<int> group = groups_of_reduced_rows(groups, 3);
  ASSERT_EQ(reduced.r.size(), 4 + 4 + 2);
  ASSERT_EQ(std::ssize(group), reduced.r.size());
  EXPECT_TRUE(reduced.is_reduced);
  for (int g = 0; g < 3; ++g) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index k = 0; k < reduced.r.size(); ++k)
      if (group[static_cast<std::size_t>(k)] == g) rows.push_back(k);
    const Evaluated a = reduced.of(rows), b = whole.of(groups[static_cast<std::size_t>(g)]);
    EXPECT_LT((a.J.transpose() * a.J - b.J.transpose() * b.J).norm(), 1e-13) << g;
    EXPECT_LT((a.J.transpose() * a.r - b.J.transpose() * b.r).norm(), 1e-13) << g;
    EXPECT_NEAR(a.r.squaredNorm(), b.r.squaredNorm(), 1e-13) << g;
  }
}

/// Returns the residuals of a exp(b t) at nine times against its values at (2, -1.3) with a wave
/// added.
Evaluated exponential(const DesignPoint& p) {
  Evaluated one(Eigen::VectorXd(9), Eigen::MatrixXd(9, 2));
  for (int i = 0; i < 9; ++i) {
    const double t = 0.3 * i, e = std::exp(p.values[1] * t);
    one.r[i] = p.values[0] * e - 2.0 * std::exp(-1.3 * t) + 0.05 * std::sin(7.0 * t);
    // The derivatives are those with respect to the unit cube.
    one.J.row(i) << 4.0 * e, 3.0 * p.values[0] * t * e;
  }
  return one;
}

DesignSpace space_of_exponential() {
  return DesignSpace({{.name = "a", .lower = 0.0, .upper = 4.0, .initial = 2.0},
                      {.name = "b", .lower = -3.0, .upper = 0.0, .initial = -1.3}});
}

/// Identifies the variables of the exponential. If `reduced` is true, the profiles are computed
/// from reduced rows, everything else from whole rows.
Identification identification_of_exponential(bool reduced, const std::vector<int>& free) {
  const DesignSpace space = space_of_exponential();
  IdentificationOptions options;
  options.confidence.sigma = 0.05;
  options.free = free;
  Identification identification(space, space.initial(), options);
  double share = 0.0;
  while (!identification.wanted().empty()) {
    std::vector<Result<Evaluated>> outcomes;
    for (const DesignPoint& p : identification.wanted()) {
      Evaluated one = exponential(p);
      if (reduced && identification.is_profiling())
        one = reduced_rows(one, {identification.residuals_used()});
      outcomes.emplace_back(std::move(one));
      if (identification.is_enough(outcomes.front())) break;
    }
    identification.observe(outcomes);
    if (!identification.is_profiling()) continue;
    EXPECT_GE(identification.share_done(), 0.0);
    EXPECT_LT(identification.share_done(), 1.0);
    share = identification.share_done();
  }
  EXPECT_GT(share, 0.7) << "before the last round";
  EXPECT_EQ(identification.share_done(), 1.0);
  return identification;
}

TEST(ReducedRows, GiveTheSameProfiles) {
  for (const std::vector<int>& free : {std::vector<int>{}, std::vector<int>{1}}) {
    const auto whole = identification_of_exponential(false, free).profiles();
    const auto reduced = identification_of_exponential(true, free).profiles();
    ASSERT_EQ(whole.size(), free.empty() ? 2u : 1u);
    ASSERT_EQ(whole.size(), reduced.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_EQ(whole[i].verdict, reduced[i].verdict);
      EXPECT_NEAR(whole[i].interval.lower, reduced[i].interval.lower, 1e-9);
      EXPECT_NEAR(whole[i].interval.upper, reduced[i].interval.upper, 1e-9);
      EXPECT_EQ(whole[i].points.size(), reduced[i].points.size());
    }
  }
}

/// Leaves out each of the three groups in turn, with reduced rows or with whole ones.
std::vector<LeftOut> left_out_of_exponential(bool reduced) {
  const DesignSpace space = space_of_exponential();
  const Identification identification = identification_of_exponential(false, {});
  const Linearization& best = identification.refitted();
  RowGroups groups(2);
  std::vector<int> group;
  for (Eigen::Index k = 0; k < 9; ++k) {
    groups[k < 4 ? 0 : 1].push_back(k);
    group.push_back(k < 4 ? 0 : 1);
  }
  const auto seen = [&](const Evaluated& whole) {
    return reduced ? reduced_rows(whole, groups) : whole;
  };
  const Evaluated at = seen({best.r, best.J});
  CrossValidation validation(
      space,
      {best.u, at.r, at.J, true},
      reduced ? groups_of_reduced_rows(groups, 2) : group,
      1e-9,
      {},
      reduced ? std::map<int, Eigen::Index>{{0, 4}, {1, 5}} : std::map<int, Eigen::Index>{});
  while (!validation.wanted().empty()) {
    EXPECT_LT(validation.share_done(), 1.0);
    std::vector<Result<Evaluated>> outcomes;
    for (const DesignPoint& p : validation.wanted()) outcomes.emplace_back(seen(exponential(p)));
    validation.observe(outcomes);
  }
  EXPECT_EQ(validation.share_done(), 1.0);
  return validation.left_out();
}

TEST(ReducedRows, PredictAGroupAsWholeRowsDo) {
  const auto whole = left_out_of_exponential(false), reduced = left_out_of_exponential(true);
  ASSERT_EQ(whole.size(), 2u);
  ASSERT_EQ(reduced.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(whole[i].fitted, reduced[i].fitted, 1e-12);
    EXPECT_NEAR(whole[i].predicted, reduced[i].predicted, 1e-9);
    EXPECT_LT((whole[i].u - reduced[i].u).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace latsch
