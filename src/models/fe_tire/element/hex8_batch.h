// SPDX-License-Identifier: Apache-2.0
// Evaluates elements of the same law at different positions, eight at a time, as the sectors of a
// ring contain them. Lane k of the vector registers holds element k (hex8_lanes.h). The data of the
// element are read once for all lanes.
#pragma once

#include "models/fe_tire/element/element_law.h"

namespace latsch::fe_tire {

/// Precision of the stiffness: exact in double precision, or rough with sums in single precision.
/// Rough stiffness is used for steps of Newton's method, never for results. Comparison elements
/// always compute it exactly.
enum class Stiffness { none, exact, rough };

/// Elements of a batch.
inline constexpr int kBatchLanes = 8;

/// Stresses at the points of a batch's elements, Pa, in the axes of the points (materials.h).
struct PointStresses {
  alignas(64) double solid[8][6][kBatchLanes] = {};
  /// Stresses of the three enhanced parameters that the rubber stiffens by themselves.
  alignas(64) double gradients[3][kBatchLanes] = {};
  alignas(64) double cords[ElementLaw::kCordLayers][4][kBatchLanes] = {};
};

struct ElementBatch {
  static constexpr int kLanes = kBatchLanes;
  static constexpr int kEntries = 24 * 25 / 2;
  /// Returns the index of entry K(row, column), row >= column, in the stored lower triangle.
  /// Unknowns are numbered 3 a + i for node a and direction i.
  static constexpr int entry(int row, int column) { return row * (row + 1) / 2 + column; }

  int count = 0;                     // number of elements, in the first lanes
  alignas(64) double u[24][kLanes];  // m, displacements in the sector's frame
  // Enhanced strain parameters: starting values, then the solution.
  alignas(64) double alpha[8][kLanes];
  alignas(64) double f[24][kLanes];  // N
  /// Stresses that are added to those of the laws and do not change with the strain; null: none.
  const PointStresses* dead = nullptr;
  Stiffness stiffness = Stiffness::none;   // precision of K
  alignas(64) double K[kEntries][kLanes];  // N/m

  /// Sets the displacements of element `lane` and its first `alphas` enhanced strain parameters;
  /// the others are 0.
  void set(int lane, const Matrix38& displacements, const double* enhanced, int alphas);
  /// Copies the results of element `lane`: force, stiffness with both triangles, enhanced strain
  /// parameters.
  void take(int lane, Vector24& force, Matrix24* tangent, double* enhanced, int alphas) const;
};

/// Pressure on an element, and the frames in which the forces on its nodes are expressed.
struct ElementSurroundings {
  double pressure = 0.0;  // Pa, on the inner face
  // Edges of the inner face that are sealed; bit k: edge from node k to k + 1.
  unsigned open_edges = 0;
  /// Nodes whose forces are rotated by Q^T into the next sector's frame (bit a: node a, numbered as
  /// in mesh.h). Q is a rotation about the spin axis.
  unsigned turned = 0;
  double cosine = 1.0, sine = 0.0;  // Q(0,0) and Q(0,2)
};

/// Computes the forces and, if requested, the stiffness of every element of the batch. Returns a
/// mask with a bit for each lane that succeeded. An element fails if it is inverted or its enhanced
/// strains cannot be solved; its results are then undefined.
unsigned evaluate(const ElementLaw& law,
                  const ElementSurroundings& surroundings,
                  Stiffness stiffness,
                  ElementBatch& batch);

/// Computes what a history (history/streamlines.h) grows from, at the batch's u and alpha as they
/// are: the isochoric stress of rubber, or the strain of a linear solid, whose parts relax each by
/// itself; the stress of the law's relaxation of enhanced parameters; the stress of cords. Dead
/// stresses are not part of it. Lanes without an element are undefined.
void relaxing_stresses(const ElementLaw& law, ElementBatch& batch, PointStresses& stresses);

/// Evaluates the rubber law (rubber_law.h) at one strain, as the elements do: S and D = dS/dE in
/// Pa. Returns det C. If det C is not positive, S and D are undefined.
double rubber_stress(const Hyperelastic& law, const double* E, double* S, double (*D)[6]);

}  // namespace latsch::fe_tire
