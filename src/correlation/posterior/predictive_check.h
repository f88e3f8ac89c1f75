// SPDX-License-Identifier: Apache-2.0
// Posterior predictive check [Gelman, Meng, Stern, Statistica Sinica 6 (1996) 733]: whether the
// model can make data like those of each experiment.
//
// With T = |r|^2 the sum of squares of an experiment's whitened residuals at a sample of the
// variables, data replicated at that sample have the sum s^2 chi^2 of nu degrees of freedom: one a
// measured value, less one for each free nuisance number. The rank of the experiment is the share
// of replicated sums below T, averaged over the samples,
//   rank = mean F_nu(T / s^2)                                    s known
//   rank = mean E F_nu(T X / S),  X chi^2 distributed with m     s unknown, S the sum over all
// so no data are drawn. A rank above 0.995 means residuals that are larger, and one below 0.005
// residuals that are smaller, than those of almost all data that the model makes.
//
// Limits: the variables follow the data, so a rank is nearer to 1/2 than a random number between 0
// and 1 would be, the more the fewer values an experiment has beside the variables. If s is
// unknown, an experiment is judged by the others: one experiment alone has no rank, and where two
// differ by far it may be the nearer one that is refused. Neighbors'
// noise is taken as estimated at the fit, so a misfit that looks like slow noise is not seen.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

constexpr double kLeastRank = 0.005, kLargestRank = 0.995;

struct PredictiveCheck {
  int experiment = 0;  // index in the study
  int values = 0;      // degrees of freedom nu
  /// mean of T / (s^2 nu) over the samples, with the common s if it is unknown; about 1 is expected
  double chi_square = 0.0;
  std::optional<double> rank = {};  // nullopt: nothing to judge it by

  /// True if the model cannot make such data.
  bool is_refused() const { return rank && (*rank < kLeastRank || *rank > kLargestRank); }
  /// Returns the verdict in a few words, for example "data as the model makes them (rank
  /// of chi^2 0.412)".
  std::string in_words() const;
};

/// Returns one check for every experiment that has rows. `rows` are indices among all residuals of
/// residual_objective(), `whitened` the whitened residuals of these rows, one column for each
/// sample, `s` the deviation of a whitened residual, nullopt: unknown.
std::vector<PredictiveCheck> predictive_checks(const Study& study,
                                               const std::vector<Eigen::Index>& rows,
                                               const Eigen::MatrixXd& whitened,
                                               std::optional<double> s);

}  // namespace latsch::correlation
