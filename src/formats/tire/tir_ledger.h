// SPDX-License-Identifier: Apache-2.0
// Builds the ledger of a .tir: a row for each key of the file (measurement/ledger.h).
#pragma once

#include "formats/tire/tir_file.h"
#include "measurement/ledger.h"

namespace latsch::formats {

/// Keys that set a parameter are marked as used, and `remark` says if they have an effect only in
/// some models or modes; other known keys are not used, with the reason; an unknown key is
/// doubtful. Errors and assumptions are in the notes of the file.
Ledger ledger_of(const TirFile& tir);

}  // namespace latsch::formats
