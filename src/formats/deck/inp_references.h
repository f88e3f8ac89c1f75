// SPDX-License-Identifier: Apache-2.0
// Checks that everything a deck refers to exists in it.
#pragma once

#include "formats/deck/inp_deck.h"

namespace latsch::formats {

/// Throws InputError naming the line of a name or number that is not defined.
void check_references(const InpDeck& deck);

}  // namespace latsch::formats
