// SPDX-License-Identifier: Apache-2.0
// The rows of residuals that a selection of coefficients fits: those that count, whitened, and one
// row of a weak prior for each candidate,
//   s sqrt(12) (u_i - toward_i)
// which counts a coefficient that no value depends on as known to its range and no better. Without
// these rows the first fit, with all candidates, may have no unique solution.
//
// The noise is estimated once, at the fit with all candidates (residual_noise.h), and then held, so
// that all models are rated by the same likelihood. Until then only the deviations of the
// residuals are divided out.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimization/identifiability/confidence.h"
#include "optimization/selection/information_criterion.h"

namespace latsch {

/// The candidates of a selection, and the residuals that decide.
struct SelectionProblem {
  Eigen::VectorXd start;                // n: where the fits begin, in the unit cube
  Eigen::VectorXd toward;               // n: value of a dropped candidate; others are not read
  std::vector<std::vector<int>> units;  // candidates: variables that are dropped together
  std::vector<int> free = {};           // variables that may move, ascending; empty: all
  std::optional<double> sigma = {};     // deviation of a residual, if the noise is stated
  ResidualTraits traits = {};           // traits of all residuals
  /// Recording of each residual; -1: a prior, which counts as no value; -2 - k: a prior that
  /// belongs to recording k. Empty: one recording.
  std::vector<int> recordings = {};
  std::vector<int> fitted = {};  // recordings that are fitted; empty: all
  Eigen::VectorXd restart = {};  // start of the last fits of the best models; empty: `start`
};

class SelectionRows {
 public:
  /// Takes the residuals and slopes at the start, with residuals that are not known as NaN.
  SelectionRows(const SelectionProblem& problem, const Linearization& start);

  /// Returns false if there are no more values than variables and no noise is stated: `sigma` is
  /// then not known.
  bool is_determined() const;
  /// Estimates the noise at the fit with all candidates, whose rows are those of of(). Returns the
  /// fit in the rows that hold from then on.
  Linearization take_noise(const Linearization& fit);

  /// Returns the whitened rows with those of the prior; nullopt if a residual is not known.
  std::optional<Evaluated> of(const Eigen::VectorXd& u, const Evaluated& raw) const;
  /// Returns the whitened rows of a linearization, with those of the prior.
  Linearization of(const Linearization& raw) const;
  /// Returns whitened rows with those of the prior added.
  Linearization with_prior_rows(const Linearization& at) const;
  /// Returns the linearization without the rows of the prior.
  Linearization without_prior(const Linearization& at) const;
  /// Returns the recording of each whitened row; -1 for priors.
  std::vector<int> recordings() const;
  /// Returns the number of rows without those of the prior.
  Eigen::Index size() const { return std::ssize(rows_); }

  /// Returns the variance of a whitened residual: 1 if the noise is stated, else an estimate from
  /// the fit of all candidates or, before it, from the slopes at the start.
  double variance() const;
  const CountedValues& counted() const { return counted_; }
  /// Returns the ratio of the spread to the stated noise, if chance cannot explain that it is
  /// larger; 1 otherwise.
  double excess() const { return excess_; }
  bool is_white() const { return !noise_ || noise_->is_white(); }
  bool is_pattern() const { return noise_ && noise_->is_pattern(); }

 private:
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& rows) const;
  Evaluated with_prior(const Eigen::VectorXd& u,
                       const Eigen::VectorXd& r,
                       const Eigen::MatrixXd& J) const;

  SelectionProblem problem_;
  std::vector<Eigen::Index> rows_;  // the residuals that count
  ResidualTraits traits_;           // traits of these, divided by their deviations
  Eigen::VectorXd deviations_;      // their deviations, those of the noise if it is stated
  std::vector<int> candidates_;     // variables of all units
  double prior_scale_ = 0.0;        // s sqrt(12)
  std::optional<ResidualNoise> noise_;
  CountedValues counted_;
  double excess_ = 1.0;
};

}  // namespace latsch
