// SPDX-License-Identifier: Apache-2.0
// Writes a document in coherent SI units alone: "2.4 bar" becomes "240000 Pa", "22 deg" becomes
// "0.3839724354387525 rad". A reader that knows only these units reads the same bits (the exported
// units of apps/exchange).
#pragma once

#include <string>

#include "base/document.h"

namespace latsch::formats {

/// Returns the document as TOML, each value on a line of its own under a dotted key, without
/// comments. Numbers have the fewest digits that give their bits back.
std::string text_in_si(const Document& document);

/// Returns the fewest digits that give the bits of a finite value back, with a point or an
/// exponent unless `may_be_whole`.
std::string digits_of(double value, bool may_be_whole = true);

}  // namespace latsch::formats
