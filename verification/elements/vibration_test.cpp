// SPDX-License-Identifier: Apache-2.0
// Vibration of rings and cylinders, computed from one sector for each circumferential harmonic.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <numbers>

#include "models/fe_tire/ring/ring.h"
#include "models/fe_tire/ring/sector.h"
#include "numerics/dense/self_adjoint_eigen.h"
#include "small_model.h"

namespace latsch::verification {
namespace {

struct Hoop {
  double radius, thickness, width;  // m; radius to the middle of the wall
  double E = 2e11, nu = 0.3, density = 8000.0;
  // numbers of elements around, along the axis and through the wall
  int sectors = 60, along = 1, through = 1;
};

Mesh mesh_of(const Hoop& hoop) {
  Mesh mesh;
  mesh.sectors = hoop.sectors;
  mesh.region_names = {"hoop"};
  const int rows = hoop.through + 1, n = (hoop.along + 1) * rows;
  mesh.X.resize(3, n);
  const auto node = [&](int j, int k) { return j * rows + k; };
  for (int j = 0; j <= hoop.along; ++j) {
    for (int k = 0; k < rows; ++k) {
      mesh.X.col(node(j, k)) << 0.0, hoop.width * (0.5 - double(j) / hoop.along),
          -hoop.radius + hoop.thickness * (0.5 - double(k) / hoop.through);
    }
  }
  for (int j = 0; j < hoop.along; ++j) {
    for (int k = 0; k < hoop.through; ++k) {
      Element e;
      for (int top = 0; top < 2; ++top) {
        e.node[4 * top] = node(j, k + top);
        e.node[4 * top + 1] = node(j, k + top) + n;
        e.node[4 * top + 2] = node(j + 1, k + top) + n;
        e.node[4 * top + 3] = node(j + 1, k + top);
      }
      mesh.elements.push_back(e);
    }
  }
  return mesh;
}

Eigen::MatrixXcd dense(const numerics::BandedHermitian& A) {
  Eigen::MatrixXcd D = Eigen::MatrixXcd::Zero(A.size(), A.size());
  for (int j = 0; j < A.size(); ++j) {
    for (int i = j; i < std::min(A.size(), j + A.bandwidth() + 1); ++i) {
      D(i, j) = A(i, j);
      D(j, i) = std::conj(A(i, j));
    }
  }
  return D;
}

/// Returns all frequencies, Hz, of the free ring with n waves around the circumference, ascending,
/// without rigid motions.
std::vector<double> frequencies(const Hoop& hoop, int n, ElementKind kind) {
  const Ring ring(mesh_of(hoop), kind);
  const double G = hoop.E / (2.0 * (1.0 + hoop.nu));
  const double lambda = hoop.E * hoop.nu / ((1.0 + hoop.nu) * (1.0 - 2.0 * hoop.nu));
  Materials materials;
  materials.solids = {{StVenantKirchhoff::isotropic(G, lambda), hoop.density}};
  Eigen::VectorXd alpha =
      Eigen::VectorXd::Zero(ring.alphas_per_element() * ring.elements_per_sector() + 1);
  Eigen::VectorXd f;
  const RingElements elements(ring, materials);
  SectorBlocks K(ring);
  int worst = -1;
  EXPECT_TRUE(assemble_sector(
      elements, Eigen::VectorXd::Zero(ring.sector_unknowns()), 0.0, alpha, f, &K, &worst));
  const SectorBlocks M = sector_mass(elements);
  std::vector<double> found;
  for (double square :
       numerics::generalized_eigenvalues(dense(K.harmonic(n)), dense(M.harmonic(n)))) {
    const double frequency = std::sqrt(std::max(square, 0.0)) / (2.0 * std::numbers::pi);
    if (frequency > 0.5) found.push_back(frequency);
  }
  return found;
}

double nearest(const std::vector<double>& values, double to) {
  return *std::min_element(values.begin(), values.end(), [&](double a, double b) {
    return std::abs(a - to) < std::abs(b - to);
  });
}

// The closed form is that of inextensional bending of a free ring [Love 1927, section 293]:
//   omega = n (n^2 - 1) / sqrt(n^2 + 1) sqrt(E I / (rho A)) / R^2
// The ring is thin (t / R = 1/200) and narrow (width = 2 t). The error of the elements is of second
// order in their length. The value extrapolated from 60 and 120 elements around, with one through
// the thickness, is within 0.7 % (the closed form has no shear and no anticlastic stiffening). The
// element of full integration is wrong by more than a factor of 2.
TEST(Ring, InextensionalModes) {
  Hoop hoop{.radius = 0.3, .thickness = 0.0015, .width = 0.003};
  const double t = hoop.thickness, R = hoop.radius;
  for (int n = 2; n <= 6; ++n) {
    const double omega = n * (n * n - 1.0) / std::sqrt(n * n + 1.0) *
                         std::sqrt(hoop.E * t * t / (12.0 * hoop.density)) / (R * R);
    const double expected = omega / (2.0 * std::numbers::pi);
    hoop.sectors = 60;
    const double coarse = nearest(frequencies(hoop, n, ElementKind::solid_shell), expected);
    EXPECT_GT(frequencies(hoop, n, ElementKind::full_integration)[0], 2.0 * expected)
        << "n = " << n;
    hoop.sectors = 120;
    const double fine = nearest(frequencies(hoop, n, ElementKind::solid_shell), expected);
    EXPECT_NEAR((4.0 * fine - coarse) / 3.0 / expected, 1.0, 0.007) << "n = " << n;
    EXPECT_LT(coarse / expected, 1.06) << "n = " << n;
  }
}

// Extensional waves around a thin ring have omega = sqrt(E / rho) sqrt(n^2 + 1) / R [Love 1927,
// section 293]. The mean of the consistent and the lumped mass matrix leaves a fourth-order error,
// below 0.3 % with 10 elements for each wave; either matrix alone is 1.6 % off.
TEST(Ring, WavesAlongTheRingHaveFourthOrderDispersion) {
  Hoop hoop{.radius = 0.3, .thickness = 0.0015, .width = 0.003};
  const int n = 6;
  const double expected = std::sqrt(hoop.E / hoop.density) * std::sqrt(n * n + 1.0) / hoop.radius /
                          (2.0 * std::numbers::pi);
  const double found = nearest(frequencies(hoop, n, ElementKind::solid_shell), expected);
  EXPECT_NEAR(found / expected, 1.0, 0.003);
}

// NAFEMS FV41, free cylinder, axisymmetric vibration [NAFEMS R0015, 1989]: length 10 m, mean radius
// 2 m, thickness 0.4 m, E = 200 GPa, nu = 0.3, 8000 kg/m^3. The reference values are closed forms
// of shell theory; the tolerance is 1 % for a wall of t / R = 1/5. Between them are the torsional
// modes, which NAFEMS does not list: k/(2 L) sqrt(G/rho), exact for any wall. Both together are all
// axisymmetric modes, in this order.
TEST(Fv41, FreeCylinderAxisymmetric) {
  const Hoop cylinder{
      .radius = 2.0, .thickness = 0.4, .width = 10.0, .sectors = 120, .along = 32, .through = 2};
  const double G = cylinder.E / (2.0 * (1.0 + cylinder.nu));
  const double torsion = std::sqrt(G / cylinder.density) / (2.0 * cylinder.width);
  const double expected[] = {torsion, 243.53, 2.0 * torsion, 377.41, 394.11, 397.72, 405.28};
  const std::vector<double> found = frequencies(cylinder, 0, ElementKind::solid_shell);
  ASSERT_GE(found.size(), std::size(expected));
  for (std::size_t i = 0; i < std::size(expected); ++i)
    EXPECT_NEAR(found[i], expected[i], 0.01 * expected[i]) << i;
}

}  // namespace
}  // namespace latsch::verification
