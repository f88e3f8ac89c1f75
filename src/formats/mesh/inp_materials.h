// SPDX-License-Identifier: Apache-2.0
// Materials of an .inp deck in the terms of models/fe_tire, SI.
#pragma once

#include "formats/mesh/inp_tire.h"

namespace latsch::formats {

/// Throws InputError for a material without law or density, and for an anisotropic one that is not
/// positive definite.
fe_tire::Solid solid_from(const InpMaterial& material, const InpUnits& units);

}  // namespace latsch::formats
