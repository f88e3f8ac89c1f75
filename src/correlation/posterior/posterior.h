// SPDX-License-Identifier: Apache-2.0
// Samples of the posterior density of a study's variables, around a finished fit: applies
// surrogate_runs.h to the residuals, the journal and the executor of a study.
//
// The density is that of residuals.h after whitening: each measured value has the stated noise, or
// noise of an unknown common size, and neighbors share it as residual_noise.h estimates; stated
// priors; uniform in the unit cube inside bounds and linear constraints. Weights are no noise and
// do not enter. The noise of neighbors is taken as estimated at the fit; that this estimate is
// uncertain, too, does not widen the samples.
//
// Nuisance numbers of recordings (nuisance_solver.h) are integrated out: the squares at their best
// values, those of their priors included, are -2 times the logarithm of the integral, up to a
// determinant that is constant where the numbers enter linearly with fixed columns. Of a gain or a
// shift the columns are the simulated curve and its slope, whose change over the posterior is left
// out. If the size of the noise is unknown, each number takes one of the m values.
//
// The trials beyond the fit are ordinary trials of the journal, so an interrupted sampling
// continues, and a finished one is read without running anything. A mark in the journal stores
// where the sampling began: the point, and the number of trials that the surrogate may learn from.
// Samples depend on the journal up to that mark, on the study and its seed alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"
#include "correlation/posterior/predictive_check.h"
#include "correlation/posterior/sampled_bands.h"
#include "optimization/posterior/posterior_words.h"
#include "optimization/posterior/surrogate_runs.h"

namespace latsch::correlation {

/// Samples of a study, and what was tested about them.
struct Posterior {
  DesignPoint center;     // the fit around which the density is sampled
  std::vector<int> axes;  // indices of the variables that were sampled
  PosteriorMethod method = PosteriorMethod::surrogate;  // states whose density the samples have
  PosteriorSamples samples;                             // one row of u for each of the axes
  std::vector<PosteriorShape> shapes;                   // one for each of the axes
  std::vector<Interval> linear;  // linear 95 % intervals of the axes, in the unit cube
  SurrogateCheck check;
  int trials = 0;        // trials beyond the fit, those of check and chains included
  int chain_trials = 0;  // those of them by which the model decided on proposals of the chains
  int failed = 0;        // those of them that failed
  int learned_from = 0;  // trials from which the surrogate was made
  bool settled = false;  // false: the limit of trials ended the batches
  bool noise_stated = false;
  std::vector<std::string> remarks;     // sentences about the density
  std::vector<SampledBand> bands;       // bands of computed values, one for each fitted experiment
  std::vector<PredictiveCheck> checks;  // one for each fitted experiment

  /// True if the chains mix in every variable. If they do not, neither ends nor shapes are those of
  /// the density.
  bool is_mixed() const { return samples.unmixed.empty(); }
  /// True if the samples may be shown as those of the model: the chains mix, and the model itself
  /// decided, or the check did not refuse the surrogate.
  bool stands_for_model() const {
    return is_mixed() &&
           (method != PosteriorMethod::surrogate || check.verdict != SurrogateVerdict::refused);
  }
  /// Returns the point of sample k; variables that were not sampled keep their value.
  DesignPoint point(const DesignSpace& space, Eigen::Index k) const;
  /// Returns the value, SI, of the sampled variable `axis` at the place u of the unit cube.
  double value_at(const DesignSpace& space, std::size_t axis, double u) const;
};

/// Returns the reason why the study has no posterior density that could be sampled, in one
/// sentence; empty if it has one.
std::string why_no_posterior(const Study& study);

/// Samples the density around the best trial of the journal. Returns nullopt if a stop was
/// requested, a Failure if there is no derivative or no density at the fit.
std::optional<Result<Posterior>> sample_posterior(const Study& study,
                                                  const DesignPoint& best,
                                                  Executor& executor,
                                                  Journal& journal,
                                                  const RunOptions& options);

/// Returns the samples that the journal determines without further trials; nullopt if trials are
/// missing.
std::optional<Posterior> recorded_posterior(const Study& study, const Journal& journal);

/// Returns the verdict of the check in one sentence that says no more than it showed.
std::string verdict_text(const Posterior& posterior);

/// Returns names of the sampled variables, in the order of the axes.
std::vector<std::string> axis_names(const Study& study, const Posterior& posterior);

}  // namespace latsch::correlation
