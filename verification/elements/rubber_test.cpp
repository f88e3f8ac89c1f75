// SPDX-License-Identifier: Apache-2.0
// Incompressible neo-Hooke rubber under internal pressure, with inner radius A = 1, outer radius B
// = 2, and inner radius a after inflation; b^2 = a^2 + B^2 - A^2 and b^3 = a^3 + B^3 - A^3.
//   p = int_a^b (sigma_theta - sigma_r) d r / r       (cylinder; twice that for the sphere)
//   cylinder, plane strain:  sigma_theta - sigma_r = mu (lambda^2 - lambda^-2)
//   sphere:                  sigma_theta - sigma_r = mu (lambda^2 - lambda^-4),  lambda = r / R
// [Ogden 1984] Non-Linear Elastic Deformations, section 5.3. The values below are those integrals.
// The model is one column of elements along the radius whose nodes move along their rays, which by
// symmetry represents the whole body. Bulk modulus 1e5 mu; 40 elements, 2 degrees: the error is
// within 0.2 %, the tolerance 0.5 %.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "models/fe_tire/element/pressure.h"
#include "small_model.h"

namespace latsch::verification {
namespace {

constexpr int kLayers = 40;
constexpr double kHalfAngle = std::numbers::pi / 180.0;

/// Returns the internal pressure over the shear modulus mu at which the inner surface of a hollow
/// sphere or cylinder has the radius `a`.
double pressure_of(bool sphere, double a, ElementKind kind) {
  const Grid grid{1, 1, kLayers};
  const auto ray = [&](int i, int j) {
    const double s = std::tan(kHalfAngle) * (2 * i - 1), t = std::tan(kHalfAngle) * (2 * j - 1);
    return sphere ? Eigen::Vector3d(Eigen::Vector3d(s, -t, -1.0).normalized())
                  : Eigen::Vector3d(Eigen::Vector3d(s, 0.0, -1.0).normalized());
  };
  const Eigen::Vector3d along(0.0, sphere ? 0.0 : 0.02, 0.0);  // along the length of the cylinder
  Materials materials;
  materials.solids = {{Hyperelastic{.C10 = 0.5, .C01 = 0.0, .K = 1e5}, 1.0}};
  SmallModel model(
      grid,
      [&](int i, int j, int k) -> Eigen::Vector3d {
        return ray(i, j) * (1.0 + double(k) / kLayers) - j * along;
      },
      kind,
      materials);
  // The only unknown of each layer is its radial displacement w.
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(model.unknowns(), kLayers + 1);
  for (int k = 0; k <= kLayers; ++k) {
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) T.block<3, 1>(3 * grid.node(i, j, k), k) = ray(i, j);
    }
  }
  Eigen::VectorXd w(kLayers + 1);
  Eigen::VectorXd f;
  constexpr int kSteps = 10;
  for (int step = 1; step <= kSteps; ++step) {
    const double inner = 1.0 + (a - 1.0) * step / kSteps;
    const double power = sphere ? 3.0 : 2.0;
    for (int k = 0; k <= kLayers; ++k) {  // the start is the solution for incompressible rubber
      const double R = 1.0 + double(k) / kLayers;
      w[k] = std::pow(std::pow(R, power) + std::pow(inner, power) - 1.0, 1.0 / power) - R;
    }
    for (int iteration = 0; iteration < 20; ++iteration) {
      Eigen::MatrixXd K;
      f = T.transpose() * model.forces(T * w, &K);
      EXPECT_TRUE(f.allFinite());
      if (f.tail(kLayers).norm() < 1e-11 * std::abs(f[0])) break;
      const Eigen::MatrixXd k = T.transpose() * K * T;
      w.tail(kLayers) -=
          k.bottomRightCorner(kLayers, kLayers).partialPivLu().solve(f.tail(kLayers));
    }
  }
  Matrix34 x;
  const int node[4] = {
      grid.node(0, 0, 0), grid.node(1, 0, 0), grid.node(1, 1, 0), grid.node(0, 1, 0)};
  const Eigen::VectorXd u = T * w;
  for (int b = 0; b < 4; ++b) x.col(b) = model.X().col(node[b]) + u.segment<3>(3 * node[b]);
  Vector12 unit = Vector12::Zero();
  add_pressure(x, 1.0, unit, nullptr);
  double work = 0.0;
  for (int b = 0; b < 4; ++b) work += unit.segment<3>(3 * b).dot(T.block<3, 1>(3 * node[b], 0));
  return -f[0] / work;
}

struct Row {
  double a, cylinder, sphere;
};
constexpr Row kRows[] = {{1.1, 0.131562, 0.287155},
                         {1.25, 0.275712, 0.551869},
                         {1.5, 0.428228, 0.755433},
                         {2.0, 0.574054, 0.806927}};

TEST(Inflation, ThickCylinder) {
  for (const Row& row : kRows) {
    const double found = pressure_of(false, row.a, ElementKind::solid_shell);
    EXPECT_NEAR(found, row.cylinder, 0.005 * row.cylinder) << row.a;
  }
}

TEST(Inflation, ThickSphere) {
  for (const Row& row : kRows) {
    const double found = pressure_of(true, row.a, ElementKind::solid_shell);
    EXPECT_NEAR(found, row.sphere, 0.005 * row.sphere) << row.a;
  }
}

// The element of full integration locks here, so it is shown for comparison only.
TEST(Inflation, PlainElementLocks) {
  EXPECT_GT(pressure_of(false, 1.1, ElementKind::full_integration), 2.0 * kRows[0].cylinder);
}

}  // namespace
}  // namespace latsch::verification
