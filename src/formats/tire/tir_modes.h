// SPDX-License-Identifier: Apache-2.0
// USE_MODE of a .tir in words, and how it differs from the computation here.
//
// Units digit: 0 vertical force alone, 1 Fx and My, 2 Fy, Mx and Mz, 3 all without interaction of
// the slips, 4 all in combined slip, 5 with turn slip. Tens digit: 0 steady state, 1 relaxation, 2
// relaxation that depends on the slip, 3 and 4 a belt on springs. Hundreds digit: contact with the
// road [MF-Tyre/MF-Swift, USE_MODE; RecurDyn, MFTire property file]. A negative number asks for the
// mirror image.
//
// Latsch computes mode 4 in tests of steady states and mode 14 where a tire rolls, for any USE_MODE
// of the file.
#pragma once

#include <string>

#include "formats/tire/tir_file.h"

namespace latsch::formats {

/// Returns "all forces in combined slip, with relaxation" for 14.
std::string asked_by_use_mode(const TirFile& tir);

/// Returns how the computation differs from the request of the file, as a sentence; empty if it is
/// the same, apart from relaxation, which only acts where a tire rolls.
std::string unlike_use_mode(const TirFile& tir);

}  // namespace latsch::formats
