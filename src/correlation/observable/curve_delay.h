// SPDX-License-Identifier: Apache-2.0
// The delay of a measured curve behind the simulated one, a number of the recording and not of the
// model: clocks of rigs and tests begin at different moments.
//
//   [experiment.passage]
//   kind = "curve"
//   x = "cleat/time"                   # a time
//   y = "cleat/Fz"
//   measurement = "passage"
//   nuisance = {delay = "free"}        # fitted at every trial; default: none
//
// Sample i, recorded at t_i, is compared with the simulated y(t_i - tau). At every trial tau is the
// one for which the sum of the squared differences d_i(tau) is least:
//   - between a tenth of the record before and behind, as far as the simulation reaches around the
//     measured samples,
//   - the best of a grid no wider than a simulated step, then Gauss-Newton steps
//     tau - a'd / a'a  with  a_i = d d_i / d tau,  which end exactly because y is linear between
//     its samples.
// It is solved and not searched: it costs no trial. Slopes of the differences by the variables of
// the model lose their part along a [variable projection: G. Golub, V. Pereyra, SIAM Journal on
// Numerical Analysis 10, 1973; L. Kaufman, BIT 15, 1975],
//   d' = J - a (a'J) / a'a,   and the delay moves by  -(a'J) / a'a.
//
// Limits: of `values` and `about_mean`; a spectrum knows no delay. A signal that repeats itself
// within a fifth of the record has several delays that are nearly as good.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace latsch::correlation {

/// The delay of one trial.
struct FittedDelay {
  double value = 0.0;      // s; positive: recorded later than simulated
  double stiffness = 0.0;  // a'a, 1/s^2, of differences in units of their scale: the deviation of
                           // the delay at given variables is that of a difference over its root
  bool at_end = false;     // the least sum of squares lies at an end of the range
  std::vector<double> slopes = {};  // d delay / d variable, s; empty: not known
};

/// Differences d_i at a delay and their derivative by it.
struct DelayedDifferences {
  std::vector<double> d, by_delay;
};

/// The shifts that are tried, s: lower <= upper.
struct DelayRange {
  double lower = 0.0, upper = 0.0;
  double step = 0.0;  // of the grid
};

/// The delay of the least sum of squares.
FittedDelay fit_delay(const DelayRange& range,
                      const std::function<DelayedDifferences(double)>& differences);

/// Takes the part along by_delay out of slopes, one column of by_delay.size() rows a variable, both
/// of the same values, and gives the delay its own slopes.
void project_out(const std::vector<double>& by_delay,
                 std::vector<double>& slopes,
                 FittedDelay& delay);

/// A tenth of the record to both sides, as far as the simulated times reach around the measured
/// ones; nullopt if that leaves no room for a delay. Times rise, s.
std::optional<DelayRange> delay_range(const std::vector<double>& measured,
                                      const std::vector<double>& simulated);

}  // namespace latsch::correlation
