// SPDX-License-Identifier: Apache-2.0
// The levels at which a rig held a condition: loads, cambers, pressures, speeds of a recording.
//
// A rig holds a set point with noise, passes from one to the next, and drifts. The density of the
// values, smoothed by a Gaussian kernel of the condition's resolution h, has a peak at each level:
//   a peak counts      with a share of the samples of at least 1.5 %, as a passage has less
//   two peaks are one  where the density between them stays above 0.35 of the lower peak
// A condition that was swept has no peaks that stand apart: its values between two gaps reach over
// more than a set point's noise does. It has as many levels as a polynomial may ask for.
// [Silverman, Density Estimation, 1986, 2.4: kernel density; 6.2: counting modes]
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace latsch::numerics {

struct LevelResolution {
  double kernel = 0.0;  // h, in the unit of the values: less is not told apart
  double swept = 0.0;   // values of one level that reach over more than this were swept
};

struct DistinctLevels {
  std::vector<double> values;  // ascending: the median of each level
  bool is_swept = false;       // a level is a sweep: there are more than any polynomial needs

  /// How many a polynomial can be told by.
  int count() const {
    return is_swept ? std::numeric_limits<int>::max() : static_cast<int>(values.size());
  }
};

/// Values that are not finite do not count. No value has no level. The resolution is positive.
DistinctLevels distinct_levels(std::vector<double> values, const LevelResolution& resolution);

}  // namespace latsch::numerics
