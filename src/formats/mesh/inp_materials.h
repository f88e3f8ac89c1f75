// SPDX-License-Identifier: Apache-2.0
// Converts materials and rebars of an .inp deck to models/fe_tire, SI.
//
// Laws are those of CalculiX: *ELASTIC is linear between second Piola-Kirchhoff stress and
// Green-Lagrange strain, in the axes of the undeformed tire. Abaqus rotates these axes with the
// material and uses logarithmic strain, a difference of the order of the strain.
#pragma once

#include "formats/deck/inp_deck.h"
#include "models/fe_tire/mesh/materials.h"

namespace latsch::formats {

/// True if the law depends on the direction, so that it needs an orientation.
bool has_directions(const InpMaterial& material);

/// Returns the solid in the axes of the orientation, cylindrical about the spin axis (nullptr:
/// none). Throws InputError for a material without law or density, for constants that give no
/// stable law, for a missing orientation.
fe_tire::Solid solid_from(const InpDeck& deck,
                          const InpMaterial& material,
                          const InpOrientation* orientation);

/// Returns the layer of cords. `sign` is -1 if the normal of the surface elements points inward,
/// because the angle is counted about that normal. Throws InputError for a rebar that is not linear
/// elastic or has no cross section.
fe_tire::CordLayer layer_from(const InpDeck& deck, const InpRebars& rebars, int sign);

}  // namespace latsch::formats
