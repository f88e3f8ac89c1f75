// SPDX-License-Identifier: Apache-2.0
#include "optimization/strategy/explained_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/random.h"

namespace latsch {
namespace {

constexpr double kError = 0.5;

using Model = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

std::vector<KnownResiduals> trials_of(const Model& model, int count) {
  std::vector<KnownResiduals> known;
  RandomStream random(3, 1);
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector2d u(random.uniform(), random.uniform());
    known.push_back({u, model(u)});
  }
  return known;
}

KnownResiduals at(const Model& model, double x, double y) {
  const Eigen::Vector2d u(x, y);
  return {u, model(u)};
}

TEST(ExplainedPoint, IsAnywhereInTheOneBasinOfACurvedModel) {
  const Model model = [](const Eigen::VectorXd& u) {
    return Eigen::Vector3d(u[0] - 0.3, u[1] - 0.4 + 0.3 * u[0] * u[0], 0.2 * u[0] * u[1]);
  };
  const auto known = trials_of(model, 12);
  const KnownResiduals minimum = at(model, 0.3, 0.37);
  EXPECT_TRUE(is_explained_by(minimum, at(model, 0.9, 0.8), known, kError));
  EXPECT_TRUE(is_explained_by(minimum, minimum, known, kError));
}

TEST(ExplainedPoint, IsNotInTheBasinOfAnotherMinimum) {
  const Model model = [](const Eigen::VectorXd& u) {
    return Eigen::Vector2d(std::sin(3.0 * M_PI * u[0]), u[1] - 0.5);  // minima at 0, 1/3, 2/3, 1
  };
  const auto known = trials_of(model, 30);
  const KnownResiduals minimum = at(model, 1.0 / 3.0, 0.5);
  EXPECT_FALSE(is_explained_by(minimum, at(model, 0.7, 0.52), known, kError));
  EXPECT_FALSE(is_explained_by(minimum, at(model, 0.62, 0.45), known, kError));
}

TEST(ExplainedPoint, NeedsMoreTrialsThanVariables) {
  const Model model = [](const Eigen::VectorXd& u) { return Eigen::Vector2d(u[0], u[1]); };
  EXPECT_FALSE(is_explained_by(at(model, 0, 0), at(model, 0.5, 0.5), trials_of(model, 2), kError));
}

}  // namespace
}  // namespace latsch
