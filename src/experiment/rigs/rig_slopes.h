// SPDX-License-Identifier: Apache-2.0
// Characteristic numbers of a K&C rig: the slope of the motion over a prescribed quantity x, which
// is that of a least-squares line with an intercept through the states in which x is in a window:
//   slope = Σ w_i y_i,    w_i = (x_i - x̄) / Σ (x_j - x̄)²                  i, j in the window
// The slope is linear in the motion y, so its own derivatives by a specimen's parameters are as
// exact as those of y. For a loop with equal states going up and down it is the slope of the middle
// line; for half a loop, the width of the friction loop contributes.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "measurement/channels.h"

namespace latsch::experiment {

struct SlopesBy {
  std::string by, unit;              // "Fz", "N"
  double from = -1e300, to = 1e300;  // SI, window of its values

  /// Returns a name such as "dz_by_Fz".
  std::string name(const std::string& moved) const { return moved + "_by_" + by; }
  /// Returns the unit of the slope: "m/N" if `moved` is in "m".
  std::string unit_of(const std::string& moved) const;
  /// Returns w; empty if x does not vary in the window.
  Eigen::VectorXd weights(const std::vector<double>& x) const;
};

/// A channel that is a regression slope, with the channel it is the slope of.
struct Regression {
  std::string of, unit;  // "dz", "m"
  SlopesBy slopes;
};

/// Adds the slopes of these channels, each with its own slopes in a specimen's numbers. The channel
/// of the abscissa exists and varies.
void add_slopes(const SlopesBy& slopes, const std::vector<std::string>& moved, Channels& channels);

/// Returns the channels without those slopes in a specimen's numbers that were not requested.
Channels with_slopes_of(const std::vector<std::string>& asked, const Channels& channels);

}  // namespace latsch::experiment
