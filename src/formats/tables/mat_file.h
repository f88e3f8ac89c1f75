// SPDX-License-Identifier: Apache-2.0
// MAT files of MATLAB and Octave: numbers and texts, also in structs and cells.
//
// Version 5 ("-v6", "-v7", compressed or not) is read here, with every length checked against the
// file [MathWorks, "MAT-File Format", level 5]; version 7.3 is HDF5 and read by matio, which checks
// its input less: read such files only from trusted sources. Every member of structs and cells has
// its path as name: "run.Fz", "runs(2).Fz", "cells{3}". Complex and sparse arrays and objects are
// left out.
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
  std::vector<double> values;     // column by column; empty for a text
  std::string text;               // UTF-8, row by row
  bool is_text = false;

  bool is_vector() const;
};

struct MatFile {
  std::string file;
  std::vector<MatVariable> variables;
  std::vector<std::string> left_out;  // names of variables that are not read

  /// Throw InputError for a file that is no MAT file, broken, or above 512 MB when unpacked.
  static MatFile read(const std::filesystem::path& file);
  /// Reads version 5 only.
  static MatFile parse(std::string bytes, std::string file_name);

  /// Returns every vector of numbers as a channel in SI. Its unit is a text beside it in its
  /// struct: S.unit (or units) for S.data (or value, values), whose channel is then called S; or an
  /// entry of a list beside the list of all names, channel.units{2} for channel.name{2}; or that of
  /// `units`, by name, if the file states none. Without any unit it is a plain number. `expected`
  /// says which unit a name must have. Throws InputError for a unit that is unknown, of another
  /// dimension or not the stated one, for a name in `units` that is no vector, and if there is no
  /// vector.
  struct Named {
    Channels channels;
    std::vector<TableColumn> columns;  // description of each channel
  };
  Named named_channels(const std::map<std::string, std::string>& units = {},
                       const ExpectedUnit& expected = {}) const;
  Channels channels(const std::map<std::string, std::string>& units = {}) const {
    return named_channels(units).channels;
  }
};

}  // namespace latsch::formats
