// SPDX-License-Identifier: Apache-2.0
// Nuisance numbers of one recording, as one trial solved them (correlation/nuisance).
#pragma once

#include <cmath>
#include <string>
#include <vector>

namespace latsch::correlation {

enum class NuisanceKind { offset, gain, delay, x_offset };

/// Returns the name of a number as a study states it: "offset", "x_offset".
std::string name_of(NuisanceKind kind);

/// One nuisance number at its best value in one trial, SI.
struct SolvedNumber {
  NuisanceKind kind = NuisanceKind::offset;
  double value = 0.0;
  double prior = INFINITY;  // standard deviation of its prior, SI; infinite: "free"
  /// Standard deviation of the number at given variables, SI, if a weighted residual has the
  /// deviation 1. It is 0 for a number that the recording does not determine.
  double deviation = 0.0;
  bool at_end = false;                         // true if a shift lies at an end of its range
  double lower = -INFINITY, upper = INFINITY;  // range of a shift that was solved, SI
  bool is_determined = true;         // false: the recording says nothing about it; the value is 0
  std::vector<double> slopes = {};   // d value / d variable; empty: not known
  std::vector<double> columns = {};  // d difference / d value, one for each measured value

  bool is_free() const { return !std::isfinite(prior); }
};

}  // namespace latsch::correlation
