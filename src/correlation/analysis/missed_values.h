// SPDX-License-Identifier: Apache-2.0
// Measured values that the model misses at the point found. To first order, from the derivatives
// computed for the intervals, this file determines the variable that would correct each value with
// the smallest change, and the other value whose error would grow most.
//
// A value is missed if its error exceeds three times its stated noise, or 1 % if none is stated.
// Experiments of more than twenty values are left out, because no single one of these matters.
// Experiments with a robust loss are left out, because a value far off may not come from the
// tire.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"

namespace latsch::correlation {

struct MissedValue {
  struct Error {
    std::string name;              // for example "frequency, radial n=2"
    double error;                  // simulated minus measured, as a share of what counts as 100 %
    std::string in_words() const;  // for example "4.7 % too low"
  };
  Error missed;
  bool fitted = true;
  /// index of the variable that moves the value most; empty if none moves it
  std::optional<int> variable = {};
  double effect = 0.0;  // change of the error over that variable's whole range
  /// true if the variable alone can correct the value inside its bounds
  bool within_bounds = true;
  /// the other fitted value whose error grows most, with its error after the change
  std::optional<Error> payer = {};

  std::string in_words(const DesignSpace& space) const;
};

/// Returns the missed values in the order of the study. Experiments with use = "predict" are
/// included if they were simulated at prediction_points().
std::vector<MissedValue> missed_values(const Study& study, const Identifiability& what);

}  // namespace latsch::correlation
