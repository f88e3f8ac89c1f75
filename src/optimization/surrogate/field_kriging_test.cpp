// SPDX-License-Identifier: Apache-2.0
#include "optimization/surrogate/field_kriging.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "optimization/design/sobol.h"

namespace latsch {
namespace {

Eigen::MatrixXd spread_places(int count, int settings) {
  std::vector<DesignVariable> variables;
  for (int i = 0; i < settings; ++i) variables.push_back({.name = std::to_string(i)});
  Eigen::MatrixXd places(count, settings);
  const auto points = sobol(DesignSpace(variables), count).points;
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < settings; ++i)
      places(k, i) = points[static_cast<std::size_t>(k)].values[static_cast<std::size_t>(i)];
  return places;
}

Eigen::VectorXd smooth_fields(const Eigen::VectorXd& s) {
  return Eigen::Vector3d(
      3.0 - 2.0 * s[0] + s[1], std::exp(-s[0]) * std::cos(3.0 * s[1]), 1.0 / (1.0 + s[0] * s[1]));
}

TEST(FieldKriging, SmoothFieldsAreInterpolatedAndTheirErrorIsThatOfQ2) {
  const Eigen::MatrixXd places = spread_places(40, 2);
  Eigen::MatrixXd fields(40, 3);
  for (int k = 0; k < 40; ++k) fields.row(k) = smooth_fields(places.row(k).transpose()).transpose();
  const FieldKriging kriging(places, fields);
  EXPECT_GT(kriging.Q2().minCoeff(), 0.99);
  const Eigen::MatrixXd others = spread_places(200, 2).bottomRows(150);
  for (Eigen::Index k = 0; k < others.rows(); ++k) {
    const Eigen::VectorXd s = others.row(k).transpose();
    EXPECT_LT((kriging.at(s) - smooth_fields(s)).lpNorm<Eigen::Infinity>(), 0.03) << k;
  }
}

TEST(FieldKriging, SamplesThemselvesAreMet) {
  const Eigen::MatrixXd places = spread_places(20, 2);
  Eigen::MatrixXd fields(20, 3);
  for (int k = 0; k < 20; ++k) fields.row(k) = smooth_fields(places.row(k).transpose()).transpose();
  const FieldKriging kriging(places, fields);
  for (int k = 0; k < 20; ++k)
    EXPECT_LT((kriging.at(places.row(k).transpose()) - fields.row(k).transpose())
                  .lpNorm<Eigen::Infinity>(),
              1e-4);
}

// Values without any relation to the settings cannot be predicted from others.
TEST(FieldKriging, RoughFieldsHaveALowQ2) {
  const Eigen::MatrixXd places = spread_places(40, 2);
  Eigen::MatrixXd fields(40, 1);
  RandomStream random(7, 1);
  for (double& one : fields.reshaped()) one = random.normal();
  EXPECT_LT(FieldKriging(places, fields).Q2()[0], 0.3);
}

TEST(FieldKriging, AConstantFieldHasAQ2OfOne) {
  const Eigen::MatrixXd places = spread_places(12, 2);
  Eigen::MatrixXd fields(12, 2);
  for (int k = 0; k < 12; ++k) fields.row(k) << 7.0, places(k, 0);
  const FieldKriging kriging(places, fields);
  EXPECT_EQ(kriging.Q2()[0], 1.0);
  EXPECT_NEAR(kriging.at(Eigen::Vector2d(0.3, 0.4))[0], 7.0, 1e-4);
}

}  // namespace
}  // namespace latsch
