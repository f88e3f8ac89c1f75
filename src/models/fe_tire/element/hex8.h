// SPDX-License-Identifier: Apache-2.0
// Forces, stiffness and mass of one eight-node element, in the total Lagrangian formulation.
#pragma once

#include <Eigen/Core>
#include <array>

#include "models/fe_tire/mesh/materials.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::fe_tire {

using Matrix38 = Eigen::Matrix<double, 3, 8>;
// Order of components: 3 a + i for node a and direction i.
using Vector24 = Eigen::Matrix<double, 24, 1>;
using Matrix24 = Eigen::Matrix<double, 24, 24>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

enum class ElementKind {
  // Displacement element with 2x2x2 Gauss points, as C3D8 of CalculiX; for comparison, because it
  // locks.
  full_integration,
  solid_shell,  // the default, with assumed and enhanced strains: hex8_solid_shell_kernel.h
};

/// Quantities of an element that do not depend on the displacement: gradients, weights, strain
/// operators. They are computed once per mesh for every element of a sector.
struct HexShape;  // defined in hex8_shape.h; a plain value of fixed size
/// Computes the shape from the coordinates [3 x 8], m, of the element's corners without load.
/// `wall`: thickness of the wall, see Element::wall.
HexShape make_shape(ElementKind kind, const Matrix38& X, double wall = 0.0);
/// Computes the shape of a solid-shell in a sector of a ring, whose edges along xi count as arcs
/// around the spin axis (hex8_shape.cpp). Corners with xi = +1 are those with xi = -1, turned by
/// 2 h rad about the spin axis; X [3 x 8], m, is in the frame of the plane xi = -1.
HexShape make_arc_shape(const Matrix38& X, double h, double wall);

/// Returns the number of enhanced strain parameters that an element of this kind stores between
/// evaluations. They are only the starting point of an inner iteration, not a history of the
/// material.
int internal_parameters(ElementKind kind);

/// Computes internal forces f = dW/du and, if K is not null, the symmetric tangent K = d2W/du2 of
/// one element with displacement u (sector frame, m). W includes rebars. alpha:
/// internal_parameters(kind) enhanced strain parameters, solved by iteration from the given values;
/// they are condensed out of f and K. Returns false if an integration point is inverted or the
/// inner solution fails; f and K are then void.
bool evaluate(const HexShape& shape,
              const Materials& materials,
              const Element& element,
              const Matrix38& u,
              double* alpha,
              Vector24& f,
              Matrix24* K);

/// Converts a matrix [8 x 8] between the corners of an element to one between its nodes. Both are
/// equal unless the element is tied.
Matrix8 between_nodes(const Element& element, const Matrix8& between_corners);

/// Returns the mass matrix [kg] between nodes, with rebars. It is the same for all three
/// directions. For full_integration it is consistent; for the solid-shell it is, along the wall,
/// the mean of the consistent and the lumped one.
Matrix8 mass(const HexShape& shape, const Materials& materials, const Element& element);

}  // namespace latsch::fe_tire
