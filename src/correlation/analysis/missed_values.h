// SPDX-License-Identifier: Apache-2.0
// Finds the measured values that the model misses at the fitted point. For each, to first order
// from the derivatives computed for the intervals, it determines the variable that would correct
// the value with the smallest change, and the other value whose error would then grow most.
//
// A value is missed if its error exceeds three times its stated noise, or 3 % if none is stated.
// Experiments of more than twenty values are left out, because a single one of their values hardly
// matters. Experiments with a robust loss are left out, because their outliers need not be caused
// by the tire.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"

namespace latsch::correlation {

struct MissedValue {
  struct Error {
    std::string name;  // for example "frequency, radial n=2"
    double error;  // simulated minus measured value, as a share of the value that counts as 100 %
    std::string in_words() const;  // for example "4.7 % too low"
  };
  Error missed;
  bool fitted = true;
  /// Index of the variable that changes the value most; empty if none changes it.
  std::optional<int> variable = {};
  double effect = 0.0;  // change of the error over that variable's whole range
  /// True if the variable alone can correct the value within its bounds.
  bool within_bounds = true;
  /// The other fitted value whose error increases most by the correction, with its error after the
  /// correction.
  std::optional<Error> payer = {};

  std::string in_words(const DesignSpace& space) const;
};

/// Returns the missed values in the order of the study. Experiments with use = "predict" are
/// included if they were simulated at prediction_points().
std::vector<MissedValue> missed_values(const Study& study, const Identifiability& what);

}  // namespace latsch::correlation
