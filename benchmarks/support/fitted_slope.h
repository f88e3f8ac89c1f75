// SPDX-License-Identifier: Apache-2.0
// A slope from values to both sides of a point, and how far it may be off.
//
// What is odd in them, (f(h) - f(-h)) / 2, is s h and odd powers beyond. Polynomials of odd powers
// are fitted to it in the sense of least squares, over several reaches and to several degrees: wide
// steps drown what values are off, many of them average it, powers take what bends. Of all fits
// that one is taken whose estimated error is least: the largest of the noise in it, which adds by
// squares, for values err each for itself, and of its distance to the fits of one power and of one
// step less. (One power more in their place says too little: half of 300 slopes were then farther
// off than said. Differences at halved steps, extrapolated power by power [Ridders, Adv. Eng.
// Software 4 (1982) 75-76], know less of noisy values: each power takes a step and enlarges what
// that is off.)
#pragma once

#include <optional>
#include <vector>

namespace latsch::benchmarks {

struct FittedSlope {
  double value = 0.0, error = 0.0;  // estimated
  double reach = 0.0;               // of the fit: its widest step
};

/// Values at the point minus and plus a step.
struct StepValues {
  double step = 0.0, below = 0.0, above = 0.0;
};

/// `noise`: what values may be off. Nothing of less than four steps.
std::optional<FittedSlope> fitted_slope(std::vector<StepValues> steps, double noise);

}  // namespace latsch::benchmarks
