// SPDX-License-Identifier: Apache-2.0
// Which options of a card of an .inp deck are read, which change nothing here and which mean
// another model.
#pragma once

#include "formats/deck/inp_cards.h"

namespace latsch::formats {

/// InputError naming card, line and option for one that is not known here, and for a value that
/// means another model: *NODE, SYSTEM=C; *STEP without NLGEOM; *BOUNDARY, OP=NEW. Options that say
/// how to solve, or what is the default anyway, pass.
void check_options(const InpCard& card);

}  // namespace latsch::formats
