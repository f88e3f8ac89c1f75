// SPDX-License-Identifier: Apache-2.0
// Derivatives of an element's energy W(u, alpha; p) along motions of it, with enhanced strains that
// follow: what slopes of a tire's answers in its numbers p are made of (slopes/tire_slopes.h).
//
// Of a mode phi and another motion zeta, with A = W_aa of the enhanced strains alpha:
//   a_phi = -A^-1 W_au phi,   a_zeta = -A^-1 W_au zeta                                        (M.1)
//   D3W[phi~, phi~, .] = (g_u, g_a),   a_2 = -A^-1 g_a,   phi~ = (phi, a_phi)                 (M.2)
//   g = g_u + W_ua a_2,   the third derivative of the energy with alpha in equilibrium        (M.3)
//   L(p) = D2W[phi~, phi~] + DW[(zeta, a_zeta + a_2)]                                         (M.4)
// with all motions held as p moves. dL/dp needs nothing solved again, and where W is linear in p
// (moduli of rubber, cords and composites, pressure) so is L: differences over any step are then
// exact. By the rule 2n + 1 no more than first derivatives of alpha enter.
#pragma once

#include <span>

#include "models/fe_tire/element/hex8_batch.h"

namespace latsch::fe_tire {

/// Lane k is element k of a batch; corners in the frame of the element.
struct ElementMotion {
  static constexpr int kLanes = ElementBatch::kLanes, kMost = 24;  // at most, at a time

  bool has_mode = true;                        // else L has its second term alone
  alignas(64) double mode[24][kLanes];         // phi
  alignas(64) double mode_alpha[8][kLanes];    // a_phi
  alignas(64) double second_alpha[8][kLanes];  // a_2
  alignas(64) double curvature[24][kLanes];    // g, in the frames of the nodes
  alignas(64) double along[24][kLanes];        // zeta
  alignas(64) double along_alpha[8][kLanes];   // a_zeta + a_2
};

// Lanes of the batch without an element are filled with the first one's.

/// Sets a_phi, a_2 and g of the modes about the batch's state, an equilibrium of its alpha.
/// `surroundings` with the pressure that acts. False where the element has no state.
bool add_curvatures(const ElementLaw& law,
                    const ElementSurroundings& surroundings,
                    ElementBatch& batch,
                    std::span<ElementMotion> motions);

/// Sets a_zeta + a_2 of the motions, a_2 as it stands there with a mode.
bool follow_along(const ElementLaw& law, ElementBatch& batch, std::span<ElementMotion> motions);

/// An element with other numbers, and which parts of its energy are wanted.
struct VariedElement {
  static constexpr unsigned kAllCords = ~0u;

  const ElementLaw* law;
  double pressure = 0.0;  // Pa on the inner face
  bool solid = true, gas = true;
  unsigned cords = kAllCords;  // bit k: of its layer k
};

/// L of every varied element (all of one section element) and motion,
/// sums[varied * motions + motion][lane].
void sum_motions(std::span<const VariedElement> varied,
                 unsigned open_edges,
                 ElementBatch& batch,
                 std::span<ElementMotion> motions,
                 double (*sums)[ElementBatch::kLanes]);

}  // namespace latsch::fe_tire
