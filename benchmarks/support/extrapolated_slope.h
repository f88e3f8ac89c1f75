// SPDX-License-Identifier: Apache-2.0
// A slope from values beside a point, and how far it may be off: differences at several steps,
// extrapolated to a step of zero.
//
// Central differences err by even powers of the step. Each extrapolation removes one of them and
// enlarges what the values are off; of all of them that one is taken whose estimated error is
// least: the larger of its distance to its two predecessors and of the noise in it, which adds by
// squares, for values err each for itself. (In the polynomials below it may not: their changes say
// less of what powers leave, and of 300 slopes half were then farther off than said.) [Ridders,
// Accurate computation of F'(x) and F'(x) F''(x), Adv. Eng. Software 4 (1982) 75-76]
//   Where one side is known over small steps alone, or not at all, extrapolated differences of the
// other would enlarge noise by what they remove. There polynomials are fitted to all values there
// are, over several reaches: their error is the larger of the noise in them, at its worst, and of
// what one more power and a nearer reach change.
#pragma once

#include <optional>
#include <vector>

namespace latsch::benchmarks {

struct ExtrapolatedSlope {
  double value = 0.0, error = 0.0;  // estimated
  bool one_sided = false;
};

/// Values at the point minus and plus a step; none where they belong to another branch.
struct StepValues {
  double step = 0.0;
  std::optional<double> below, above;
};

/// `steps` descending; `at`: the value at the point; `noise`: what values may be off. Nothing where
/// no side has three steps; one-sided where less than three have both.
std::optional<ExtrapolatedSlope> extrapolated_slope(const std::vector<StepValues>& steps,
                                                    double at,
                                                    double noise);

/// A value beside the point.
struct PlacedValue {
  double x = 0.0, value = 0.0;
};

/// The slope at zero of polynomials through many values evenly to both sides, in the sense of least
/// squares: what noise there is, their scatter tells. The error is three standard deviations of it
/// or twice what two more powers change, of the degree for which that is least. At least 16 values.
ExtrapolatedSlope fitted_slope(const std::vector<PlacedValue>& values);

}  // namespace latsch::benchmarks
