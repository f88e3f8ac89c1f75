// SPDX-License-Identifier: Apache-2.0
// Characteristic numbers of a K&C rig: the slope of what moves by what is prescribed, of a line
// through the states in which that is in a window, by least squares with an intercept:
//   slope = Σ w_i y_i,    w_i = (x_i - x̄) / Σ (x_j - x̄)²                  i, j in the window
// Linear in y, so its own slopes in a specimen's numbers are as exact as those of y. Of a loop that
// goes up and down alike it is the slope of the middle line; of one half, the friction's width
// counts.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "measurement/channels.h"

namespace latsch::experiment {

struct SlopesBy {
  std::string by, unit;              // "Fz", "N"
  double from = -1e300, to = 1e300;  // of its values; SI

  /// "dz_by_Fz"
  std::string name(const std::string& moved) const { return moved + "_by_" + by; }
  /// "m/N" of "m"
  std::string unit_of(const std::string& moved) const;
  /// w; empty where x does not vary in the window.
  Eigen::VectorXd weights(const std::vector<double>& x) const;
};

/// A channel that is such a slope, and of which channel.
struct Regression {
  std::string of, unit;  // "dz", "m"
  SlopesBy slopes;
};

/// Adds the slopes of these channels, each with its own slopes in a specimen's numbers. The channel
/// that they are by is there and varies.
void add_slopes(const SlopesBy& slopes, const std::vector<std::string>& moved, Channels& channels);

/// The same without what was not asked for of slopes in a specimen's numbers.
Channels with_slopes_of(const std::vector<std::string>& asked, const Channels& channels);

}  // namespace latsch::experiment
