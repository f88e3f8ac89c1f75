// SPDX-License-Identifier: Apache-2.0
// The posterior density around one fit in the coordinates of the sampled variables: which variables
// and residuals it has, its noise, its priors, and the trials from which a surrogate may learn.
//
// A residual row is a measured value of a fitted experiment or the prior of a nuisance number; all
// of them are whitened together (residual_noise.h). The priors of variables are no rows; they are
// part of PosteriorDensity::log_prior.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "correlation/analysis/identifiability.h"
#include "optimization/identifiability/residual_noise.h"
#include "optimization/posterior/surrogate_runs.h"

namespace latsch::correlation {

/// The start of a sampling: the fit, and the number of trials known then.
struct SamplingStart {
  DesignPoint center;
  long trials = 0;
};

class PosteriorFrame {
 public:
  /// Takes an identification whose derivatives at the center of the start are known. Study and
  /// identification must outlive the frame and the densities that it returns.
  PosteriorFrame(const Study& study,
                 const SamplingStart& start,
                 const Identification& identification);

  /// Returns the indices of the sampled variables.
  const std::vector<int>& axes() const { return axes_; }
  /// Returns the rows that count, among all residuals of residual_objective().
  const std::vector<Eigen::Index>& rows() const { return rows_; }
  /// Returns the reason why the density does not exist, or an empty text.
  std::string reason() const;
  /// Returns the density with the trials of the journal that were known at the start; appends
  /// sentences about the density.
  FittedDensity density(const Journal& journal, std::vector<std::string>& remarks) const;
  /// True if the noise is stated and the residuals are not clearly larger.
  bool is_noise_stated() const;
  /// Returns the point for places of the sampled variables in the unit cube.
  DesignPoint point(const Eigen::VectorXd& u) const;
  /// Returns the whitened rows among the residuals; nullopt if a value has no partner.
  std::optional<Eigen::VectorXd> whitened(const Eigen::VectorXd& residuals) const;
  /// Returns the rows as residual_objective() returns them, for columns of whitened rows.
  Eigen::MatrixXd unwhitened(const Eigen::MatrixXd& whitened) const;

 private:
  Eigen::VectorXd center() const { return whole_(axes_); }
  Eigen::MatrixXd with_priors(const Eigen::MatrixXd& J) const;
  LogDensityAt log_prior() const;
  std::vector<KnownSample> known_samples(const Journal& journal) const;

  const Study& study_;
  SamplingStart start_;
  const Identification& identification_;
  std::vector<int> axes_;
  Eigen::VectorXd whole_;           // the fit in the unit cube of all variables
  std::vector<Eigen::Index> rows_;  // measured values and priors of nuisance numbers
  int solved_ = 0;                  // nuisance numbers, which every trial solves
  std::optional<ResidualNoise> noise_;
  Eigen::VectorXd r_;
  Eigen::MatrixXd J_;
};

}  // namespace latsch::correlation
