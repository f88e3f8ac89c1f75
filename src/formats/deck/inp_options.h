// SPDX-License-Identifier: Apache-2.0
// Knows for every card of an .inp deck which options are read, which have no effect on the model,
// and which would mean another model.
#pragma once

#include <string>

#include "formats/deck/inp_cards.h"

namespace latsch::formats {

/// Throws InputError naming card, line and option for an unknown option, and for a value that means
/// another model: *NODE, SYSTEM=C; *STEP without NLGEOM; *BOUNDARY, OP=NEW. Options of the solution
/// method, and options with their default value, are accepted.
void check_options(const InpCard& card);

/// Returns advice on how to replace an unsupported keyword; "" if there is none.
std::string way_out(const std::string& keyword);

}  // namespace latsch::formats
