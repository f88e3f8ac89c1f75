// SPDX-License-Identifier: Apache-2.0
// The text before the records of an OpenCRG file, as statements with their places.
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
  struct Channel {
    enum class Kind { section_number, section_place, u, x, y, phi, slope, banking };
    Kind kind = Kind::section_number;
    double place = 0.0;  // of a section: number or v
    int line = 0;
  };

  std::string file;
  std::string comment;
  Values road, options, modifiers;  // by name in lower case
  std::string format;               // "LRFI"
  int format_line = 0;
  std::vector<Channel> channels;
  std::vector<std::string> warnings;  // file, line and what was read in what way
  std::string include;                // of $ROAD_CRG_FILE
  int include_line = 0;
  std::size_t data_begin = 0;  // first byte behind the line $$$$; npos: there is none
  int data_line = 0;

  std::optional<double> find(const Values& values, std::string_view name) const;
  double value(const Values& values, std::string_view name, double fallback) const;
  /// InputError at the statement.
  [[noreturn]] void reject(const Values& values,
                           std::string_view name,
                           const std::string& message) const;
};

/// Throws InputError for a statement that is unknown or has no number, and for one of $ROAD_CRG
/// that comes twice; of options and modifiers the last one counts, with a warning.
OpenCrgHeader read_open_crg_header(std::string_view bytes, const std::string& file);

}  // namespace latsch::formats
