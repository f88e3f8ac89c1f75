// SPDX-License-Identifier: Apache-2.0
// One table of a laboratory, from a file of any kind, as channels in SI with gaps.
//
//   .csv .txt                 csv_table.h
//   .dat                      files of tire test consortia (below)
//   .mat                      mat_file.h; a single number that is known and has a unit is the same
//                             for all samples
//   .tdx .tydex .tda .tdb     tydex_file.h; a constant that is no channel (INFLPRES) is the same
//                             for all samples
//
// The text files of tire test consortia begin with a line about the run, a line of names and a line
// of units; numbers between tabs or blanks follow:
//
//   Tire: 16.0x7.5-10   Run: 4
//   ET       SA      FZ       NFY
//   sec      deg     N
//   0.01     -0.02   -1050.4  0.012
//
// Lines before the names are not read; the line of units may be missing. A line contains units if
// at least half of its words are units; another word in it is an unknown unit, never a name.
//
// A column whose name begins with a minus, "-SA", holds minus the quantity: the table has SA with
// the sign changed, and the column is marked as negative.
//
// A cell that is empty or says that there is no value (NaN, n/a, -) is a gap, NaN. Any other text
// among numbers is a fault of its column: "1,234" may mean a thousand or one. A column with a
// fault, in its cells or in its unit, is left out, and `left_out` says why; if the caller expects
// the name, it is an error.
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
  std::vector<std::string> units;    // one for each channel, as the file or the caller states it
  std::vector<TableColumn> columns;  // one for each channel, as the file states it
  std::vector<int> lines;            // one for each sample; none for a MAT file
  std::map<std::string, std::string> left_out;  // name -> why
  std::vector<TableColumn> left_columns;        // the columns left out, as the file states them
  Place header;                                 // line of the names
  std::string assumed_encoding;                 // encoding of a text that is no UTF-8, in words
  std::string assumed_struct;        // the only struct with known channels, if none is stated
  std::vector<std::string> structs;  // the structs among which nothing was chosen

  /// Returns the place of a sample for messages: the line, or the file alone.
  Place place(std::size_t sample) const;
};

/// `units` are those of columns for which the file states none; an empty unit only says that the
/// column is required. `expected` says which unit a column of a name must have; a unit of another
/// dimension is an error then, and a unit with several meanings is read in that dimension. A
/// `part` that is not empty is the path of a struct of a MAT file, or what stands before the dot in
/// the names of a .csv: only its channels are read, without it in their names. Throws InputError
/// naming file, line and column: an unknown extension, a broken file, ragged rows, two columns of
/// the same name, all columns of `units` that do not exist or state another unit, no such part.
LabTable read_lab_table(const std::filesystem::path& file,
                        const std::map<std::string, std::string>& units = {},
                        const ExpectedUnit& expected = {},
                        const std::string& part = "");

/// Returns the extensions of the files that read_lab_table() reads, in lower case: ".csv", ... A
/// new kind of file is one reader and its line in lab_table.cpp; every door of the program that
/// takes recordings asks this list.
std::vector<std::string> lab_endings();

}  // namespace latsch::formats
