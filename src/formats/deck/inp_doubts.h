// SPDX-License-Identifier: Apache-2.0
// Doubts about a finite-element deck that can be read: statements that contradict each other or are
// unusual.
#pragma once

#include <vector>

#include "formats/deck/inp_deck.h"
#include "measurement/ledger.h"

namespace latsch::formats {

/// Returns doubts with file and line: a negative pressure, and elements in two sections of
/// different material or orientation.
std::vector<LedgerDoubt> doubts_of_deck(const InpDeck& deck);

}  // namespace latsch::formats
