// SPDX-License-Identifier: Apache-2.0
// The ends of the validity ranges of a .tir file, to which the formula limits its inputs
// (operating_point.h). Beyond an end the forces are those at the end.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "models/magic_formula/magic_formula.h"

namespace latsch::magic_formula {

/// One end of a range.
struct FileRange {
  const char* what;                 // quantity of a state: "Fz"
  const char* key;                  // its name in the file: "FZMAX"
  bool is_upper;                    // true: states above the end are limited, otherwise those below
  double Parameters::*end;          // SI
  double (*value)(const State& s);  // SI
  double scale;                     // factor from SI to the unit below
  const char* unit;                 // for people, with a space in front: " deg"; empty for a ratio

  bool is_left_by(const State& state, const Parameters& tire) const {
    return is_upper ? value(state) > tire.*end : value(state) < tire.*end;
  }
};

/// Returns all ends of ranges that the formula knows.
std::span<const FileRange> file_ranges();

/// True if a coefficient of this name is an end of a range.
bool is_end_of_range(std::string_view key);

}  // namespace latsch::magic_formula
