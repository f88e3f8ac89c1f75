// SPDX-License-Identifier: Apache-2.0
// Elements of one law at different places, eight at a time: what the sectors of a ring are.
//
// The numbers that describe the element are read once for all of them, and no vector is left half
// empty: lane k is element k (hex8_lanes.h).
#pragma once

#include "models/fe_tire/element/element_law.h"

namespace latsch::fe_tire {

/// What is wanted of it: in double precision, or summed up in single, which a step of Newton's
/// method may stand on and nothing that is shown. Comparison elements have it exact always.
enum class Stiffness { none, exact, rough };

struct ElementBatch {
  static constexpr int kLanes = 8;
  static constexpr int kEntries = 24 * 25 / 2;
  /// Place of K(row, column), row >= column, of the unknowns 3 a + i.
  static constexpr int entry(int row, int column) { return row * (row + 1) / 2 + column; }

  int count = 0;                           // elements, in the first lanes
  alignas(64) double u[24][kLanes];        // m, displacements in the sector's frame
  alignas(64) double alpha[8][kLanes];     // enhanced strains, solved from the values given
  alignas(64) double f[24][kLanes];        // N
  Stiffness stiffness = Stiffness::none;   // whether and how exact K is, or is to be
  alignas(64) double K[kEntries][kLanes];  // N/m

  /// Places of element `lane`, and the first `alphas` enhanced strains, others 0.
  void set(int lane, const Matrix38& displacements, const double* enhanced, int alphas);
  /// What came out of it: f, K with both triangles, enhanced strains.
  void take(int lane, Vector24& force, Matrix24* tangent, double* enhanced, int alphas) const;
};

/// What acts on an element besides its own stress, and where its forces are wanted.
struct ElementSurroundings {
  double pressure = 0.0;    // Pa on the inner face; zero: none
  unsigned open_edges = 0;  // of that face, sealed: bit k for that from node k to k + 1
  /// Nodes whose forces are turned by Q^T into the next sector's frame (hex8.h: bit a for node a),
  /// Q a rotation about the spin axis.
  unsigned turned = 0;
  double cosine = 1.0, sine = 0.0;  // Q(0,0) and Q(0,2)
};

/// Forces and, where asked for, stiffness of every element of the batch; bits of the lanes that
/// succeeded (an element fails where it is inverted or its enhanced strains cannot be solved: its
/// numbers are then void).
unsigned evaluate(const ElementLaw& law,
                  const ElementSurroundings& surroundings,
                  Stiffness stiffness,
                  ElementBatch& batch);

/// The rubber law of the elements at one strain (rubber_law.h): S and D = dS/dE in Pa, and det C,
/// without which being positive they are void.
double rubber_stress(const Hyperelastic& law, const double* E, double* S, double (*D)[6]);

}  // namespace latsch::fe_tire
