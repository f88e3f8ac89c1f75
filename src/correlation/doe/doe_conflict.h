// SPDX-License-Identifier: Apache-2.0
// Conflict between what a study believes before its fit, the bounds of its variables and its model,
// and what was measured [M. Evans, H. Moshonov, Bayesian Analysis 1 (2006) 893]: measured values
// that no point of a scattered design comes near.
//
// A value is reached by a point if the two differ by at most kReach deviations of its noise; if no
// noise is stated, by at most kReach times 1 % of its scale. Values that no point reaches are of
// two kinds:
//   beyond    every point lies on one side of it: the model does not get there inside the bounds,
//             as far as the design shows
//   between   points lie on both sides of it: a finer design would reach it, and so would a fit
// The variable that moves the values beyond most is that with the largest slope of their mean
// distance, by a linear fit over the points in the unit cube.
//
// Limits: each value is judged by itself, and nuisance numbers are solved, as in the fit. A design
// of fewer than kPointsOfUnknown (n + 1) points is refused, because it leaves too much unseen.
#pragma once

#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "evaluation/journal/journal.h"

namespace latsch::correlation {

constexpr int kPointsOfUnknown = 10;  // fewest points for each variable and one more
constexpr double kReach = 3.0;        // deviations

/// Measured values of one experiment that no point reaches.
struct UnreachedValues {
  int experiment = 0;  // index in the study
  int values = 0;      // measured values that at least one point computed
  int beyond = 0, between = 0;
  std::string farthest;        // the value beyond all points by most; empty: none
  double farthest_by = 0.0;    // its distance to the nearest point, in deviations
  int mover = -1;              // variable that moves the values beyond most; -1: none
  bool is_raised = false;      // true if the values come nearer as it rises
  bool noise_assumed = false;  // true if no noise is stated
};

struct DoeConflict {
  std::vector<UnreachedValues> rows = {};  // one for each fitted experiment
  int points = 0;                          // points of the design that succeeded
  std::string refusal = {};                // why there is no statement; else empty
};

/// Returns the values that no point of the design reaches, from the trials of the journal.
DoeConflict doe_conflict(const Study& study,
                         const std::vector<DesignPoint>& points,
                         const Journal& journal);

/// Returns one row in words: "3 of 20 values beyond every point, 25 mm by 8.1 deviations; most
/// moved by matrix, which would have to be larger".
std::string in_words(const Study& study, const UnreachedValues& row);

}  // namespace latsch::correlation
