// SPDX-License-Identifier: Apache-2.0
// Reads recordings of TDMS (.tdms), versions 1.0 and 2.0 [National Instruments, "TDMS File Format
// Internal Structure"]: integers of 8 to 64 bits, single and double precision, Booleans; channel by
// channel and interleaved; both byte orders; segments that repeat the description of earlier ones.
//
// The channels of a TDMS group that have equally many samples and one time are a group of the
// recording; if their times or lengths differ, the group is split. The time is that of the
// waveform: wf_start_offset + i wf_increment, and if the groups began at different instants
// (wf_start_time), later ones are shifted so that all share the time of the first. A group without
// a waveform has its channel "time" as abscissa, if it has one. The unit is unit_string.
//
// Texts, time stamps and complex numbers are left out, each with the reason, and so are channels
// whose scale (NI_Scale) was not applied by the recorder. Raw data of DAQmx, numbers of extended
// precision and the index file (.tdms_index) are refused. The last segment of a file that was not
// closed or is cut off is read up to its last whole record, which is a doubt of the file.
#pragma once

#include <string>
#include <string_view>

#include "formats/recorders/recorded_file.h"

namespace latsch::formats {

/// Throws InputError that names the segment of a broken file by its position in bytes. `file` is
/// the name in messages.
RecordedFile parse_tdms(std::string_view bytes, std::string file);

}  // namespace latsch::formats
