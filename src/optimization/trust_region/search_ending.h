// SPDX-License-Identifier: Apache-2.0
// The reason why a search of the residual trust region ended, and what it claims of its end.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "optimization/problem/ending_claim.h"

namespace latsch {

enum class Ending {
  none,       // not ended
  verified,   // recomputed slopes predict no gain
  noise,      // recomputed slopes predict no gain above noise and ripple
  wide,       // predicts no gain, but a small share of a variable's range explains the scatter
  edge,       // steps that would improve the value fail
  rough,      // steps do not achieve the gain that recomputed slopes predict
  blind,      // the slope along some direction could not be computed
  known,      // the model's own derivatives predict no gain
  explained,  // the remaining residuals are a tiny share of the first ones
  hopeless    // no point has ever succeeded
};

/// Findings of the tests at the end of a search. Shares are those of the sum of squares S at the
/// best point unless stated otherwise; NaN: the test was not made.
struct EndingEvidence {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double promise = kNone;        // gain that the last model predicts
  double least_promise = kNone;  // gain below which a step is not worth a trial
  double deviation = kNone;      // standard deviation of S that is due to noise
  double contradiction = kNone;  // largest error of a promise that no later step outweighed
  double most_contradiction = kNone;
  /// Error of the residuals that the model predicted for a trial between the axes, as a share of
  /// their change.
  double model_error = kNone;
  double most_model_error = kNone;
  double shortest = kNone, longest = kNone;  // lengths of the moves for slopes, shares of a range
  double left = kNone;                       // S as a share of the first one
  double most_left = kNone;                  // limit of `left` for Ending::explained
  double left_of_data = kNone;               // root of S, as a share of the data's
  double most_left_of_data = kNone;          // limit of `left_of_data` for Ending::explained
  double noise_alone = kNone;                // S as a share of what the stated noise explains
  std::vector<std::string> open;             // variables that vanished residuals do not determine
  int failed_steps = 0;                      // steps in a row that failed

  struct Bounds {
    std::vector<std::string> lower = {}, upper = {};  // names of the variables there
    double slope = 0.0;                               // least ratio of a slope of S to its error
    double moved = 0.0;  // length of the move into the range, in widths
    double rise = 0.0;   // rise of S over it
  };
  std::optional<Bounds> bounds;

  struct Flat {
    std::vector<std::string> names = {};
    double change = 0.0;    // largest change of the residuals, as a share of their norm
    double farthest = 0.0;  // longest move, as a share of a range
  };
  std::optional<Flat> flat;

  struct OtherMinimum {
    double value = 0.0;     // its S
    double ridge = 0.0;     // S of a point between both ends, less that of the higher one
    double least = 0.0;     // ridge that counts
    double distance = 0.0;  // largest difference of a variable, as a share of its range
  };
  std::optional<OtherMinimum> other;
};

/// Returns the ending as the end of a sentence, with what was found of single variables.
std::string in_words(Ending ending, const EndingEvidence& evidence = {});

/// Returns the statements of in_words() with their tests and numbers.
std::vector<EndingClaim> claims_of(Ending ending, const EndingEvidence& evidence);

}  // namespace latsch
