// SPDX-License-Identifier: Apache-2.0
// Reads a table of a laboratory, from a file of any supported kind, as channels in SI with gaps.
//
//   .csv .txt                 csv_table.h
//   .dat                      files of tire test consortia (below)
//   .mat                      mat_file.h; a single number with a known name and a unit becomes a
//                             channel with the same value in all samples
//   .tdx .tydex .tda .tdb     tydex_file.h; a constant that is no channel (INFLPRES) becomes a
//                             channel with the same value in all samples
//   .uff .unv .uf .bunv       recorders/uff_file.h
//   .mf4 .mdf                 recorders/mdf_file.h
//   .tdms                     recorders/tdms_file.h
//   .rsp .drv .tim .rpc       recorders/rpc_file.h
//   .ld                       recorders/motec_file.h
//
// The kinds in recorders/ hold groups of channels, each with its own time. A table is one group, or
// all of them brought to one time (recorder_table.h).
//
// The text files of tire test consortia begin with a line about the run, a line of names and a line
// of units; numbers between tabs or blanks follow:
//
//   Tire: 16.0x7.5-10   Run: 4
//   ET       SA      FZ       NFY
//   sec      deg     N
//   0.01     -0.02   -1050.4  0.012
//
// Lines before the names are ignored; the line of units may be missing. A line contains units if at
// least half of its words are units; another word in it is an unknown unit, never a name.
//
// A column whose name begins with a minus, "-SA", holds minus the quantity: the table has SA with
// the sign changed, and the column is marked as negative.
//
// A cell that is empty or says that there is no value (NaN, n/a, -) is a gap, NaN. Any other text
// among numbers is an error of its column: "1,234" may mean a thousand or one. A column with an
// error, in its cells or in its unit, is left out, and `left_out` says why; if the caller expects
// the name, the error is thrown.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "formats/tables/table_column.h"
#include "measurement/channels.h"
#include "measurement/ledger.h"

namespace latsch::formats {

struct LabTable {
  std::string file;
  Channels channels;
  std::vector<std::string> units;    // one for each channel, as the file or the caller states it
  std::vector<TableColumn> columns;  // one for each channel, as the file states it
  std::vector<int> lines;            // one for each sample; none for a MAT file
  std::map<std::string, std::string> left_out;  // name -> why
  std::vector<TableColumn> left_columns;        // the columns left out, as the file states them
  Place header;                                 // line of the names
  std::string assumed_encoding;      // encoding assumed for a text that is not UTF-8, in words
  std::string assumed_struct;        // the only struct with known channels, if none is stated
  std::vector<std::string> structs;  // structs of the file, if none of them was chosen
  std::string part_word = "struct";  // "group" if the parts of the file are groups
  std::vector<LedgerDoubt> doubts;   // text of the file that was not read

  /// Returns the place of a sample for messages: the line, or the file alone.
  Place place(std::size_t sample) const;
};

/// `units` are the units of columns for which the file states none; an empty unit only says that
/// the column is required. `expected` returns the unit that a column with a given name must have: a
/// unit of another dimension is then an error, and a unit with several meanings is read in that
/// dimension. If `part` is not empty, only the channels of that part of the file are read: of a
/// struct of a MAT file, given by its path, or of the columns of a .csv file whose names begin with
/// the part and a dot. The part is then omitted from their names. Of a file with groups, the part
/// is a group; a step `resampled` above 0, in s, joins all groups at that step instead. Throws
/// InputError that names file, line and column for: an unknown extension, a broken file, ragged
/// rows, two columns of the same name, columns of `units` that do not exist or have another unit in
/// the file, and a part that does not exist.
LabTable read_lab_table(const std::filesystem::path& file,
                        const std::map<std::string, std::string>& units = {},
                        const ExpectedUnit& expected = {},
                        const std::string& part = "",
                        double resampled = 0.0);

/// Returns the extensions of the files that read_lab_table() reads, in lower case: ".csv", ... A
/// new kind of file needs a reader and a line in lab_table.cpp; all parts of the program that
/// accept recordings use this list.
std::vector<std::string> lab_endings();

}  // namespace latsch::formats
