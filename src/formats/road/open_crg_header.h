// SPDX-License-Identifier: Apache-2.0
// The statements in the text before the records of an OpenCRG file, with their lines.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace latsch::formats {

struct OpenCrgHeader {
  struct Value {
    double number = 0.0;
    int line = 0;
    std::string file;
  };
  using Values = std::map<std::string, Value, std::less<>>;
  /// One line of $ROAD_CRG_FILE.
  struct Reference {
    std::string text;
    int line = 0;
  };
  struct Channel {
    enum class Kind { section_number, section_place, u, x, y, phi, slope, banking };
    Kind kind = Kind::section_number;
    double place = 0.0;  // number of the channel, or v of a section
    int line = 0;
  };

  /// The line "U: reference line u,m,BEGIN,STEP", which repeats the positions of the rows.
  struct VirtualChannel {
    double begin = 0.0, step = 0.0;  // m
    int line = 0;
  };

  std::string file;
  std::string comment;
  Values road, options, modifiers;  // values by the statement's name in lower case
  /// True if the file has a section of options or modifiers, even an empty one: it replaces the
  /// section of a file to which this file refers.
  bool has_options = false, has_modifiers = false;
  std::vector<std::string> kept;  // "name = value": statements that do not concern the surface
  std::string format;             // "LRFI"
  int format_line = 0;
  std::vector<Channel> channels;
  std::optional<VirtualChannel> virtual_u;
  std::vector<std::string> warnings;  // file, line and interpretation
  std::vector<Reference> references;  // lines of $ROAD_CRG_FILE, unchanged
  /// First byte after the line $$$$; npos if there is no such line.
  std::size_t data_begin = 0;
  int data_line = 0;

  std::optional<double> find(const Values& values, std::string_view name) const;
  double value(const Values& values, std::string_view name, double fallback) const;
  /// Throws InputError with the line of the statement.
  [[noreturn]] void reject(const Values& values,
                           std::string_view name,
                           const std::string& message) const;
};

/// True if a statement affects the surface. All others are a position on the globe or a map
/// projection, or concern what a program searches, checks, warns and logs.
bool concerns_surface(std::string_view name);

/// Reads the header. Throws InputError for a statement that is unknown or has no number, and for a
/// repeated statement of $ROAD_CRG. If an option or modifier is repeated, the last one counts, with
/// a warning.
OpenCrgHeader read_open_crg_header(std::string_view bytes, const std::string& file);

}  // namespace latsch::formats
