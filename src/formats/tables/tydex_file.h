// SPDX-License-Identifier: Apache-2.0
// Reads TYDEX 1.3, the exchange format of tire test laboratories [Unrau & Zamow, "TYDEX-Format,
// Description and Reference Manual", release 1.3, 1997].
//
//   **HEADER                                                 columns  1-10  name
//   RELEASE   Release of TYDEX-Format                 1.3            11-40  comment
//   **CONSTANTS                                                      41-50  unit
//   INFLPRES  Inflation pressure            bar       2.5            51-..  value
//   **MEASURCHANNELS
//   FZW       Vertical force                N         1         0         0
//   **MEASURDATA                                      factor    measured  physical offset
//   ...
//   **END
//
// A channel is factor * (raw + measured offset) + physical offset in its unit. Lines that begin
// with ! are comments. The reader accepts more than the format: keywords and names in any case,
// CRLF, Latin-1, lines that end early, shifted columns if the words leave no doubt, data in columns
// of 10 or between blanks, exponents with D, decimal commas. Values that are not available
// (NOTAVAIL, NaN, an empty column) are NaN.
//
// Everything is returned in SI, with the signs and axes of the file: the names state the axes (FYW:
// W axes), and measurement/axes.h converts.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "measurement/channels.h"
#include "measurement/ledger.h"

namespace latsch::formats {

struct TydexFile {
  /// A line of the header, of the constants or of a model section.
  struct Entry {
    std::string name;  // in capitals
    std::string comment;
    std::string unit;              // text in the file
    std::string text;              // text of the value in the file
    std::optional<double> number;  // in `si_unit`, if the value is a number
    std::string si_unit = "1";
    int line = 0;
  };
  struct Description {
    std::string comment;
    std::string unit;                                                   // text in the file
    double factor = 1.0, measured_offset = 0.0, physical_offset = 0.0;  // in `unit`
    int line = 0;
  };
  /// A section that is not interpreted, such as **MODELPARAMETERS; its entries are in the order of
  /// the file.
  struct Section {
    std::string keyword;
    std::vector<Entry> entries;
  };

  std::string file;
  std::vector<Entry> header;
  std::vector<std::string> comments;
  std::vector<Entry> constants;
  std::vector<Section> model;
  Channels channels;
  std::vector<Description> descriptions;  // one for each channel
  std::vector<int> lines;                 // one for each sample
  /// channels and constants with unknown units, with the reason
  std::map<std::string, std::string> left_out;
  std::map<std::string, std::pair<int, std::string>> left_units;  // line and unit of each of them
  std::vector<LedgerDoubt> doubts;  // text that the format does not read, with its first line

  /// Throw InputError that names file, line, what was found and what was expected; also for a file
  /// without **HEADER or **END, which is incomplete.
  static TydexFile read(const std::filesystem::path& file);
  static TydexFile parse(std::string text, std::string file_name);

  /// Returns the entry of a name in the header or the constants; nullptr if there is none.
  const Entry* find(std::string_view name) const;
  /// Returns a constant in the SI unit of `unit`. If there is no such constant, returns the mean of
  /// the channel of that name; throws InputError if there is neither or if the dimension differs.
  double constant(std::string_view name, std::string_view unit) const;
};

/// A name that TYDEX defines, and its SI unit.
struct TydexName {
  std::string_view name;
  std::string_view si_unit;  // "": the value is a text
  std::string_view axes;     // "W", "H", "C"; "": none
  std::string_view meaning;
};
/// Returns the definition of a TYDEX name; nullptr for a name of the laboratory's own. See
/// tydex_names.cpp.
const TydexName* find_tydex_name(std::string_view name);

}  // namespace latsch::formats
