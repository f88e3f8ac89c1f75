// SPDX-License-Identifier: Apache-2.0
// Materials and rebars of an .inp deck in the terms of models/fe_tire, SI.
//
// Laws are those CalculiX takes: *ELASTIC is linear between second Piola-Kirchhoff stress and
// Green-Lagrange strain, in the axes of the undeformed tire. Abaqus turns it with the material and
// measures strain logarithmically, which differs by the order of the strain.
#pragma once

#include "formats/deck/inp_deck.h"
#include "models/fe_tire/element/materials.h"

namespace latsch::formats {

/// Whether the law looks different from different directions, so that it needs an orientation.
bool has_directions(const InpMaterial& material);

/// In the axes of the orientation, cylindrical about the spin axis (nullptr: none). Throws
/// InputError for a material without law or density, for constants that give no stable law, for a
/// missing orientation.
fe_tire::Solid solid_from(const InpDeck& deck,
                          const InpMaterial& material,
                          const InpOrientation* orientation);

/// `sign`: -1 where the normal of the surface elements points inward, for the angle turns about it.
/// Throws InputError for a rebar that is not linear elastic or has no size.
fe_tire::CordLayer layer_from(const InpDeck& deck, const InpRebars& rebars, int sign);

}  // namespace latsch::formats
