// SPDX-License-Identifier: Apache-2.0
// Prony terms of an .inp tire: *VISCOELASTIC, TIME=PRONY below a material, with rows g, k, tau.
//
// Shares g are relative to the instantaneous shear modulus, as in Abaqus, and those of
// fe_tire::PronyTerms to the relaxed one, so beta = g/(1 - sum g). The moduli of the deck are the
// long-term ones (MODULI=LONG TERM, which is Abaqus' default).
//   *HYPERELASTIC, *ELASTIC of one direction  the isochoric stress relaxes, the bulk not: k = 0
//   *ELASTIC of several directions, rebars    the whole stress relaxes: k = g
// In a law of several directions isochoric and volumetric stress depend on each other, so Abaqus
// asks for the same shares there, too.
#pragma once

#include "formats/deck/inp_deck.h"
#include "formats/mesh/inp_tire.h"
#include "models/fe_tire/history/loss_materials.h"

namespace latsch::formats {

/// Returns the terms of the tire's solids and layers, in the numbering of InpTire::materials; a
/// deck without *VISCOELASTIC gives an elastic tire. Owners are "material.NAME" of solids and
/// "layer.NAME" of rebars. Throws InputError, which names the line, for shares of 1 or more in sum
/// or below 0, for times that are not positive or alike, for instantaneous moduli, and for a k
/// other than above.
fe_tire::LossMaterials losses_of(const InpTire& tire, const InpDeck& deck);

}  // namespace latsch::formats
