// SPDX-License-Identifier: Apache-2.0
// The eight-node element: forces, stiffness and mass of one element, total Lagrangian.
#pragma once

#include <Eigen/Core>
#include <array>

#include "models/fe_tire/element/materials.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::fe_tire {

using Matrix38 = Eigen::Matrix<double, 3, 8>;
using Vector24 = Eigen::Matrix<double, 24, 1>;  // dof 3 a + i: node a, direction i
using Matrix24 = Eigen::Matrix<double, 24, 24>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

enum class ElementKind {
  full_integration,  // 2x2x2 displacement element, CalculiX' C3D8: for comparison, it locks
  solid_shell,       // the default: assumed and enhanced strains, see
                     // hex8_solid_shell_kernel.h
};

/// Everything about an element that does not change with the displacement: gradients, weights,
/// strain operators. Built once a mesh for every element of a sector.
struct HexShape;  // hex8_shape.h, a plain value of fixed size
/// From the reference coordinates [3 x 8], m, of the element's corners; `wall`: Element::wall.
HexShape make_shape(ElementKind kind, const Matrix38& X, double wall = 0.0);

/// Enhanced strain parameters an element kind keeps between evaluations (a warm start only, not
/// history).
int internal_parameters(ElementKind kind);

/// Internal forces f = dW/du and, where K is given, the symmetric tangent K = d2W/du2 of one
/// element of displacement u (sector frame, m); W includes rebars. alpha: internal_parameters(kind)
/// numbers, solved inside from the values given and returned condensed. False where an integration
/// point is inverted or the inner solution fails; f, K then void.
bool evaluate(const HexShape& shape,
              const Materials& materials,
              const Element& element,
              const Matrix38& u,
              double* alpha,
              Vector24& f,
              Matrix24* K);

/// Mass [kg] between nodes, the same in all three directions, rebars included; consistent for
/// full_integration, the average of consistent and lumped along the wall for the solid-shell.
Matrix8 mass(const HexShape& shape, const Materials& materials, const Element& element);

}  // namespace latsch::fe_tire
