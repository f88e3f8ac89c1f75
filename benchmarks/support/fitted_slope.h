// SPDX-License-Identifier: Apache-2.0
// The derivative of a function from values on both sides of a point, with an estimate of its error.
//
// The odd part of the values, (f(h) - f(-h)) / 2, is s h plus higher odd powers, where s is the
// derivative. Polynomials of odd powers are fitted to it by least squares, over several ranges of
// steps and with several degrees: wide steps and many steps reduce the effect of errors in the
// values, and higher powers represent the curvature. The fit with the least estimated error is
// chosen. The error is the larger of two numbers: the noise in the fit, whose parts add by squares
// because the errors of the values are independent; and the distance of the fit to those with one
// power less and with one step less. (Comparing with one power more underestimates the error: half
// of 300 derivatives were then farther off than estimated. Differences at halved steps,
// extrapolated power by power [Ridders, Adv. Eng. Software 4 (1982) 75-76], are worse for noisy
// values: each power needs a step and amplifies its error.)
#pragma once

#include <optional>
#include <vector>

namespace latsch::benchmarks {

struct FittedSlope {
  double value = 0.0, error = 0.0;  // estimated
  double reach = 0.0;               // widest step that the fit uses
};

/// Function values at the point minus a step and at the point plus a step.
struct StepValues {
  double step = 0.0, below = 0.0, above = 0.0;
};

/// Returns the derivative from these steps; `noise` is the error of each value. Returns nothing
/// with fewer than four steps.
std::optional<FittedSlope> fitted_slope(std::vector<StepValues> steps, double noise);

}  // namespace latsch::benchmarks
