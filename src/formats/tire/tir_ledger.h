// SPDX-License-Identifier: Apache-2.0
// The ledger of a .tir: a row for each key of the file (measurement/ledger.h).
#pragma once

#include "formats/tire/tir_file.h"
#include "measurement/ledger.h"

namespace latsch::formats {

/// Keys that become a parameter are used, `remark` says where in some models or modes alone; others
/// are not used, with the reason; a key that is not known is doubtful. What is wrong or assumed
/// stands in the notes of the file.
Ledger ledger_of(const TirFile& tir);

}  // namespace latsch::formats
