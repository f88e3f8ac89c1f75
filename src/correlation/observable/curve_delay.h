// SPDX-License-Identifier: Apache-2.0
// Delay of a measured curve behind the simulated one. It belongs to the recording, not to the
// model: the clocks of rigs and tests start at different moments.
//
// Sample i, recorded at t_i, is compared with the simulated y(t_i - tau). At every trial, tau
// minimizes the sum of the squared differences d_i(tau):
//   - tau lies within a tenth of the record before or behind, as far as the simulation covers the
//     measured samples;
//   - the best of a grid no wider than a simulated step is refined by Gauss-Newton steps
//     tau - a'd / a'a  with  a_i = d d_i / d tau,  which end exactly because y is linear between
//     its samples.
// The delay is solved for, not searched, so it costs no trial. Slopes of the differences by the
// variables of the model lose their part along a [variable projection: G. Golub, V. Pereyra, SIAM
// Journal on Numerical Analysis 10, 1973; L. Kaufman, BIT 15, 1975],
//   d' = J - a (a'J) / a'a,   and the delay moves by  -(a'J) / a'a.
//
// Limits: only `values` and `about_mean` have a delay; a spectrum does not depend on it. A signal
// that repeats itself within a fifth of the record has several delays that are nearly as good.
//
// The keys are in correlation/observable/keys/curve_delay_keys.cpp.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace latsch::correlation {

/// Delay of the simulation relative to the measurement in one trial.
struct FittedDelay {
  double value = 0.0;  // s; positive: recorded later than simulated
  /// The sum a'a, 1/s^2, for differences in units of their scale. The standard deviation of the
  /// delay at given variables is that of a difference divided by the square root of this number.
  double stiffness = 0.0;
  bool at_end = false;              // true if the least sum of squares lies at an end of the range
  std::vector<double> slopes = {};  // d delay / d variable, s; empty: not known
};

/// Differences d_i at a delay and their derivatives by it.
struct DelayedDifferences {
  std::vector<double> d, by_delay;
};

/// Range of the shifts that are tried, s: lower <= upper.
struct DelayRange {
  double lower = 0.0, upper = 0.0;
  double step = 0.0;  // step of the grid, s
};

/// Returns the delay with the least sum of squares.
FittedDelay fit_delay(const DelayRange& range,
                      const std::function<DelayedDifferences(double)>& differences);

/// Removes from `slopes` the part along by_delay and sets the derivatives of the delay. `slopes` is
/// a matrix with by_delay.size() rows and one column for each variable.
void project_out(const std::vector<double>& by_delay,
                 std::vector<double>& slopes,
                 FittedDelay& delay);

/// Returns the range of delays, s: a tenth of the record in either direction, as far as the
/// simulated times cover the measured ones. Returns nullopt if no range is left. Times must rise,
/// s.
std::optional<DelayRange> delay_range(const std::vector<double>& measured,
                                      const std::vector<double>& simulated);

}  // namespace latsch::correlation
