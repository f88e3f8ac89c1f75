// SPDX-License-Identifier: Apache-2.0
// Reads a suspension's file and inserts the contents of the files that it names: a table of
// hardpoints (hardpoints = "hardpoints.csv"), bushings ([bushing.ubj] file = "rubber.bus"). Their
// numbers become numbers of the suspension: hardpoint.ubj.2, bushing.ubj.x, bushing.ubj.curve.x.
#pragma once

#include <filesystem>
#include <vector>

#include "base/document.h"
#include "base/error.h"

namespace latsch::experiment {

struct ComposedSuspension {
  Document document;
  /// Lines of another file that replace one line of the file.
  struct Added {
    int line, count;                    // `count` lines inserted after line `line` of the file
    std::filesystem::path file = {};    // file that the lines come from, if any
    std::vector<int> lines_there = {};  // number of each line in that file
  };
  std::vector<Added> added;  // in the order of insertion

  /// Returns the original file and line of a line of the document.
  Place origin(const Place& place) const;
};

/// Throws InputError if a named file is wrong.
ComposedSuspension composed_suspension(const Document& written,
                                       const std::filesystem::path& folder);

}  // namespace latsch::experiment
