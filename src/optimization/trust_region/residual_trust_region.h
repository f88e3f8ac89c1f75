// SPDX-License-Identifier: Apache-2.0
// Residual trust region: least sum of squares,  f(u) = |r(u)|^2,  from the residuals themselves,
// without derivatives: a trust region over kriging models of all residuals, curvature included.
//
// In the unit cube, around the best point c with a box of half widths h = radius w, w the widths of
// the variables (variable_scale.h), at first 1 (trust_box.h):
//
//   model     r_hat, a quadratic for every residual, kriged from all samples around, whoever asked
//             for them (a DOE, another method, an earlier run): residual_kriging.h.
//   geometry  where samples leave a direction unknown, a probe along it; at the start one for every
//             variable. A direction that is known poorly is probed when a step disappoints.
//   step      the least value to be expected, |r_hat|^2 and the variance with which the model knows
//             it, in box and bounds: box_least_squares.h; among linear constraints:
//             polytope_least_squares.h.
//             gain = (f(c) - f(u)) / (f(c) - expected(u))
//   radius    grows with steps whose gain is good, shrinks with steps whose gain is bad.
//   verify    where neither a step of the tolerance nor a model of good geometry promises anything,
//             slopes are taken afresh, at lengths that noise and ripple allow (natural_frame.h);
//             steps of the model they make are gone as long as they gain. In the noise once more,
//             three times as far: noise then counts a third. What a restart gains beyond that is
//             verified again only if it is more than noise makes of the target, or a tenth of it.
//   end       when they promise nothing any more. ending() says how. Restarts follow as long as
//             more is left than noise explains, where it is known, or than can be gained.
//
// A Failure closes off the region around it (residual_memory.h), failures together the half space
// behind a plane that parts them from successes (failure_edges.h): the step is looked for again
// among what is left, along the edge. A second failure in a row halves the radius. So does a point
// where residuals leap because values they are made of are gone (stand-ins, score.h); models are
// made of samples with as many of these. Noise shows in models that disappoint again and again
// although they interpolate: then they smooth, with the variance that is likeliest, and the radius
// grows where noise drowns the slopes. A search that chased noise into a small box is not verified
// at once: up to three times a run the box is widened to where curvature shows as much as noise
// does, and the search goes on from its best point with all it knows: a soft restart, without new
// probes. `restarts` starts again near the best point, a share of the initial radius off: out of a
// local minimum or out of the noise. The first one, if the run ended with variables on bounds,
// begins with these in the middle of their ranges: ranges are wider than what is thought possible,
// so a bound is mostly where a side valley ends. Where the run ended with directions of which the
// residuals feel nothing (flat_directions.h), n + 1 single points scout along them first, and the
// run starts from the one that is felt. Single variables of which nothing is felt are looked for
// farther off before that (lost_variables.h): from every place where they are felt again a trial of
// 3 (n + 1) evaluations starts afresh; the best of the trials and the run goes on. The trials count
// as restarts unless they brought a clearly better value. Where a Score brings a Jacobian, its
// slopes take the place of the geometry, and samples tell curvature alone: no probes, no fresh
// slopes at the end.
//
// Several at once: `outstanding` points are under way at any time. The second and later ones are
// steps in boxes of other sizes, then points around the best predicted one. Idle workers get what
// the method would ask next if outcomes were as predicted.
//
// After DFO-LS [Cartis, Fiala, Marteau, Roberts, ACM TOMS 45 (2019) 32] and POUNDERS [Wild, in:
// Advances and Trends in Optimization, SIAM 2017, ch. 40], but with other models, whose limits
// residual_kriging.h states. Made for residuals that are smooth, if noisy, functions; for
// targets with kinks or without residuals: gss.h.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Lengths are in the unit cube: 1 is the whole range of a variable.
struct ResidualTrustRegionOptions {
  double initial_radius = 0.1;
  double step_tolerance = 1e-3;
  /// How often it starts again after it ended, unless what is left of the sum of squares is less
  /// than `explained` of its first value and of what a move by the initial radius adds to it, mean
  /// of all directions, by the slopes at the best point: then it has found what it was sent for. A
  /// bad start alone explains nothing. Where noise is stated, it alone says what is left: by the
  /// walls of a narrow valley everything on its floor is next to nothing.
  int restarts = 4;
  double explained = 1e-3;
  /// What the noise of the measured values, where it is known, makes of the sum of squares at the
  /// true values, with two standard deviations: for m residuals in units of their noise
  /// m + 2 sqrt(2 m). At or below it nothing better can be told from noise, and no restart follows
  /// [Morozov's discrepancy principle]; above it restarts do. 0: not known.
  double noise_alone = 0.0;
  /// Points the method decides on before it knows the outcome of the first of them: part of the
  /// method, so that its trajectory does not depend on the workers. 1 needs the fewest evaluations,
  /// a quarter more than there are workers the least time.
  int outstanding = 1;
  std::uint64_t seed = 1;  // of restarts and of points around predicted ones
};

class LostVariableTrials;

class ResidualTrustRegion : public Optimizer {
 public:
  /// Starts at the initial values of the space. Throws InputError for options out of range.
  explicit ResidualTrustRegion(const DesignSpace& space,
                               const ResidualTrustRegionOptions& options = {});
  ~ResidualTrustRegion() override;

  std::vector<DesignPoint> propose(int count) const override;
  /// Throws InputError for a score without residuals. One with another number of them than the
  /// first counts as a Failure.
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;
  std::string ending() const override;

 private:
  std::unique_ptr<LostVariableTrials> search_;
};

}  // namespace latsch
