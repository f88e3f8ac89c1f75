// SPDX-License-Identifier: Apache-2.0
// Constants of the residual trust region (residual_trust_region.h). They were chosen on hundreds of
// varied problems (./bench.sh more_wild_varied); docs/notebook/trust_region.md reports the
// alternatives that were tried. The options that a user may set are in ResidualTrustRegionOptions.
// A "share" lies between 0 and 1; a "value" is one of the target, the sum of squares.
#pragma once

#include <array>

namespace latsch {

/// Constants for probing. A direction is probed if samples leave a large share of the variance of
/// its slopes.
struct GeometryTuning {
  /// Share above which a direction is probed before any step. A smaller one probes more.
  double unknown = 0.5;
  /// Share above which a direction is probed if a step disappoints or none is found. A direction
  /// with no sample within 7 radii has this share.
  double poor = 0.02;
  /// Share above which a direction is probed at the end of a step whose outcome is awaited.
  double beside = 0.05;
};

struct RadiusTuning {
  /// Gain of a step relative to the predicted one, above which the radius may grow.
  double good_gain = 0.5;
  /// Gain relative to the predicted one below which the radius shrinks; less than `good_gain`.
  double bad_gain = 0.1;
  /// Ratio of the radius to the step's length after a good gain: at least `growth`, at most
  /// `most_growth`, both above 1.
  double growth = 2.0, most_growth = 4.0;
  /// Share by which the radius is multiplied after a bad gain: at most `shrinkage`, at least
  /// `most_shrinkage`.
  double shrinkage = 0.7, most_shrinkage = 0.1;
  /// Length of a step relative to the radius, at least 1, up to which the gain of the step changes
  /// the radius.
  double own_steps = 1.01;
  /// Largest radius: half the width of the unit cube.
  double widest = 0.5;
  /// Factor of the radius if no step in its box is worth an evaluation; the second one applies to
  /// noisy residuals, whose model promises less than it finds.
  double without_step = 0.1, without_step_in_noise = 0.5;
  /// Factor of the radius after a bad gain of a step that promised less than noise scatters the
  /// target: such an outcome says little about the model.
  double below_noise = 0.9;

  /// After this number of failures in a row, each further failed step multiplies the radius by
  /// `after_failures`.
  int failures_to_shrink = 2;
  double after_failures = 0.5;
  /// After this number of failures in a row, each further one multiplies the radius by
  /// `after_giving_up`, and no more probes are made around the center.
  int failures_to_give_up = 4;
  double after_giving_up = 0.1;

  /// After this number of disappointing steps in a row, the model estimates the noise.
  int disappointments = 1;
  /// Ratio of noise to curvature, above 1, from which on noise counts as large as the slopes. The
  /// radius is then doubled, at most `widenings_an_outcome` times before the next outcome.
  double drowned = 1e4;
  int widenings_an_outcome = 1;
  /// Largest number of times in a run that a box too small for the noise is widened.
  int widenings = 3;
};

struct SearchTuning {
  /// Radius, as a share of the initial radius, below which a model that predicts no step is
  /// believed.
  double settled = 0.1;
  /// Sizes of the boxes in which steps are sought, in radii. The first one is for the next step,
  /// the others for further steps while the outcome of the first is outstanding.
  std::array<double, 8> boxes{1.0, 0.25, 2.0, 4.0, 0.5, 0.1, 0.03, 0.01};
  /// Largest number of steps from one center whose outcomes are awaited at a time; fewer if less
  /// than 20 points are outstanding.
  int most_steps = 6;
  /// Share of the first value below which nothing is left to gain; the residuals are then a
  /// ten-thousandth of the first ones.
  double nothing_left = 1e-8;
  /// Share of the data's sum of squares below which nothing is left to say the least: the residuals
  /// are then a ten-millionth of the data. A larger one calls a fit exact that is not, a smaller
  /// one asks for more digits than simulations have.
  double nothing_left_of_data = 1e-14;
  /// Number of failures, in units of n + 1 for n variables, after which a run that never succeeded
  /// ends.
  int hopeless = 20;
  /// Largest number of random points that are examined for a start that is feasible and has not
  /// failed yet. In a thin region many are infeasible.
  int tries = 100;
};

/// Slopes recomputed at the end of a search (fresh_slopes.h).
struct VerificationTuning {
  /// Shortest move for recomputed slopes, as a share of the step tolerance.
  double shortest = 0.1;
  /// Share of the value at the beginning of a round. If a step with a good gain leads to a lower
  /// value, a new search starts.
  double worth_a_search = 0.5;
  /// Share of the value that was verified last. A lower value is verified again, however large the
  /// noise is.
  double beyond_noise = 0.9;
};

struct RestartTuning {
  /// Distances of successive restarts from the best point, in initial radii.
  std::array<double, 4> jumps{0.1, 1.0, 0.03, 0.3};
  /// Share of the best value at the last time the run settled, or variables on bounds were
  /// released. If the value is lower, this is done once more.
  double worth_a_look = 0.9;
  /// Distance from a bound, in widths of the unit cube, within which a variable lies on it.
  double at_bound = 1e-9;
};

struct TrustRegionTuning {
  GeometryTuning geometry;
  RadiusTuning radius;
  SearchTuning search;
  VerificationTuning verification;
  RestartTuning restarts;
};

}  // namespace latsch
