// SPDX-License-Identifier: Apache-2.0
// Strains at the points of an element in a known state: those of the solid at its eight Gauss
// points and those of every cord layer at its four. They are the strains from which the kernels
// compute forces (hex8_solid_shell_kernel.h, hex8_full_integration_kernel.h, hex8_rebar.cpp).
//
// Axes of the solid's strains are the cylindrical axes of the point: radial, circumferential,
// axial (materials.h). They turn with the sectors, so the strains of a tire that is the same all
// around are the same in all sectors.
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "models/fe_tire/element/element_law.h"

namespace latsch::fe_tire {

/// Pairs of Gauss points of an element that lie on one streamline; the first two are those of a
/// cord layer, too.
inline constexpr std::array<std::pair<int, int>, 4> kOnLine = {{{0, 1}, {3, 2}, {4, 5}, {7, 6}}};

/// Green-Lagrange strains at the points of an element.
struct PointStrains {
  Eigen::Matrix<double, 6, 8> E;       // Voigt order of materials.h, engineering shear
  std::vector<Eigen::Vector4d> cords;  // along the cords, layer after layer
};

/// Returns the strains of an element. `u`: displacements of its nodes in the frame of its sector,
/// m. `alpha`: its enhanced strain parameters, solved for this u; unused if the element has none.
PointStrains point_strains(const ElementLaw& law, Matrix38 u, const double* alpha);

/// Returns the isochoric part of the second Piola-Kirchhoff stress at a strain, Pa: the stress of
/// rubber without its bulk modulus.
Vector6 isochoric_stress(const Hyperelastic& law, const Vector6& E);
/// Returns the isochoric stress of a linear solid, 2 G times the deviator of the strain, Pa. G is
/// its shear modulus, Pa.
Vector6 isochoric_stress(double G, const Vector6& E);

}  // namespace latsch::fe_tire
