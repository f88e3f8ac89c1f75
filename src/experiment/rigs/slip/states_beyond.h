// SPDX-License-Identifier: Apache-2.0
// Counts the states of a table that lie beyond what the file of a tire covers.
#pragma once

#include <string>
#include <vector>

#include "models/magic_formula/magic_formula.h"

namespace latsch {

struct StatesBeyond {
  long count = 0;     // states in all
  long unloaded = 0;  // states with a load of 0 or less, a tire in the air
  long outside = 0;   // states outside the ranges of the file, at which limits clamp them
  /// States beyond each end of magic_formula::file_ranges(), in its order, and the value, SI, that
  /// is farthest beyond.
  struct BeyondEnd {
    long count = 0;
    double farthest = 0.0;
  };
  std::vector<BeyondEnd> ends = {};
  long beyond_curve = 0;  // states whose load is beyond the [DEFLECTION_LOAD_CURVE] of the file

  void add(const std::vector<magic_formula::State>& states, const magic_formula::Parameters& tire);
  /// Returns one sentence for each kind of them. `limits`: true if the formula clamps its inputs;
  /// `may_be_off`: true if the test can request that it does not.
  std::vector<std::string> sentences(const magic_formula::Parameters& tire,
                                     bool limits,
                                     bool may_be_off = true) const;
};

}  // namespace latsch
