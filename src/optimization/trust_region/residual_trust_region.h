// SPDX-License-Identifier: Apache-2.0
// Residual trust region: minimizes a sum of squares,  f(u) = |r(u)|^2,  from the residuals
// themselves, without derivatives. It uses a trust region over kriging models of all residuals,
// with curvature.
//
// Let c be the best point in the unit cube, in a box of half widths h = radius w. The widths w of
// the variables (variable_scale.h) are 1 at first (trust_box.h):
//
//   model     r_hat, a quadratic for every residual, kriged from all samples around, whoever
//             proposed them (a design of experiments, another method, an earlier run):
//             residual_kriging.h.
//   geometry  If samples leave a direction unknown, a point along it (a probe) is evaluated; at the
//             start one for every variable. If a step disappoints, poorly known directions are
//             probed, too.
//   step      The minimum of the expected value, |r_hat|^2 plus the variance of the model, in box
//             and bounds: box_least_squares.h; with linear constraints: polytope_least_squares.h.
//             gain = (f(c) - f(u)) / (f(c) - expected(u))
//   radius    It grows after steps with a good gain and shrinks after steps with a bad gain.
//   verify    If neither a step of the tolerance nor a model of good geometry predicts a gain,
//             slopes are recomputed over lengths that suit noise and ripple (natural_frame.h), and
//             steps of the resulting model are taken as long as they gain. At noise level this is
//             repeated over three times the distance, which reduces the weight of noise to a third.
//             If a restart later improves the value, it is verified again only if the improvement
//             exceeds the effect of noise on the target, or a tenth of the target.
//             A minimum is claimed only if the slopes have proved right: no step gained far less
//             than promised unless a later one gained what it promised, and a trial away from the
//             axes has the residuals that the model predicts (fresh_slopes.h).
//   end       The search ends if these steps predict no gain. ending() reports the reason. Restarts
//             follow as long as the residuals exceed what noise explains, if noise is known, or
//             what can be gained.
//
// If a point fails, the region around it is avoided (residual_memory.h). If several points fail,
// the half space beyond a plane that separates them from successes is avoided (failure_edges.h):
// the minimum is then sought in the remaining region, so that steps follow the edge. A second
// failure in a row halves the radius. The radius is also halved if residuals jump because values
// they are computed from are missing (stand-ins, score.h); a model uses samples with equally many
// stand-ins.
//
// Noise is recognized by models that disappoint again and again although they interpolate. The
// models then smooth, with the most likely variance, and the radius grows if noise exceeds the
// slopes. If noise led a search into a small box, it is not verified at once: up to three times in
// a run the box is widened until curvature is as large as noise, and the search continues from its
// best point with all its samples. This is a soft restart without new probes.
//
// A restart begins near the best point, at a distance of a share of the initial radius, to leave a
// local minimum or the noise. If the run ended with variables on bounds, the first restart moves
// these to the middle of their ranges: users choose ranges wider than they think possible, so a
// bound is usually the end of a side valley. If the run ended with directions of no effect on the
// residuals (flat_directions.h), up to n + 1 single points along them are evaluated first, and the
// run starts from one with an effect. Before that, single variables without effect are moved
// farther away (lost_variables.h): from every point at which they have an effect again, a trial of
// 3 (n + 1) evaluations starts afresh, and the best of the trials and the run continues. The trials
// count as restarts unless they brought a clearly better value.
//
// If a Score contains a Jacobian, its slopes replace the probes, and samples contribute only
// curvature: there are no probes and no recomputed slopes at the end.
//
// Parallel evaluation: `outstanding` points are being evaluated at any time. At the start they are
// the start, the probes, and points at two to six radii in random directions. Later they are a
// step, probes beside its end, along directions in which the slope would be known least there,
// steps in boxes of other sizes, and points around the best predicted one. Nothing is concluded
// from a model while outcomes are awaited that may change it. Idle workers evaluate the points that
// the method would propose next if outcomes were as predicted.
//
// The method follows DFO-LS [Cartis, Fiala, Marteau, Roberts, ACM TOMS 45 (2019) 32] and POUNDERS
// [Wild, in: Advances and Trends in Optimization, SIAM 2017, ch. 40], but with other models, whose
// limits are stated in residual_kriging.h. It suits residuals that are smooth, possibly noisy,
// functions; for targets with kinks or without residuals use gss.h.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Options of the search. Lengths are in the unit cube: 1 is the whole range of a variable.
struct ResidualTrustRegionOptions {
  double initial_radius = 0.1;  // half width of the first box
  /// The search ends if the box is smaller and no step predicts a gain.
  double step_tolerance = 1e-3;
  /// Number of restarts after the search ended. There is no restart if the remaining sum of squares
  /// is less than `explained` times its first value and also less than `explained` times its mean
  /// increase over a move by the initial radius in a random direction, computed from the slopes at
  /// the best point. So a bad start alone does not end the search. If noise is stated, only the
  /// noise decides: compared with the walls of a narrow valley, all values on its floor are small.
  int restarts = 4;
  double explained = 1e-3;  // see restarts
  /// Expected sum of squares at the true values that the noise of the measured values causes, plus
  /// two standard deviations: m + 2 sqrt(2 m) for m residuals in units of their noise. At or below
  /// this value a better point cannot be distinguished from noise, and no restart follows
  /// [Morozov's discrepancy principle]; above it restarts follow. 0: not known.
  double noise_alone = 0.0;
  /// Sum of squares of errors as large as the data themselves. At its end the search says that
  /// nothing is left only if the root mean square of the residuals is at most 1e-7 of the data's.
  /// 0: not known; the first value then serves as the scale.
  double square_of_data = 0.0;
  /// Number of points that the method proposes before it knows the outcome of the first of them. It
  /// is part of the method, so that the path does not depend on the number of workers. The value 1
  /// needs the fewest evaluations; a value a quarter above the number of workers needs the least
  /// time.
  int outstanding = 1;
  std::uint64_t seed = 1;  // seed of the random choices of restarts and additional points
  /// True: trials at the end show what may be said of it (trust_region_run.h). Searches that serve
  /// another method, which nobody asks for their endings, save them.
  bool tests_end = true;
};

class LostVariableTrials;

class ResidualTrustRegion : public Optimizer {
 public:
  /// Starts at the initial values of the space. Throws InputError for options out of range.
  explicit ResidualTrustRegion(const DesignSpace& space,
                               const ResidualTrustRegionOptions& options = {});
  ~ResidualTrustRegion() override;

  std::vector<DesignPoint> propose(int count) const override;
  /// Throws InputError for a score without residuals. A score with another number of residuals than
  /// the first one counts as a Failure.
  void observe(const DesignPoint& point, const Result<Score>& outcome) override;
  bool converged() const override;
  std::string ending() const override;
  std::vector<EndingClaim> claims() const override;
  std::optional<double> promise() const override;

 private:
  std::unique_ptr<LostVariableTrials> search_;
};

}  // namespace latsch
