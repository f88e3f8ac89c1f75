// SPDX-License-Identifier: Apache-2.0
// The kinds of specimens that the program knows, each defined in the file of its name.
#pragma once

#include "experiment/language/specimen.h"

namespace latsch::experiment {

const SpecimenKind& fe_tire_kind();
const SpecimenKind& inp_tire_kind();
const SpecimenKind& ring_tire_kind();
const SpecimenKind& rigid_ring_kind();
const SpecimenKind& magic_formula_kind();
const SpecimenKind& suspension_kind();
const SpecimenKind& car_kind();

}  // namespace latsch::experiment
