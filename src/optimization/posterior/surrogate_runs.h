// SPDX-License-Identifier: Apache-2.0
// Chooses the few trials from which a surrogate of the residuals learns the posterior, and tests by
// ten further ones whether it stands for the model.
//
// Ask and tell, in rounds, like Identification:
//   1. Batches of six. Chains sample the surrogate. Three trials are plain draws. Three are those
//      of 40 draws where the variance of the surrogate is largest, given all other trials. If the
//      errors of the log density at the plain draws have a root mean square below 0.3 in two
//      batches in a row, and those at the others below 1, the batches end. One such batch is luck,
//      and plain draws alone seldom see the ends of the density. The batches also end if the next
//      one would exceed `runs`.
//   2. The check: ten plain draws more, of the final surrogate, which does not learn from them.
//      With e = errors of the log density less their mean,
//        deviation(e) <= 0.3                the surrogate stands for the model
//        0.3 < deviation(e) <= 1            doubtful: the deviation is reported
//        deviation(e) > 1, or any |e| > 3   refused: the samples are not the model's
//
// A trial that fails has density 0, and nothing is interpolated over it: the density is 0 at every
// point whose nearest known sample has failed. A failed draw of the check counts as |e| > 3.
//
// Limits: a check of ten draws sees errors where the surrogate has its own mass. A second mode
// that the surrogate does not know is not seen. Noise of the model counts as an error of the
// surrogate.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "optimization/posterior/posterior_samples.h"

namespace latsch {

/// A sample of the model: place in the unit cube, and its whitened residuals; nullopt: it failed.
struct KnownSample {
  Eigen::VectorXd u;
  std::optional<Eigen::VectorXd> r;
};

/// A finished fit whose posterior is asked for. All residuals are whitened: their noise has the
/// same deviation and is independent; rows of priors are not among them.
struct FittedDensity {
  WhitenedFrame frame;
  Eigen::VectorXd r_c;        // residuals at the center of the frame
  Eigen::MatrixXd J;          // dr/du there
  bool slopes_exact = false;  // true if J was computed by the model
  PosteriorDensity density;
  std::vector<KnownSample> known;  // earlier trials; those too far away are not used
};

struct SurrogateRunOptions {
  int runs = 50;  // most trials, those of the check included; 0: none, without a check
  std::uint64_t seed = 0;
  int threads = 1;  // threads of the chains, which do not change the result
};

enum class SurrogateVerdict { unchecked, stands, doubtful, refused };

/// Returns the verdict in one word, for example "stands".
const char* name(SurrogateVerdict verdict);

/// Result of the ten draws.
struct SurrogateCheck {
  SurrogateVerdict verdict = SurrogateVerdict::unchecked;
  double deviation = 0.0;  // standard deviation of the errors of the log density
  double largest = 0.0;    // largest |e|
  int draws = 0;           // draws of the check
  int failed = 0;          // those at which the model failed
};

class SurrogateRuns {
 public:
  SurrogateRuns(FittedDensity fit, const SurrogateRunOptions& options);

  /// Returns the points, in the unit cube, to be evaluated next; empty: ended.
  const std::vector<Eigen::VectorXd>& wanted() const { return wanted_; }
  /// Receives the whitened residuals at the wanted points, in their order; nullopt: failed.
  void observe(const std::vector<std::optional<Eigen::VectorXd>>& outcomes);

  /// True if the wanted points are those of the check.
  bool is_checking() const { return phase_ == Phase::check; }
  /// Returns the number of trials so far, and of those that failed.
  int trials() const { return trials_; }
  int failed() const { return failed_; }
  /// Returns the number of batches, and the root mean square error of each one's plain draws.
  const std::vector<double>& batch_errors() const { return batch_errors_; }
  /// True if two good batches in a row ended the batches, not the limit of trials.
  bool settled() const { return settled_; }
  const SurrogateCheck& check() const { return check_; }
  /// Returns the number of samples from which the surrogate is made.
  Eigen::Index learned_from() const { return samples_used_; }

  /// Returns the logarithm of the density by the surrogate.
  LogDensityAt log_density() const;
  /// Returns the whitened residuals by the surrogate at points of the unit cube, one in each
  /// column.
  Eigen::MatrixXd residuals_at(const Eigen::MatrixXd& u) const;
  /// Returns coordinates in which curved valleys of that density are straight; none for more than
  /// 12 variables.
  Straightening straightening() const;
  /// False if the density is 0 at the fit itself; there are then no chains.
  bool has_density() const { return chains_.has_value(); }
  /// Returns chains on the surrogate, at their present places.
  const WalkerChains& chains() const { return *chains_; }
  const FittedDensity& fit() const { return fit_; }

 private:
  enum class Phase { batches, check, done };
  struct Model;

  void learn();
  void ask();
  void ask_batch();
  void ask_check();
  std::vector<int> drawn_walkers(int count);
  double model_density(const KnownSample& sample) const;
  void judge(const std::vector<double>& errors);

  FittedDensity fit_;
  SurrogateRunOptions options_;
  Phase phase_ = Phase::batches;
  std::shared_ptr<const Model> model_;
  std::optional<WalkerChains> chains_;
  RandomStream choice_;
  std::vector<Eigen::VectorXd> wanted_;
  std::vector<double> expected_;  // log densities of the wanted points by the surrogate
  int trials_ = 0, failed_ = 0, good_in_a_row_ = 0;
  bool settled_ = false;
  std::vector<double> batch_errors_;
  SurrogateCheck check_;
  Eigen::Index samples_used_ = 0;
};

}  // namespace latsch
