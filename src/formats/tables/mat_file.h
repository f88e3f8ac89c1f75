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
  std::vector<std::size_t> size;  // dimensions of the array, at least two
  std::vector<double> values;     // column by column; empty for a text variable
  std::string text;               // UTF-8, row by row
  bool is_text = false;

  bool is_vector() const;
};

struct MatFile {
  std::string file;
  std::vector<MatVariable> variables;
  std::vector<std::string> left_out;  // names of variables that are not read

  /// Throw InputError if the file is no MAT file, is broken, or is larger than 512 MB when
  /// unpacked.
  static MatFile read(const std::filesystem::path& file);
  /// Reads version 5 only.
  static MatFile parse(const std::string& bytes, std::string file_name);

  /// All vectors of numbers as channels in SI. The unit of a vector is, in this order: a text
  /// beside it in its struct, S.unit (or units) of S.data (or value, values), in which case the
  /// channel is called S; an entry in a list, channel.units{2} for channel.name{2}; the one that
  /// `units` states for the name. Without a unit it is a plain number. `expected` returns the unit
  /// that a name must have. A vector with an unknown unit is left out with the reason, unless
  /// `units` or `expected` know its name. Throws InputError if the unit of a known vector is
  /// unknown, has another dimension or differs from the stated one, if a name in `units` is no
  /// vector, and if the file has no vectors.
  struct Named {
    Channels channels;
    std::vector<TableColumn> columns;             // one for each channel
    std::map<std::string, std::string> left_out;  // name -> why
    std::vector<TableColumn> left_columns;        // the columns left out
  };
  Named named_channels(const std::map<std::string, std::string>& units = {},
                       const ExpectedUnit& expected = {}) const;
  /// Returns the units that the file states, by the names of the channels.
  std::map<std::string, std::string> written_units() const;
  /// Returns the name that a variable has in named_channels(): "Fz" for "Fz.data" if `units`
  /// contains a unit of the struct Fz, otherwise the variable's own name.
  static std::string channel_of(const MatVariable& variable,
                                const std::map<std::string, std::string>& units);
  Channels channels(const std::map<std::string, std::string>& units = {}) const {
    return named_channels(units).channels;
  }
};

}  // namespace latsch::formats
