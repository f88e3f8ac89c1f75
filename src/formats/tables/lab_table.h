// SPDX-License-Identifier: Apache-2.0
// One table of a laboratory, whatever its file, as channels in SI with gaps.
//
//   .csv .txt      csv_table.h
//   .dat           as tire test consortia hand it out (below)
//   .mat           mat_file.h
//   .tdx .tydex    tydex_file.h; a constant that is no channel (INFLPRES) holds all along
//
// The text files of tire test consortia begin with a line about the run, a line of names and a line
// of units; numbers between tabs or blanks follow:
//
//   Tire: 16.0x7.5-10   Run: 4
//   ET       SA      FZ       NFY
//   sec      deg     N
//   0.01     -0.02   -1050.4  0.012
//
// Lines before the names are not read, the line of units may be missing. Units are as in
// text/lab_units.h: "lb" is a force.
//
// A cell that is empty or no finite number is a gap, NaN. A column whose unit is none is left out;
// `left_out` says why, for whoever needs it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "measurement/channels.h"

namespace latsch::formats {

struct LabTable {
  std::string file;
  Channels channels;
  std::vector<std::string> units;  // of the channels as the file or the caller states them
  std::vector<int> lines;          // of each sample; of a MAT file none
  std::map<std::string, std::string> left_out;  // name -> why
  Place header;                                 // of the names

  /// Of a sample, for messages: the line, or the file alone.
  Place place(std::size_t sample) const;
};

/// `units` of columns for which the file states none. Throws InputError naming file and line: an
/// ending it does not know, a broken file, ragged rows, a column of `units` that is not there or
/// states another unit.
LabTable read_lab_table(const std::filesystem::path& file,
                        const std::map<std::string, std::string>& units = {});

}  // namespace latsch::formats
