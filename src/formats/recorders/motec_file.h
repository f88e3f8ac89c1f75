// SPDX-License-Identifier: Apache-2.0
// Reads logs of MoTeC (.ld). EXPERIMENTAL: the format has no public text; what is read here is what
// public readers found by comparing files with the numbers of the logger's own program, and a doubt
// of every file says so.
//
// The header points to a chain of channel blocks, each with a name, a unit, a rate in whole Hz, and
// the position of its numbers: integers or floating-point numbers of 16 or 32 bits in little-endian
// order. A quantity is (number / scale * 10^-decimals + shift) * multiplier. Channels with one rate
// and length are a group of the recording, called by its rate, "20 Hz"; its time begins at 0.
#pragma once

#include <string>
#include <string_view>

#include "formats/recorders/recorded_file.h"

namespace latsch::formats {

/// Throws InputError that names the channel block of a broken file by its position in bytes. `file`
/// is the name in messages.
RecordedFile parse_motec(std::string_view bytes, std::string file);

}  // namespace latsch::formats
