// SPDX-License-Identifier: Apache-2.0
// MAT files of MATLAB and Octave: numbers and texts, also in structs and cells.
//
// Version 5 ("-v6", "-v7", compressed or not) is read here, with every length checked against the
// file [MathWorks, "MAT-File Format", level 5]; version 7.3 is HDF5 and read by matio, which trusts
// its input more than this reader does: take such files from people you know. Of structs and cells
// every member comes out under its path, "run.Fz", "runs(2).Fz", "cells{3}". Complex, sparse and
// objects are left out.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "formats/tables/table_column.h"
#include "measurement/channels.h"

namespace latsch::formats {

struct MatVariable {
  std::string name;
  std::vector<std::size_t> size;  // at least two
  std::vector<double> values;     // column by column; of a text empty
  std::string text;               // UTF-8, row by row
  bool is_text = false;

  bool is_vector() const;
};

struct MatFile {
  std::string file;
  std::vector<MatVariable> variables;
  std::vector<std::string> left_out;  // names of what is not read

  /// Throw InputError: no MAT file, broken, over 512 MB when unpacked.
  static MatFile read(const std::filesystem::path& file);
  /// Version 5 only.
  static MatFile parse(std::string bytes, std::string file_name);

  /// Every vector of numbers as a channel in SI. Its unit is a text beside it in its struct: S.unit
  /// (or units) of S.data (or value, values), which then is called S; or listed beside the names of
  /// all, channel.units{2} with channel.name{2}; or that of `units`, by name, where the file states
  /// none. Without any it is a plain number. `expected` says which unit a name has to have.
  /// A vector with an unknown unit is left out with the reason, unless `units` or `expected` know
  /// its name. Throws InputError for a unit of a known vector that is unknown, of another dimension
  /// or not the stated one, a name in `units` that is no vector, and where no vector is there.
  struct Named {
    Channels channels;
    std::vector<TableColumn> columns;             // of each channel
    std::map<std::string, std::string> left_out;  // name -> why
    std::vector<TableColumn> left_columns;        // of these
  };
  Named named_channels(const std::map<std::string, std::string>& units = {},
                       const ExpectedUnit& expected = {}) const;
  Channels channels(const std::map<std::string, std::string>& units = {}) const {
    return named_channels(units).channels;
  }
};

}  // namespace latsch::formats
