// SPDX-License-Identifier: Apache-2.0
// Says which options of a card of an .inp deck are read, which have no effect here and which mean
// another model.
#pragma once

#include <string>

#include "formats/deck/inp_cards.h"

namespace latsch::formats {

/// Throws InputError naming card, line and option for an unknown option, and for a value that means
/// another model: *NODE, SYSTEM=C; *STEP without NLGEOM; *BOUNDARY, OP=NEW. Options of the solution
/// method, and options with their default value, are accepted.
void check_options(const InpCard& card);

/// Returns advice about an unsupported keyword of other decks; "" if there is none.
std::string way_out(const std::string& keyword);

}  // namespace latsch::formats
