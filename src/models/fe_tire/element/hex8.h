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
  full_integration,  // 2x2x2 displacement element, CalculiX' C3D8: for comparison, because it locks
  solid_shell,       // the default, with assumed and enhanced strains: hex8_solid_shell_kernel.h
};

/// Quantities of an element that do not change with the displacement: gradients, weights, strain
/// operators. Built once per mesh for every element of a sector.
struct HexShape;  // hex8_shape.h, a plain value of fixed size
/// Takes the reference coordinates [3 x 8], m, of the element's corners. `wall`: Element::wall.
HexShape make_shape(ElementKind kind, const Matrix38& X, double wall = 0.0);

/// Number of enhanced strain parameters that an element kind stores between evaluations. They are
/// only a starting point of the inner solution, not a history.
int internal_parameters(ElementKind kind);

/// Computes internal forces f = dW/du and, if K is not null, the symmetric tangent K = d2W/du2 of
/// one element with displacement u (sector frame, m). W includes rebars. alpha:
/// internal_parameters(kind) numbers, solved from the values given; f and K are condensed. Returns
/// false if an integration point is inverted or the inner solution fails; f and K are then void.
bool evaluate(const HexShape& shape,
              const Materials& materials,
              const Element& element,
              const Matrix38& u,
              double* alpha,
              Vector24& f,
              Matrix24* K);

/// Assigns the corners of a tied element to its nodes: a matrix [8 x 8] between corners becomes one
/// between nodes. Without a tie it stays.
Matrix8 between_nodes(const Element& element, const Matrix8& between_corners);

/// Returns the mass [kg] between nodes, the same in all three directions, rebars included. It is
/// consistent for full_integration, and the average of consistent and lumped along the wall for the
/// solid-shell.
Matrix8 mass(const HexShape& shape, const Materials& materials, const Element& element);

}  // namespace latsch::fe_tire
