// SPDX-License-Identifier: Apache-2.0
#include "correlation/posterior/predictive_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "correlation/target/residuals.h"
#include "numerics/chi_square.h"

namespace latsch::correlation {
namespace {

constexpr int kNoiseSizes = 32;  // sizes of an unknown noise, of equal probability

/// Returns E F_nu(share X), X chi^2 distributed with m degrees of freedom.
double mean_probability(double share, double nu, const std::vector<double>& X) {
  double sum = 0.0;
  for (const double x : X) sum += numerics::chi_square_probability(share * x, nu);
  return sum / static_cast<double>(X.size());
}

}  // namespace

std::string PredictiveCheck::in_words() const {
  if (!rank) return "not judged, because its noise is estimated from its own residuals";
  const std::string ranked = fmt::format(" (rank of chi^2 {:.3f})", *rank);
  if (*rank > kLargestRank)
    return "the model cannot make such data: they are farther from it than their noise allows" +
           ranked;
  if (*rank < kLeastRank)
    return "the model cannot make such data: they are nearer to it than their noise allows" +
           ranked;
  return "data as the model makes them" + ranked;
}

std::vector<PredictiveCheck> predictive_checks(const Study& study,
                                               const std::vector<Eigen::Index>& rows,
                                               const Eigen::MatrixXd& whitened,
                                               std::optional<double> s) {
  const std::vector<ResidualRow> all = residual_rows(study);
  std::map<int, std::vector<Eigen::Index>> of_experiment;  // rows of `whitened`
  for (std::size_t k = 0; k < rows.size(); ++k)
    of_experiment[all[static_cast<std::size_t>(rows[k])].owner()].push_back(
        static_cast<Eigen::Index>(k));
  int m = static_cast<int>(std::ssize(rows));
  for (const auto& [e, own] : of_experiment)
    m -= solved_numbers(study, static_cast<std::size_t>(e));
  const Eigen::RowVectorXd S = whitened.colwise().squaredNorm();
  std::vector<double> X;
  for (int k = 0; k < kNoiseSizes && !s; ++k)
    X.push_back(numerics::chi_square_quantile((k + 0.5) / kNoiseSizes, m));
  std::vector<PredictiveCheck> checks;
  for (const auto& [e, own] : of_experiment) {
    PredictiveCheck check{e};
    check.values =
        static_cast<int>(std::ssize(own)) - solved_numbers(study, static_cast<std::size_t>(e));
    const Eigen::MatrixXd part = whitened(own, Eigen::all);
    const Eigen::RowVectorXd T = part.colwise().squaredNorm();
    double rank = 0.0;
    for (Eigen::Index k = 0; k < T.size(); ++k) {
      const double squares = s ? T[k] / (*s * *s) : T[k] * m / S[k];
      check.chi_square += squares / std::max(check.values, 1);
      rank += s ? numerics::chi_square_probability(squares, check.values)
                : mean_probability(T[k] / S[k], check.values, X);
    }
    const auto samples = static_cast<double>(std::max<Eigen::Index>(T.size(), 1));
    check.chi_square /= samples;
    if (check.values > 0 && (s || of_experiment.size() > 1)) check.rank = rank / samples;
    checks.push_back(check);
  }
  return checks;
}

}  // namespace latsch::correlation
