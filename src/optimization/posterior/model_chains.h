// SPDX-License-Identifier: Apache-2.0
// Chains whose every accepted place was decided by the model itself, so that their samples are
// those of the model however wrong a surrogate is.
//
// Ask and tell, in rounds: the walkers of one half propose, the model evaluates their proposals,
// and the other half rests, as in walker_chains.h. With pi the density by the model and pi* that by
// the surrogate, a proposal y of a walker at x is made by
//   delayed acceptance   L moves along differences of resting walkers, each accepted by the ratio
//                        of pi*; the last place is y, and it is accepted with probability
//                        min(1, pi(y) pi*(x) / (pi(x) pi*(y)))                                (1)
//                        [Christen, Fox, J. Comput. Graph. Stat. 14 (2005) 795]
//   no surrogate         one such move, accepted with probability min(1, pi(y) / pi(x))       (2)
// With a surrogate, every fourth round is one of (2), so that places that the surrogate does not
// know are reached, too. The moves are a random mixture of one kind of symmetric step, given the
// resting half, so L of them are reversible for pi*, which (1) needs. A good surrogate makes almost
// every proposal an independent draw that is accepted; a bad one is seen by proposals that are
// refused.
//
// A fifth of the trials is the way from the starts and is left out. After it, walkers that are
// stuck at a negligible density are released once. The chains mix if every variable has R-hat <=
// 1.01 and effective numbers >= 400. They end if these are >= 1000, too, looked at after a quarter,
// a half and three quarters of the rest, or when the trials are used up.
//
// R-hat here compares four groups of walkers, those with the least first draws of a variable, the
// next ones, and so on, so that walkers that remember their start show. Of 40 walkers one by one it
// is about sqrt(1 + 80 / S_eff) [Vats, Knudson, Statistical Science 36 (2021) 518], and 1.01 would
// ask for 4000 effective draws, ten times as many as the 400 that the ends of intervals need.
//
// Limits: where the surrogate's density falls faster than the model's, walkers come and go by (2)
// alone, slowly, and diagnostics may not see what is missing. Walkers see other modes only if some
// of them started there.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/random.h"
#include "optimization/posterior/posterior_density.h"
#include "optimization/posterior/posterior_samples.h"

namespace latsch {

struct ModelChainOptions {
  long trials = 4000;  // most proposals that the model evaluates
  int samples = 2000;  // number of samples that are kept
  std::uint64_t seed = 0;
  bool ends_when_mixed = true;  // false: all trials are used
};

class ModelChains {
 public:
  /// Takes starts of the walkers, n x an even number of at least six, and the surrogate's density,
  /// or an empty function for moves without a surrogate. The log density at a start need not be
  /// finite.
  ModelChains(Eigen::MatrixXd starts,
              PosteriorDensity density,
              LogDensityAt surrogate,
              const ModelChainOptions& options);

  /// Returns the points, in the unit cube, to be evaluated next; empty: ended.
  const std::vector<Eigen::VectorXd>& wanted() const { return wanted_; }
  /// Receives the sums of squares of the whitened residuals at the wanted points, in their order;
  /// nullopt: failed.
  void observe(const std::vector<std::optional<double>>& sums);

  /// Returns the number of trials so far, those of them that failed, and the share of the counted
  /// proposals that were accepted.
  long trials() const { return trials_; }
  long failed() const { return failed_; }
  double accepted() const;
  /// False if the model has no density at any start of one half; there are then no samples.
  bool has_density() const { return has_density_; }
  /// Returns the samples of the counted rounds, at even distance.
  PosteriorSamples samples() const;

 private:
  enum class Phase { starts, way, counted, done };

  void propose();
  void propose_of(int walker);
  void decide(int walker, double value);
  void after_both_halves();
  bool place_dead_starts();
  void release_stuck();
  void diagnose(PosteriorSamples& samples) const;
  double surrogate_at(const Eigen::VectorXd& u) const;
  /// True if moves are accepted by (2).
  bool is_plain() const;

  PosteriorDensity density_;
  LogDensityAt surrogate_;
  ModelChainOptions options_;
  int moves_ = 1;  // L
  Phase phase_ = Phase::starts;
  bool has_density_ = true;
  Eigen::MatrixXd places_;             // n x walkers
  Eigen::VectorXd values_, expected_;  // log densities by the model and by the surrogate
  std::vector<RandomStream> streams_;
  long rounds_ = 0;          // rounds of both halves so far
  int half_ = 0;             // the half that proposes
  std::vector<int> movers_;  // walkers of the wanted points
  std::vector<Eigen::VectorXd> wanted_;
  Eigen::VectorXd wanted_expected_;  // their log densities by the surrogate
  long trials_ = 0, failed_ = 0, proposals_ = 0, moved_ = 0;
  Eigen::VectorXd way_sum_;  // sums of log densities over the rounds of the way
  long way_rounds_ = 0;
  int looks_ = 0;                             // diagnoses so far
  std::vector<Eigen::MatrixXd> kept_;         // places after each counted round
  std::vector<Eigen::VectorXd> kept_values_;  // log densities
};

}  // namespace latsch
