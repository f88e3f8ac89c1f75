// SPDX-License-Identifier: Apache-2.0
// Measured values that the model misses at the point found: which variable would mend each most
// easily, and which other value would pay for it, to first order, from the derivatives that the
// intervals have.
//
// A value is missed by more than three times its stated noise, 1 % where none is stated. Left out
// are experiments of more than twenty values, of which no single one is worth mending, and those of
// a robust loss, for which a value far off is none of the tire's.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"

namespace latsch::correlation {

struct MissedValue {
  struct Error {
    std::string name;              // "frequency, radial n=2"
    double error;                  // simulated less measured, in what counts as 100 %
    std::string in_words() const;  // "4.7 % too low"
  };
  Error missed;
  bool fitted = true;
  std::optional<int> variable = {};  // that moves it most; none where none does
  double effect = 0.0;               // of that variable's whole range, on the error
  bool within_bounds = true;         // whether it can mend it alone
  std::optional<Error> payer = {};  // the other fitted value that would suffer most, as it would be

  std::string in_words(const DesignSpace& space) const;
};

/// In the order of the study; of experiments with use = "predict" as far as they were simulated at
/// prediction_points().
std::vector<MissedValue> missed_values(const Study& study, const Identifiability& what);

}  // namespace latsch::correlation
