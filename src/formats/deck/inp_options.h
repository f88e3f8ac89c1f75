// SPDX-License-Identifier: Apache-2.0
// Says which options of a card of an .inp deck are read, which have no effect here and which mean
// another model.
#pragma once

#include "formats/deck/inp_cards.h"

namespace latsch::formats {

/// Throws InputError naming card, line and option for an unknown option, and for a value that means
/// another model: *NODE, SYSTEM=C; *STEP without NLGEOM; *BOUNDARY, OP=NEW. Options of the solution
/// method, and options with their default value, are accepted.
void check_options(const InpCard& card);

}  // namespace latsch::formats
