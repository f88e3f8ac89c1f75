// SPDX-License-Identifier: Apache-2.0
// A suspension's file with what it names by files of its own in their places: a table of hardpoints
// (hardpoints = "hardpoints.csv"), bushings ([bushing.ubj] file = "rubber.bus"). Their numbers are
// numbers of the suspension then: hardpoint.ubj.2, bushing.ubj.x, bushing.ubj.curve.x.
#pragma once

#include <filesystem>
#include <vector>

#include "base/document.h"
#include "base/error.h"

namespace latsch::experiment {

struct ComposedSuspension {
  Document document;
  /// Lines that have come in the place of one.
  struct Added {
    int line, count;                    // behind this line of the file, so many
    std::filesystem::path file = {};    // whose lines these are, where they have some
    std::vector<int> lines_there = {};  // of each, from `line` on
  };
  std::vector<Added> added;  // one after the other

  /// Where a line of the document has come from.
  Place origin(const Place& place) const;
};

/// InputError.
ComposedSuspension composed_suspension(const Document& written,
                                       const std::filesystem::path& folder);

}  // namespace latsch::experiment
