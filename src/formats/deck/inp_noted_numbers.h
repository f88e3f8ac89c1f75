// SPDX-License-Identifier: Apache-2.0
// Notes numbers of an .inp deck that a study may vary, as the deck is read.
#pragma once

#include <string>

#include "formats/deck/inp_cards.h"
#include "formats/deck/inp_deck.h"

namespace latsch::formats {

/// Adds the number in a field of a line of the card to InpDeck::numbers; returns its index there.
int note_number(InpDeck& deck,
                const std::string& path,
                InpQuantity quantity,
                const InpCard& card,
                const InpLine& line,
                std::size_t field);

/// Converts a name of the file for use in a path: dots are replaced, because they separate the
/// parts of a path.
std::string part_of_path(std::string name);

}  // namespace latsch::formats
