// SPDX-License-Identifier: Apache-2.0
// Reads time histories of RPC III (.rsp, .drv, .tim, .rpc), the files of servohydraulic rigs [MTS
// Systems, "RPC File Formats": file headers, time history keywords and data].
//
// The header consists of blocks of 512 bytes with four records each: a keyword of 32 bytes and a
// value of 96. The data are groups; a group holds PTS_PER_GROUP samples of the first channel, then
// those of the second one, and so on. Numbers of type SHORT_INTEGER are multiplied by SCALE.CHAN_n,
// the engineering unit's full scale divided by that of the integers; those of type FLOATING_POINT
// are taken as they are. FORMAT states the byte order.
//
// The last group is filled up with zeros. Samples at its end where every channel is 0 are not read,
// which is a doubt of the file, unless SAMPLES, a keyword that some programs add, states how many
// there are. Configurations, multiplexed and peak-picked histories, half frames, text (ASCII) and
// other kinds of files are refused by name. A file that is cut off is read up to its last whole
// group.
#pragma once

#include <string>
#include <string_view>

#include "formats/recorders/recorded_file.h"

namespace latsch::formats {

/// Throws InputError that names the keyword of a broken file. `file` is the name in messages.
RecordedFile parse_rpc(std::string_view bytes, std::string file);

}  // namespace latsch::formats
