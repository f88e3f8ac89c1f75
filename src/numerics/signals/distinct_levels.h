// SPDX-License-Identifier: Apache-2.0
// Levels at which a test rig held a condition during a recording: loads, cambers, pressures,
// speeds.
//
// A rig holds a set point with noise, changes from one to the next, and drifts. The density of the
// values, smoothed by a Gaussian kernel of the condition's resolution h, has a peak at each level:
//   a peak counts      if it has at least 1.5 % of the samples; a transition has fewer
//   two peaks are one  if the density between them stays above 0.35 of the lower peak
// A swept condition has no separate peaks: its values between two gaps extend over more than the
// noise of a set point. It counts as having any number of levels.
// [Silverman, Density Estimation, 1986, 2.4: kernel density; 6.2: counting modes]
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace latsch::numerics {

struct LevelResolution {
  /// Width h of the kernel, in the unit of the values; smaller differences are not resolved.
  double kernel = 0.0;
  double swept = 0.0;  // span of the values of one level above which it counts as swept
};

struct DistinctLevels {
  std::vector<double> values;  // median of each level, ascending
  /// True if a level is a sweep, which supports a polynomial of any degree.
  bool is_swept = false;

  /// Number of levels available to determine a polynomial.
  int count() const {
    return is_swept ? std::numeric_limits<int>::max() : static_cast<int>(values.size());
  }
};

/// Ignores values that are not finite. Without values there are no levels. The resolution must be
/// positive.
DistinctLevels distinct_levels(std::vector<double> values, const LevelResolution& resolution);

}  // namespace latsch::numerics
