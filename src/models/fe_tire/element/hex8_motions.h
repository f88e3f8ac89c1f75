// SPDX-License-Identifier: Apache-2.0
// Derivatives of an element's energy W(u, alpha; p) along motions of its nodes, with the enhanced
// strains alpha in equilibrium. The derivatives of a tire's results with respect to its parameters
// p are sums of these (slopes/tire_slopes.h).
//
// For a mode phi and another motion zeta, with A = W_aa for the enhanced strains alpha:
//
//   a_phi = -A^-1 W_au phi,   a_zeta = -A^-1 W_au zeta                                        (M.1)
//   D3W[phi~, phi~, .] = (g_u, g_a),   a_2 = -A^-1 g_a,   phi~ = (phi, a_phi)                 (M.2)
//   g = g_u + W_ua a_2,   the third derivative of the energy with alpha in equilibrium        (M.3)
//   L(p) = D2W[phi~, phi~] + DW[(zeta, a_zeta + a_2)]                                         (M.4)
//
// In (M.4) all motions are kept constant while p changes, so dL/dp requires no further solution. If
// W is linear in p (moduli of rubber, cords and composites, pressure), so is L, and finite
// differences are exact for any step. By the 2n + 1 rule only first derivatives of alpha are
// needed.
#pragma once

#include <span>

#include "models/fe_tire/element/hex8_batch.h"

namespace latsch::fe_tire {

/// Motions of the elements of a batch. Lane k belongs to element k. Corner displacements are in the
/// frame of the element.
struct ElementMotion {
  // kMost: largest number of motions at a time
  static constexpr int kLanes = ElementBatch::kLanes, kMost = 24;

  bool has_mode = true;                 // false: only the second term of L in (M.4) is computed
  alignas(64) double mode[24][kLanes];  // phi
  alignas(64) double mode_alpha[8][kLanes];    // a_phi
  alignas(64) double second_alpha[8][kLanes];  // a_2
  alignas(64) double curvature[24][kLanes];    // g of (M.3), in the frames of the nodes
  alignas(64) double along[24][kLanes];        // zeta
  alignas(64) double along_alpha[8][kLanes];   // a_zeta + a_2
};

// In the following functions, lanes of the batch without an element are filled with the data of the
// first element.

/// Computes a_phi, a_2 and g of the modes about the batch's state, in which alpha must be in
/// equilibrium. `surroundings` includes the pressure. Returns false if an element is inverted.
bool add_curvatures(const ElementLaw& law,
                    const ElementSurroundings& surroundings,
                    ElementBatch& batch,
                    std::span<ElementMotion> motions);

/// Computes a_zeta + a_2 for the motions. For motions with a mode, a_2 must be known.
bool follow_along(const ElementLaw& law, ElementBatch& batch, std::span<ElementMotion> motions);

/// An element with a changed parameter, and the parts of its energy that are summed.
struct VariedElement {
  static constexpr unsigned kAllCords = ~0u;

  const ElementLaw* law;
  double pressure = 0.0;  // Pa, on the inner face
  bool solid = true, gas = true;
  unsigned cords = kAllCords;  // cord layers to include; bit k: layer k of the element
};

/// Computes L of (M.4) for every changed element (all variants of one element of the section) and
/// every motion, sums[varied * motions + motion][lane].
void sum_motions(std::span<const VariedElement> varied,
                 unsigned open_edges,
                 ElementBatch& batch,
                 std::span<ElementMotion> motions,
                 double (*sums)[ElementBatch::kLanes]);

}  // namespace latsch::fe_tire
