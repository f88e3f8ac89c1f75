// SPDX-License-Identifier: Apache-2.0
// What an element computes once from its reference coordinates.
//
// Parent cube (xi, eta, zeta) in [-1, 1]^3, nodes in the order of mesh.h, 2x2x2 Gauss points of
// weight 1. At every Gauss point the cylindrical triad of the spin axis (radial, circumferential,
// axial; see materials.h) is the basis in which strain and stress are written.
#pragma once

#include <Eigen/Core>
#include <array>

#include "models/fe_tire/hex8.h"

namespace latsch::fe_tire {

inline constexpr double kGauss = 0.57735026918962576451;  // 1 / sqrt(3)
/// Signs of a node's parent coordinates; the Gauss points have the same order, at kGauss times
/// these.
inline constexpr double kXi[8] = {-1, 1, 1, -1, -1, 1, 1, -1};
inline constexpr double kEta[8] = {-1, -1, 1, 1, -1, -1, 1, 1};
inline constexpr double kZeta[8] = {-1, -1, -1, -1, 1, 1, 1, 1};

using Vector8 = Eigen::Matrix<double, 8, 1>;

struct HexShape {
  ElementKind kind = ElementKind::full_integration;
  Matrix38 X;  // m
  std::array<double, 8>
      dV;  // m^3, volume of a Gauss point; not positive where the element is inverted
  std::array<Matrix38, 8>
      dN;  // 1/m, gradients of the shape functions in the triad of the Gauss point
};

/// Shape functions at a point of the parent cube.
Vector8 shape_functions(double xi, double eta, double zeta);
/// Their derivatives by xi, eta, zeta (rows).
Matrix38 parent_gradients(double xi, double eta, double zeta);
/// Columns radial, circumferential, axial at X; on the spin axis itself, where there is none, that
/// of the bottom.
Eigen::Matrix3d cylindrical_triad(const Eigen::Vector3d& X);

}  // namespace latsch::fe_tire
