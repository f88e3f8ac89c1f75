// SPDX-License-Identifier: Apache-2.0
// Numbers that steer the residual trust region (residual_trust_region.h). They were chosen on
// hundreds of varied problems (./bench.sh more_wild_varied); docs/notebook/trust_region.md has what
// was tried. A user sets those of ResidualTrustRegionOptions. "Share" is between 0 and 1; a value
// is that of the target, the sum of squares.
#pragma once

#include <array>

namespace latsch {

/// A direction is probed if samples leave a large share of the variance of its slopes.
struct GeometryTuning {
  /// Share above which a direction is probed before any step. A smaller one probes more.
  double unknown = 0.5;
  /// Share above which a direction is probed if a step disappoints or none is found: that of a
  /// direction without a sample within 7 radii.
  double poor = 0.02;
};

struct RadiusTuning {
  /// Gain of a step relative to the predicted one, above which the radius may grow.
  double good_gain = 0.5;
  /// Gain below which the radius shrinks, less than `good_gain`.
  double bad_gain = 0.1;
  /// Radius after a good gain relative to the step's length: at least `growth`, at most
  /// `most_growth`, both above 1.
  double growth = 2.0, most_growth = 4.0;
  /// Share of the radius that is left after a bad gain: at most `shrinkage`, at least
  /// `most_shrinkage`.
  double shrinkage = 0.7, most_shrinkage = 0.1;
  /// Length of a step relative to the radius, at least 1, up to which its gain judges the radius.
  double own_steps = 1.01;
  /// Largest radius: half the width of the unit cube.
  double widest = 0.5;
  /// Share of the radius that is left if its box has no step.
  double without_step = 0.1;

  /// Number of failures in a row from which on a failed step shrinks the radius to the share
  /// `after_failures`.
  int failures_to_shrink = 2;
  double after_failures = 0.5;
  /// Number of failures in a row from which on each shrinks the radius to the share
  /// `after_giving_up`, and the center gets no more probes.
  int failures_to_give_up = 4;
  double after_giving_up = 0.1;

  /// Number of disappointing steps in a row from which on the model estimates noise.
  int disappointments = 3;
  /// Noise relative to curvature, above 1, at which it is as large as the slopes: the radius is
  /// doubled, at most `widenings_an_outcome` times before the next outcome.
  double drowned = 1e4;
  int widenings_an_outcome = 1;
  /// Most widenings of a box that is too small for the noise, in a run.
  int widenings = 3;
};

struct SearchTuning {
  /// Share of the initial radius below which a model without a step is believed.
  double settled = 0.1;
  /// Sizes of the boxes in which steps are sought, in radii. Those after the first are for further
  /// steps while the outcome of the first one is awaited.
  std::array<double, 8> boxes{1.0, 0.25, 2.0, 0.5, 0.1, 4.0, 0.03, 0.01};
  /// Share of the first value, a ten-thousandth of the residuals, below which nothing is left to
  /// gain.
  double nothing_left = 1e-8;
  /// Number of failures, in units of n + 1 for n variables, after which a run that never succeeded
  /// ends.
  int hopeless = 20;
  /// Most random points that are tried for a start that is feasible and has not failed yet. Many
  /// may be infeasible in a thin region.
  int tries = 100;
};

/// Slopes recomputed at the end of a search (fresh_slopes.h).
struct VerificationTuning {
  /// Shortest move for slopes relative to the step tolerance, a share.
  double shortest = 0.1;
  /// Share of the value at the beginning of a round; a good gain to below it starts a new search.
  double worth_a_search = 0.5;
  /// Share of the value that was verified last; a value below it is verified again whatever the
  /// noise.
  double beyond_noise = 0.9;
};

struct RestartTuning {
  /// Distances of restarts from the best point, one after the other, in initial radii.
  std::array<double, 4> jumps{0.1, 1.0, 0.03, 0.3};
  /// Share of the value at the last time; a value below it is worth that the run settles, or that
  /// variables on bounds are released, once more.
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
