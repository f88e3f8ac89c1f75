// SPDX-License-Identifier: Apache-2.0
// One table of a laboratory, whatever its file, as channels in SI with gaps.
//
//   .csv .txt                 csv_table.h
//   .dat                      as tire test consortia hand it out (below)
//   .mat                      mat_file.h
//   .tdx .tydex .tda .tdb     tydex_file.h; a constant that is no channel (INFLPRES) holds
//                             all along
//
// The text files of tire test consortia begin with a line about the run, a line of names and a line
// of units; numbers between tabs or blanks follow:
//
//   Tire: 16.0x7.5-10   Run: 4
//   ET       SA      FZ       NFY
//   sec      deg     N
//   0.01     -0.02   -1050.4  0.012
//
// Lines before the names are not read, the line of units may be missing. A line is one of units if
// at least half of its words are; another word in it is an unknown unit, never a name.
//
// A cell that is empty or says that there is no value (NaN, n/a, -) is a gap, NaN. Any other text
// among numbers is a fault of its column: "1,234" is a thousand to some and one to others. A column
// with a fault, in its cells or in its unit, is left out, and `left_out` says why; where the
// caller knows the name, it is an error.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "formats/tables/table_column.h"
#include "measurement/channels.h"

namespace latsch::formats {

struct LabTable {
  std::string file;
  Channels channels;
  std::vector<std::string> units;    // of the channels as the file or the caller states them
  std::vector<TableColumn> columns;  // of the channels, as the file states them
  std::vector<int> lines;            // of each sample; of a MAT file none
  std::map<std::string, std::string> left_out;  // name -> why
  std::vector<TableColumn> left_columns;        // of these, as the file states them
  Place header;                                 // of the names

  /// Of a sample, for messages: the line, or the file alone.
  Place place(std::size_t sample) const;
};

/// `units` of columns for which the file states none; an empty one only says that the column has to
/// be there. `expected` says which unit a column of a name has to have; a unit of another dimension
/// is an error then, one with several meanings is read as that dimension. Throws InputError naming
/// file, line and column: an ending it does not know, a broken file, ragged rows, two columns of
/// one name, columns of `units` that are not there, all of them, or state another unit.
LabTable read_lab_table(const std::filesystem::path& file,
                        const std::map<std::string, std::string>& units = {},
                        const ExpectedUnit& expected = {});

}  // namespace latsch::formats
