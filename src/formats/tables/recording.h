// SPDX-License-Identifier: Apache-2.0
// A whole recording of a rig as channels in SI: separated values (.csv, .txt, as in csv_table.h,
// but of any size and numbers only), TYDEX (.tdx), MATLAB (.mat), or a file of a recorder
// (recorders/recorded_file.h).
//
// Ten minutes of ten channels at 2 kHz are 12 million numbers: a number is read by from_chars in
// double precision and converted once, which may differ from csv_table.h in the last bit if a unit
// is not SI.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "formats/tables/table_column.h"
#include "measurement/channels.h"
#include "measurement/ledger.h"

namespace latsch::formats {

/// `units` are those of channels, by name, that have none in the file. Throws InputError that names
/// file and line for: no header, ragged rows, a cell that is not a finite number, an unknown unit,
/// a name that occurs twice, an unknown extension, more than 2 GB.
Channels read_recording(const std::filesystem::path& file,
                        const std::map<std::string, std::string>& units = {});

/// A recording with its columns as the file states them. A column with an unknown unit is left out
/// with the reason, unless `units` states one for its name. Of a file with groups, `group` is read,
/// or all of them at the step `resampled` above 0, in s.
struct Recording {
  Channels channels;
  std::vector<TableColumn> columns;             // one for each channel, as the file states it
  std::map<std::string, std::string> left_out;  // name -> why
  int header_line = 0;                          // line of the units; 0: the file has no lines
  std::vector<LedgerDoubt> doubts = {};         // parts of the file that were not read
  std::string assumed_group = {};               // the group with known channels, if none is named
  std::vector<std::string> groups = {};         // all groups, if the first one was taken
};
Recording read_whole_recording(const std::filesystem::path& file,
                               const std::map<std::string, std::string>& units = {},
                               const std::string& group = "",
                               double resampled = 0.0);

/// Parses separated values from a text.
Channels parse_recording(std::string text, const std::string& file_name);

}  // namespace latsch::formats
