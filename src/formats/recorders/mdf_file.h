// SPDX-License-Identifier: Apache-2.0
// Reads measurements of ASAM MDF 4.0 to 4.2 (.mf4, .mdf): blocks ID, HD, DG, CG, CN, CC, TX, MD,
// DT, DV, DL, LD, HL and DZ, sorted and unsorted, deflated and transposed.
//
// Every channel group is a group of the recording, with its master as abscissa; channels of a group
// whose master is in another one join that group. Integers of up to 64 bits at any bit, floating
// point numbers of 16, 32 and 64 bits in both byte orders are converted by rules 0 (none), 1
// (linear), 2 (rational; a gap if it divides by 0), 4, 5 (tables with and without interpolation)
// and 6 (ranges). A sample that its invalidation bit marks is a gap.
//
// Texts, arrays, complex numbers, values of variable length, frames of a bus and rules that give
// texts are left out, each with the reason; MDF 3 is refused. A file that was still being written
// (UnFinMF) is read up to its last whole record, which is a doubt of the file.
#pragma once

#include <string>
#include <string_view>

#include "formats/recorders/recorded_file.h"

namespace latsch::formats {

/// Throws InputError that names the block of a broken file by its position in bytes. `file` is the
/// name in messages.
RecordedFile parse_mdf(std::string_view bytes, std::string file);

}  // namespace latsch::formats
