// SPDX-License-Identifier: Apache-2.0
#include "optimization/surrogate/variance_shares.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "optimization/surrogate/polynomial_chaos.h"

namespace latsch {
namespace {

constexpr int kGroups = 10;
constexpr double kStudent = 2.262;  // 97.5 % point of Student's t with kGroups - 1 degrees
/// Spread of the values, as a share of the largest, below which they are one value and rounding.
constexpr double kOneValue = 1e-12;

/// First and total shares of all variables, one below the other.
Eigen::VectorXd shares_of(const PolynomialChaos& chaos, int n) {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(2 * n);
  const double variance = chaos.variance();
  for (int i = 0; i < n && variance > 0.0; ++i) {
    shares[i] = chaos.variance_of(i, true) / variance;
    shares[n + i] = chaos.variance_of(i, false) / variance;
  }
  return shares;
}

}  // namespace

VarianceShares variance_shares(const Eigen::MatrixXd& points, const Eigen::VectorXd& values) {
  const Eigen::Index N = points.rows();
  const int n = static_cast<int>(points.cols());
  assert(N >= kFewestPointsOfShares);
  VarianceShares found;
  const Eigen::VectorXd centered = values.array() - values.mean();
  if (centered.cwiseAbs().maxCoeff() <= kOneValue * values.cwiseAbs().maxCoeff()) return found;

  const Eigen::VectorXd shares = shares_of(PolynomialChaos(points, values), n);
  Eigen::MatrixXd without(2 * n, kGroups);
  double error = 0.0;
  for (int group = 0; group < kGroups; ++group) {
    std::vector<Eigen::Index> seen,
        unseen;  // neighbors in a sequence of points are in other groups
    for (Eigen::Index k = 0; k < N; ++k) (k % kGroups == group ? unseen : seen).push_back(k);
    const PolynomialChaos chaos(points(seen, Eigen::all), values(seen));
    without.col(group) = shares_of(chaos, n);
    for (const Eigen::Index k : unseen)
      error += std::pow(chaos.value(points.row(k).transpose()) - values[k], 2);
  }
  found.explained = 1.0 - error / centered.squaredNorm();

  const double open = std::clamp(1.0 - found.explained, 0.0, 1.0);
  const Eigen::VectorXd mean = without.rowwise().mean();
  for (int k = 0; k < 2 * n; ++k) {
    const double spread = (without.row(k).array() - mean[k]).square().sum();
    const double scatter = kStudent * std::sqrt((kGroups - 1.0) / kGroups * spread);
    const double known = shares[k] * (1.0 - open);
    (k < n ? found.first : found.total)
        .push_back({shares[k],
                    std::clamp(known - scatter, 0.0, 1.0),
                    std::clamp(known + open + scatter, 0.0, 1.0)});
  }
  return found;
}

}  // namespace latsch
