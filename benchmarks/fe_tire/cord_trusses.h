// SPDX-License-Identifier: Apache-2.0
// The cord layers of a mesh as trusses or springs of a CalculiX deck: a reference for rebars.
//
// In every element with a layer, cords are placed on the layer's facet one by one, at the layer's
// angle to the circumference. Each cord represents the strip halfway to its neighbors; its area is
// the layer's thickness times the width of the strip. The part of a cord in an element is a chain
// of pieces whose ends are tied to the element's eight corners by linear equations (*EQUATION),
// wherever in the element they are: the solids keep their own nodes and the cords follow them. Only
// the layer's position and angle are shared with the rebar element. The error caused by the number
// of cords and pieces falls with its square.
//
// A piece is either a spring between its ends (SPRINGA) with the cord's force over elongation by
// the law of cord_law.h for equal moduli, A E (lambda^2 - 1) / 2 lambda, or a truss (T3D2).
// CalculiX expands a truss to a brick of that area with hinges at its ends and the same law. Both
// stretch a tire equally, but a truss needs 25 more unknowns, and the bricks rotate about their
// hinges: the modes of a tire full of trusses are those of its trusses (figures in
// cords_bench.cpp). So the comparison uses springs, without mass.
//   [G. Dhondt, CalculiX CrunchiX User's Manual: "Two-node truss element (T3D2)", "*SPRING"]
#pragma once

#include <string>

#include "models/fe_tire/mesh/materials.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::benchmarks {

enum class CordPiece { spring, truss };

struct CordFamily {
  int a_sector = 2;  // number of cords across a sector's width, at mid-length; hoops use `along`
  int along = 4;     // number of pieces of a cord, or of hoops, in an element along the section
  CordPiece piece = CordPiece::spring;
};

struct CordTrusses {
  std::string cards;    // cards of the model, before its boundary conditions (mm, N, tonne, s)
  int count = 0;        // number of pieces
  double volume = 0.0;  // m^3, volume of all cords in the whole ring
};

/// Creates the cords as trusses or springs. Their node and element numbers begin after those of the
/// mesh and its ground. Elements must have no tied corners; layers must have equal moduli in
/// compression and tension, no pretension, and angles of 0 or of more than a few degrees.
CordTrusses cord_trusses(const fe_tire::Mesh& mesh,
                         const fe_tire::Materials& materials,
                         const CordFamily& family);

}  // namespace latsch::benchmarks
