// SPDX-License-Identifier: Apache-2.0
// Strains at points against the forces of the elements: the energy of the strains, summed over the
// points, has the elements' forces as its gradient.
#include "models/fe_tire/history/point_strains.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "models/fe_tire/element/cord_law.h"
#include "models/fe_tire/element/hex8_batch.h"
#include "models/fe_tire/element/hyperelastic.h"

namespace latsch::fe_tire {
namespace {

/// A curved element, 30 x 14 x 5 mm, whose corners are moved a little.
Matrix38 curved_element() {
  Matrix38 X;
  for (int a = 0; a < 8; ++a) {
    const double theta = 0.05 * kXi[a], r = 0.300 + 0.0025 * kZeta[a];
    X.col(a) << r * std::sin(theta), 0.02 - 0.007 * kEta[a], -r * std::cos(theta);
    for (int i = 0; i < 3; ++i) X(i, a) += 3e-4 * std::sin(7.0 * a + 3.0 * i);
  }
  return X;
}

Matrix38 some_displacements() {
  Matrix38 u;
  for (int a = 0; a < 8; ++a) {
    for (int i = 0; i < 3; ++i) u(i, a) = 2e-4 * std::sin(5.0 * a + 2.0 * i + 1.0);
  }
  return u;
}

Materials materials() {
  Materials m;
  m.solids.push_back({Hyperelastic{.C10 = 0.8e6, .C01 = 0.2e6, .K = 40e6}, 1150.0});
  m.layers.push_back({.E_tension = 2e9, .E_compression = 2e8, .thickness = 1e-3, .angle = 0.4});
  return m;
}

/// Energy of a cord layer's law: S integrated by Simpson's rule over small parts.
double cord_energy(const CordLayer& layer, double e) {
  constexpr int kParts = 400;
  double sum = 0.0;
  for (int k = 0; k < kParts; ++k) {
    const double a = e * k / kParts, b = e * (k + 1) / kParts;
    sum += (b - a) / 6.0 *
           (stress(layer, a).S + 4.0 * stress(layer, 0.5 * (a + b)).S + stress(layer, b).S);
  }
  return sum;
}

double energy_of(const ElementLaw& law, const Matrix38& u, const double* alpha) {
  const PointStrains strains = point_strains(law, u, alpha);
  double W = 0.0;
  for (int q = 0; q < 8; ++q) W += law.shape->dV[q] * energy(law.rubber, Vector6(strains.E.col(q)));
  for (std::size_t k = 0; k < law.cords.size(); ++k) {
    for (int q = 0; q < 4; ++q)
      W += law.cords[k].points[q].dV * cord_energy(law.cords[k].layer, strains.cords[k][q]);
  }
  return W;
}

class PointStrainsOf : public testing::TestWithParam<ElementKind> {};

TEST_P(PointStrainsOf, HaveTheElementsForcesAsGradientOfTheirEnergy) {
  const HexShape shape = make_shape(GetParam(), curved_element());
  for (const bool is_tied : {false, true}) {
    Element element;
    element.rebars = {{0, 0.3}};
    if (is_tied) element.tie = {1, 0.0, 0.5};
    const ElementLaw law = element_law(shape, materials(), element);
    const Matrix38 u = some_displacements();
    double alpha[8] = {};
    Vector24 f;
    ASSERT_TRUE(evaluate(shape, materials(), element, u, alpha, f, nullptr));
    // alpha solves its equations, so the energy's change with u at constant alpha is f.
    for (int k = 0; k < 24; ++k) {
      const double step = 1e-7;
      Matrix38 above = u, below = u;
      above(k % 3, k / 3) += step;
      below(k % 3, k / 3) -= step;
      const double slope =
          (energy_of(law, above, alpha) - energy_of(law, below, alpha)) / (2 * step);
      EXPECT_NEAR(slope, f[k], 1e-5 * f.cwiseAbs().maxCoeff()) << k << " tied " << is_tied;
    }
  }
}

TEST_P(PointStrainsOf, DoNotChangeIfTheElementTurns) {
  const HexShape shape = make_shape(GetParam(), curved_element());
  Element element;
  element.rebars = {{0, 0.3}};
  const ElementLaw law = element_law(shape, materials(), element);
  const Matrix38 u = some_displacements();
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  const Matrix38 turned = R * (shape.X + u) - shape.X;
  const double alpha[8] = {1e-3, -2e-3};
  const PointStrains a = point_strains(law, u, alpha), b = point_strains(law, turned, alpha);
  EXPECT_LT((a.E - b.E).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((a.cords[0] - b.cords[0]).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_GT(a.E.cwiseAbs().maxCoeff(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         PointStrainsOf,
                         testing::Values(ElementKind::full_integration, ElementKind::solid_shell));

TEST(IsochoricStress, IsThatOfAPureChangeOfShape) {
  // In a small strain both laws give twice the shear modulus times the deviator.
  const Hyperelastic rubber{.C10 = 0.8e6, .C01 = 0.2e6, .K = 40e6};
  Vector6 E;
  E << 2e-6, -1e-6, 4e-6, 3e-6, -2e-6, 1e-6;
  const Vector6 linear = isochoric_stress(2e6, E);
  EXPECT_LT((isochoric_stress(rubber, E) - linear).norm(), 1e-4 * linear.norm());
  EXPECT_NEAR(linear.head<3>().sum(), 0.0, 1e-9);
  // A dilation has none.
  Vector6 dilation = Vector6::Zero();
  dilation.head<3>().setConstant(0.02);
  EXPECT_LT(isochoric_stress(rubber, dilation).norm(), 1e-6);
}

}  // namespace
}  // namespace latsch::fe_tire
