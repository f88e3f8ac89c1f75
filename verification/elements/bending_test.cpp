// SPDX-License-Identifier: Apache-2.0
// Bending of Cook's tapered membrane and of a slender cantilever, for which the element without
// enhancement locks.
#include <gtest/gtest.h>

#include <cmath>

#include "numerics/dense/cholesky.h"
#include "small_model.h"

namespace latsch::verification {
namespace {

Materials linear(double E, double nu) {
  const double G = E / (2.0 * (1.0 + nu)), lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  Materials materials;
  materials.solids = {{StVenantKirchhoff::isotropic(G, lambda), 1.0}};
  return materials;
}

/// Returns the displacements of the linear problem under the load.
Eigen::VectorXd solve_linear(SmallModel& model,
                             const std::vector<char>& held,
                             const Eigen::VectorXd& load) {
  Eigen::MatrixXd K;
  model.forces(Eigen::VectorXd::Zero(model.unknowns()), &K);
  for (int i = 0; i < model.unknowns(); ++i) {
    if (!held[i]) continue;
    K.row(i).setZero();
    K.col(i).setZero();
    K(i, i) = 1.0;
  }
  return numerics::PivotedCholesky(K).solve(load);
}

/// Returns the vertical displacement at the middle of the free edge of Cook's membrane: plane
/// stress, E = 1, nu = 1/3, thickness 1, shear load 1 on the free edge.
double cook(int n, ElementKind kind) {
  const Grid grid{n, n, 1};
  SmallModel model(
      grid,
      [&](int i, int j, int k) {
        const double x = 48.0 * i / n, low = 44.0 / 48.0 * x, high = 44.0 + 16.0 / 48.0 * x;
        return Eigen::Vector3d(x, low + (high - low) * j / n, k - 200.0);
      },
      kind,
      linear(1.0, 1.0 / 3.0));
  std::vector<char> held(model.unknowns(), 0);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(model.unknowns());
  for (int j = 0; j <= n; ++j) {
    for (int k = 0; k < 2; ++k) {
      for (int c = 0; c < 2; ++c) held[3 * grid.node(0, j, k) + c] = 1;
      load[3 * grid.node(n, j, k) + 1] = (j == 0 || j == n ? 0.25 : 0.5) / n;
    }
  }
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) held[3 * grid.node(i, j, 0) + 2] = 1;
  }
  return solve_linear(model, held, load)[3 * grid.node(n, n / 2, 0) + 1];
}

// The reference is 23.96 [Simo & Rifai 1990, section 5.2 after Cook 1974]. The default element is
// within 7 % on 4x4 and within 1 % on 16x16 elements; the element of full integration is more than
// 20 % off on 4x4.
TEST(Bending, CooksMembrane) {
  EXPECT_NEAR(cook(4, ElementKind::solid_shell), 23.96, 0.07 * 23.96);
  EXPECT_NEAR(cook(16, ElementKind::solid_shell), 23.96, 0.01 * 23.96);
  EXPECT_LT(cook(4, ElementKind::full_integration), 0.8 * 23.96);
}

/// Returns the tip deflection of a cantilever 100 x 10 x t under a unit load, divided by that of
/// beam theory with shear.
double cantilever(int n, double t, double nu, ElementKind kind) {
  const double L = 100.0, b = 10.0, E = 1.0;
  const Grid grid{n, 1, 1};
  SmallModel model(
      grid,
      [&](int i, int j, int k) { return Eigen::Vector3d(L * i / n, b * j, t * k - 1000.0); },
      kind,
      linear(E, nu));
  std::vector<char> held(model.unknowns(), 0);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(model.unknowns());
  for (int j = 0; j < 2; ++j) {
    for (int k = 0; k < 2; ++k) {
      // the section at the root may change its width and thickness
      held[3 * grid.node(0, j, k)] = 1;
      load[3 * grid.node(n, j, k) + 2] = 0.25;
    }
  }
  held[3 * grid.node(0, 0, 0) + 1] = held[3 * grid.node(0, 0, 0) + 2] = 1;
  held[3 * grid.node(0, 1, 0) + 2] = 1;
  const double EI = E * b * t * t * t / 12.0, G = E / (2.0 * (1.0 + nu));
  const double beam = L * L * L / (3.0 * EI) + L / (G * b * t);
  const Eigen::VectorXd u = solve_linear(model, held, load);
  return u[3 * grid.node(n, 0, 0) + 2] / beam;
}

// With n elements of constant curvature the deflection is 1 - 1/(4 n^2) times that of beam theory,
// for any slenderness and Poisson's ratio. Beam theory is Euler-Bernoulli plus Timoshenko's shear
// term. The tolerance of 2.5 % covers the three-dimensional state at the root, which is largest for
// incompressible and thin beams.
TEST(Bending, SlenderCantileverDoesNotLock) {
  for (double nu : {0.0, 0.3, 0.499}) {
    for (double t : {5.0, 1.0, 0.1}) {
      EXPECT_NEAR(cantilever(10, t, nu, ElementKind::solid_shell), 1.0 - 1.0 / 400.0, 0.025)
          << "t " << t << ", nu " << nu;
    }
  }
  EXPECT_LT(cantilever(10, 1.0, 0.3, ElementKind::full_integration), 0.1);
}

// The displacement converges with order 2 in the length of the elements.
TEST(Bending, CantileverConvergesWithSecondOrder) {
  const double finest = cantilever(64, 2.0, 0.3, ElementKind::solid_shell);
  const double coarse = finest - cantilever(4, 2.0, 0.3, ElementKind::solid_shell);
  const double fine = finest - cantilever(8, 2.0, 0.3, ElementKind::solid_shell);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

}  // namespace
}  // namespace latsch::verification
