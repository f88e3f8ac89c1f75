// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/cross_validation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace latsch {
namespace {

using Model = std::function<Result<Evaluated>(double)>;

/// Residuals in two groups that depend on one number x: x - 0.4 twice, and x - 0.6 twice. The
/// common fit is x = 0.5 with residuals of 0.1; after a fit to one group, the residuals of the
/// other are 0.2.
Evaluated two_groups(double x) { return Eigen::VectorXd{{x - 0.4, x - 0.4, x - 0.6, x - 0.6}}; }

std::vector<LeftOut> validate(const Model& model) {
  const DesignSpace space({{.name = "x"}});
  const Linearization best{
      Eigen::VectorXd::Constant(1, 0.5), two_groups(0.5).r, Eigen::MatrixXd::Ones(4, 1)};
  CrossValidation validation(space, best, {0, 0, 1, 1}, 1e-6);
  while (!validation.wanted().empty()) {
    std::vector<Result<Evaluated>> residuals;
    for (const DesignPoint& point : validation.wanted())
      residuals.push_back(model(point.values[0]));
    validation.observe(residuals);
  }
  return validation.left_out();
}

TEST(CrossValidation, PredictsAGroupFromTheOthers) {
  const auto folds = validate([](double x) { return two_groups(x); });
  ASSERT_EQ(folds.size(), 2u);
  for (const LeftOut& fold : folds) {
    EXPECT_NEAR(fold.fitted, 0.1, 1e-12);
    EXPECT_NEAR(fold.predicted, 0.2, 1e-9);
  }
  EXPECT_NEAR(folds[0].u[0], 0.6, 1e-9);
}

// The model fails above x = 0.5, so the fit without group 0 fails. It must not count as a good
// prediction.
TEST(CrossValidation, ARefitThatFailsPredictsNothing) {
  const auto folds = validate([](double x) -> Result<Evaluated> {
    if (x > 0.5) return Failure{"no solution"};
    return two_groups(x);
  });
  EXPECT_TRUE(std::isnan(folds[0].predicted));
  EXPECT_NEAR(folds[1].predicted, 0.2, 1e-9);
}

}  // namespace
}  // namespace latsch
