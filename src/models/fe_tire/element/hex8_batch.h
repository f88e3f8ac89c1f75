// SPDX-License-Identifier: Apache-2.0
// Elements of one law at different positions, eight at a time, as the sectors of a ring contain
// them. Lane k is element k (hex8_lanes.h). The numbers that describe the element are read once for
// all lanes, and all lanes of a vector are used.
#pragma once

#include "models/fe_tire/element/element_law.h"

namespace latsch::fe_tire {

/// Precision of the stiffness: exact in double, rough with sums in single precision. Rough
/// stiffness serves steps of Newton's method, never results. Comparison elements are always exact.
enum class Stiffness { none, exact, rough };

struct ElementBatch {
  static constexpr int kLanes = 8;
  static constexpr int kEntries = 24 * 25 / 2;
  /// Index of K(row, column), row >= column, of the unknowns 3 a + i.
  static constexpr int entry(int row, int column) { return row * (row + 1) / 2 + column; }

  int count = 0;                           // number of elements, in the first lanes
  alignas(64) double u[24][kLanes];        // m, displacements in the sector's frame
  alignas(64) double alpha[8][kLanes];     // enhanced strains, solved from the values given
  alignas(64) double f[24][kLanes];        // N
  Stiffness stiffness = Stiffness::none;   // precision of K
  alignas(64) double K[kEntries][kLanes];  // N/m

  /// Sets displacements of element `lane` and its first `alphas` enhanced strains; others are 0.
  void set(int lane, const Matrix38& displacements, const double* enhanced, int alphas);
  /// Returns the results of element `lane`: f, K with both triangles, enhanced strains.
  void take(int lane, Vector24& force, Matrix24* tangent, double* enhanced, int alphas) const;
};

/// Load on an element besides its own stress, and the frames of its forces.
struct ElementSurroundings {
  double pressure = 0.0;    // Pa on the inner face; zero: none
  unsigned open_edges = 0;  // sealed edges of that face; bit k: from node k to k + 1
  /// Nodes whose forces are turned by Q^T into the next sector's frame (bit a: node a, numbered as
  /// in mesh.h). Q is a rotation about the spin axis.
  unsigned turned = 0;
  double cosine = 1.0, sine = 0.0;  // Q(0,0) and Q(0,2)
};

/// Computes forces and, if asked for, stiffness of every element of the batch. Returns a bit for
/// each lane that succeeded. An element fails if it is inverted or its enhanced strains cannot be
/// solved; its results are then void.
unsigned evaluate(const ElementLaw& law,
                  const ElementSurroundings& surroundings,
                  Stiffness stiffness,
                  ElementBatch& batch);

/// Rubber law of the elements at one strain (rubber_law.h): S and D = dS/dE in Pa. Returns det C.
/// If det C is not positive, S and D are void.
double rubber_stress(const Hyperelastic& law, const double* E, double* S, double (*D)[6]);

}  // namespace latsch::fe_tire
