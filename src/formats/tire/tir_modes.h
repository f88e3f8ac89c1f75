// SPDX-License-Identifier: Apache-2.0
// Describes USE_MODE of a .tir in words, and how Latsch computes differently.
//
// Units digit: 0 vertical force alone, 1 Fx and My, 2 Fy, Mx and Mz, 3 all without interaction of
// the slips, 4 all in combined slip, 5 with turn slip. Tens digit: 0 steady state, 1 relaxation, 2
// relaxation that depends on the slip, 3 and 4 a belt on springs. Hundreds digit: contact with the
// road [MF-Tyre/MF-Swift, USE_MODE; RecurDyn, MFTire property file]. A negative number requests the
// mirror image. Whatever USE_MODE the file has, Latsch computes mode 4 in tests of steady states
// and mode 14 in tests of a rolling tire.
#pragma once

#include <string>

#include "formats/tire/tir_file.h"

namespace latsch::formats {

/// Returns the mode that the file requests in words, such as "all forces in combined slip, with
/// relaxation" for 14.
std::string asked_by_use_mode(const TirFile& tir);

/// Returns a sentence on how the computation differs from the mode that the file requests; empty if
/// it does not differ except for relaxation, which acts only if the tire rolls.
std::string unlike_use_mode(const TirFile& tir);

}  // namespace latsch::formats
