// SPDX-License-Identifier: Apache-2.0
#include "optimization/posterior/chain_diagnostics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

namespace latsch {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// Returns the normal quantile of 0 < p < 1 to nine digits: a rational approximation [A&S 26.2.23],
/// then one step of Halley's method. Ranks need millions of them.
double normal_quantile(double p) {
  if (p > 0.5) return -normal_quantile(1.0 - p);
  const double t = std::sqrt(-2.0 * std::log(p));
  const double x = (2.515517 + t * (0.802853 + t * 0.010328)) /
                       (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308))) -
                   t;
  const double excess = 0.5 * std::erfc(-x / std::numbers::sqrt2) - p;
  const double step = excess * std::sqrt(2.0 * std::numbers::pi) * std::exp(0.5 * x * x);
  return x - step / (1.0 + 0.5 * x * step);
}

Eigen::MatrixXd split_chains(const Eigen::MatrixXd& chains) {
  const Eigen::Index half = chains.rows() / 2;
  Eigen::MatrixXd split(half, 2 * chains.cols());
  split << chains.topRows(half), chains.bottomRows(half);
  return split;
}

/// Returns the normal scores of the ranks; equal draws share their mean rank.
Eigen::MatrixXd normal_scores(const Eigen::MatrixXd& draws) {
  const auto count = static_cast<std::size_t>(draws.size());
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  const double* x = draws.data();
  std::sort(order.begin(), order.end(), [x](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  Eigen::MatrixXd scores(draws.rows(), draws.cols());
  for (std::size_t k = 0; k < count;) {
    std::size_t end = k + 1;
    while (end < count && x[order[end]] == x[order[k]]) ++end;
    const double rank = 0.5 * static_cast<double>(k + 1 + end);
    const double score =
        normal_quantile((rank - 0.375) / (static_cast<double>(count) + 0.25));  // (14)
    for (; k < end; ++k) scores.data()[order[k]] = score;
  }
  return scores;
}

double variance_of(const Eigen::VectorXd& x) {
  return (x.array() - x.mean()).square().sum() / static_cast<double>(x.size() - 1);
}

/// Returns the sum over all chains of the products of deviations that are `lag` draws apart.
Eigen::VectorXd lagged_products(const Eigen::MatrixXd& centered, Eigen::Index lag) {
  const Eigen::Index rows = centered.rows() - lag;
  return centered.topRows(rows).cwiseProduct(centered.bottomRows(rows)).colwise().sum();
}

}  // namespace

double plain_rhat(const Eigen::MatrixXd& chains) {
  const auto N = static_cast<double>(chains.rows());
  double W = 0.0;
  for (Eigen::Index j = 0; j < chains.cols(); ++j) W += variance_of(chains.col(j));
  W /= static_cast<double>(chains.cols());
  const double B_over_N = variance_of(chains.colwise().mean().transpose());
  return W > 0.0 ? std::sqrt(((N - 1.0) / N * W + B_over_N) / W) : kNotANumber;  // (3, 4)
}

double effective_draws(const Eigen::MatrixXd& chains) {
  const Eigen::Index N = chains.rows(), M = chains.cols();
  const auto n = static_cast<double>(N);
  const Eigen::MatrixXd centered = chains.rowwise() - chains.colwise().mean();
  const double W = lagged_products(centered, 0).mean() / (n - 1.0);
  const double between = M > 1 ? variance_of(chains.colwise().mean().transpose()) : 0.0;
  const double all = (n - 1.0) / n * W + between;
  if (!(all > 0.0)) return kNotANumber;
  const auto rho = [&](Eigen::Index lag) {  // (10)
    if (lag >= N) return 0.0;
    return 1.0 - (W - lagged_products(centered, lag).mean() / n) / all;
  };
  double sum = 0.0, least = std::numeric_limits<double>::infinity();
  for (Eigen::Index lag = 0; lag + 1 < N; lag += 2) {
    const double pair = (lag == 0 ? 1.0 : rho(lag)) + rho(lag + 1);
    if (!(pair > 0.0)) break;
    least = std::min(least, pair);
    sum += least;
  }
  const double total = n * static_cast<double>(M);
  const double tau = std::max(2.0 * sum - 1.0, 1.0 / std::log10(total));  // (13) and its limit
  return total / tau;
}

ChainDiagnostics chain_diagnostics(const Eigen::MatrixXd& chains) {
  assert(chains.rows() >= 4);
  const Eigen::MatrixXd split = split_chains(chains);
  const Eigen::VectorXd all = split.reshaped();
  const auto indicators = [&](double p) -> Eigen::MatrixXd {
    const double limit = quantile_of(all, p);
    return (split.array() <= limit).cast<double>();
  };
  const Eigen::MatrixXd scores = normal_scores(split);
  const Eigen::MatrixXd folded = (split.array() - quantile_of(all, 0.5)).abs();
  return {std::max(plain_rhat(scores), plain_rhat(normal_scores(folded))),
          effective_draws(scores),
          std::min(effective_draws(indicators(0.05)), effective_draws(indicators(0.95)))};
}

double quantile_of(Eigen::VectorXd values, double p) {
  const double place = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<Eigen::Index>(place);
  double* first = values.data();
  double* last = first + values.size();
  std::nth_element(first, first + below, last);
  const double low = first[below];
  if (below + 1 == values.size()) return low;
  const double high = *std::min_element(first + below + 1, last);
  return low + (place - static_cast<double>(below)) * (high - low);
}

}  // namespace latsch
