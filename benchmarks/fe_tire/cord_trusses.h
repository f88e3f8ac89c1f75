// SPDX-License-Identifier: Apache-2.0
// The cord layers of a mesh as trusses or springs of a CalculiX deck: an oracle for rebars.
//
// In every element that holds a layer, cords are drawn on the layer's facet one by one, at the
// layer's angle to the circumference; each stands for the strip half way to its neighbors, with the
// layer's thickness times the width of the strip as its area. What of a cord lies in an element is
// a chain of pieces whose ends are tied to the element's eight corners by linear equations
// (*EQUATION), wherever in the element they are: the solids keep their own nodes and the cords
// follow them. Nothing of it comes from the rebar element but the layer's place and angle. What the
// number of cords and pieces leaves falls with its square.
//
// A piece is a spring between its ends (SPRINGA) that pulls as the cord does, force over elongation
// from the law of cord_law.h where both moduli are the same, A E (lambda^2 - 1) / 2 lambda; or a
// truss (T3D2), which CalculiX expands to a brick of that area with hinges at its ends and the same
// law. Both stretch a tire alike, but a truss takes 25 unknowns more and the bricks turn about
// their hinges: modes of a tire full of them are those of its trusses (cords_bench.cpp has
// figures). So springs are what is compared, without mass.
//   [G. Dhondt, CalculiX CrunchiX User's Manual: "Two-node truss element (T3D2)", "*SPRING"]
#pragma once

#include <string>

#include "models/fe_tire/element/materials.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::benchmarks {

enum class CordPiece { spring, truss };

struct CordFamily {
  int a_sector = 2;  // cords that cross the middle of a sector's width; hoops have `along` instead
  int along = 4;     // pieces of a cord, or hoops, along the section in an element
  CordPiece piece = CordPiece::spring;
};

struct CordTrusses {
  std::string cards;    // of the model, before its boundary conditions (mm, N, tonne, s)
  int count = 0;        // of pieces
  double volume = 0.0;  // m^3 of cord, the whole ring
};

/// Numbers of nodes and elements begin where those of the mesh and its ground end. Elements must
/// have no tied corners, layers the same modulus in compression as in tension, no pretension and
/// angles of 0 or beyond a few degrees.
CordTrusses cord_trusses(const fe_tire::Mesh& mesh,
                         const fe_tire::Materials& materials,
                         const CordFamily& family);

}  // namespace latsch::benchmarks
