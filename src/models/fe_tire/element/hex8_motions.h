// SPDX-License-Identifier: Apache-2.0
// Derivatives of an element's energy W(u, alpha; p) along its motions, with enhanced strains in
// equilibrium. Slopes of a tire's results with respect to its numbers p are sums of these
// (slopes/tire_slopes.h).
//
// For a mode phi and another motion zeta, with A = W_aa of the enhanced strains alpha:
//   a_phi = -A^-1 W_au phi,   a_zeta = -A^-1 W_au zeta                                        (M.1)
//   D3W[phi~, phi~, .] = (g_u, g_a),   a_2 = -A^-1 g_a,   phi~ = (phi, a_phi)                 (M.2)
//   g = g_u + W_ua a_2,   the third derivative of the energy with alpha in equilibrium        (M.3)
//   L(p) = D2W[phi~, phi~] + DW[(zeta, a_zeta + a_2)]                                         (M.4)
// with all motions held as p moves. dL/dp requires no further solution. If W is linear in p (moduli
// of rubber, cords and composites, pressure), so is L, and differences over any step are exact. By
// the 2n + 1 rule only first derivatives of alpha enter.
#pragma once

#include <span>

#include "models/fe_tire/element/hex8_batch.h"

namespace latsch::fe_tire {

/// Motions of a batch. Lane k is element k; corners are in the frame of the element.
struct ElementMotion {
  static constexpr int kLanes = ElementBatch::kLanes, kMost = 24;  // kMost: motions at a time

  bool has_mode = true;                        // false: only the second term of L is computed
  alignas(64) double mode[24][kLanes];         // phi
  alignas(64) double mode_alpha[8][kLanes];    // a_phi
  alignas(64) double second_alpha[8][kLanes];  // a_2
  alignas(64) double curvature[24][kLanes];    // g, in the frames of the nodes
  alignas(64) double along[24][kLanes];        // zeta
  alignas(64) double along_alpha[8][kLanes];   // a_zeta + a_2
};

// Lanes of the batch without an element are filled with the first element's numbers.

/// Sets a_phi, a_2 and g of the modes about the batch's state, in which alpha must be in
/// equilibrium. `surroundings` include the acting pressure. Returns false if the element has no
/// state.
bool add_curvatures(const ElementLaw& law,
                    const ElementSurroundings& surroundings,
                    ElementBatch& batch,
                    std::span<ElementMotion> motions);

/// Sets a_zeta + a_2 of the motions; for motions with a mode, a_2 must have been set before.
bool follow_along(const ElementLaw& law, ElementBatch& batch, std::span<ElementMotion> motions);

/// An element with other numbers, and the parts of its energy to be summed.
struct VariedElement {
  static constexpr unsigned kAllCords = ~0u;

  const ElementLaw* law;
  double pressure = 0.0;  // Pa on the inner face
  bool solid = true, gas = true;
  unsigned cords = kAllCords;  // bit k: layer k of the element
};

/// Computes L of every varied element (all of one section element) and motion, sums[varied *
/// motions + motion][lane].
void sum_motions(std::span<const VariedElement> varied,
                 unsigned open_edges,
                 ElementBatch& batch,
                 std::span<ElementMotion> motions,
                 double (*sums)[ElementBatch::kLanes]);

}  // namespace latsch::fe_tire
