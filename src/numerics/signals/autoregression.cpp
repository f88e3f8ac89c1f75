// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/autoregression.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace latsch::numerics {

Autoregression::Autoregression(std::vector<double> partial) : partial_(std::move(partial)) {
  predictors_.push_back({});
  variances_.push_back(1.0);
  for (const double kappa : partial_) {
    assert(std::abs(kappa) < 1.0);
    const std::vector<double>& before = predictors_.back();
    std::vector<double> phi(before);
    for (size_t i = 0; i < before.size(); ++i) phi[i] -= kappa * before[before.size() - 1 - i];
    phi.push_back(kappa);
    predictors_.push_back(std::move(phi));
    variances_.push_back(variances_.back() * (1.0 - kappa * kappa));
  }
}

Eigen::MatrixXd Autoregression::whitened(const Eigen::MatrixXd& X) const {
  Eigen::MatrixXd E = X;
  for (Eigen::Index j = 0; j < X.rows(); ++j) {
    const auto k = static_cast<size_t>(std::min<Eigen::Index>(j, order()));
    for (size_t i = 0; i < k; ++i) {
      E.row(j) -= predictors_[k][i] * X.row(j - 1 - static_cast<Eigen::Index>(i));
    }
    E.row(j) /= std::sqrt(variances_[k]);
  }
  return E;
}

Eigen::MatrixXd Autoregression::unwhitened(const Eigen::MatrixXd& X) const {
  Eigen::MatrixXd Y = X;
  for (Eigen::Index j = 0; j < X.rows(); ++j) {
    const auto k = static_cast<size_t>(std::min<Eigen::Index>(j, order()));
    Y.row(j) *= std::sqrt(variances_[k]);
    for (size_t i = 0; i < k; ++i)
      Y.row(j) += predictors_[k][i] * Y.row(j - 1 - static_cast<Eigen::Index>(i));
  }
  return Y;
}

// With L^-1 = D^-1/2 (I - Phi), L' X = D^1/2 Y, where (I - Phi') Y = X is solved from the last row
// up.
Eigen::MatrixXd Autoregression::colored(const Eigen::MatrixXd& X) const {
  Eigen::MatrixXd Y = X;
  for (Eigen::Index j = X.rows() - 1; j >= 0; --j) {
    const auto k = static_cast<size_t>(std::min<Eigen::Index>(j, order()));
    for (size_t i = 0; i < k; ++i) {
      Y.row(j - 1 - static_cast<Eigen::Index>(i)) += predictors_[k][i] * Y.row(j);
    }
    Y.row(j) *= std::sqrt(variances_[k]);
  }
  return Y;
}

double Autoregression::log_determinant(Eigen::Index samples) const {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < samples; ++j) {
    sum += std::log(variances_[static_cast<size_t>(std::min<Eigen::Index>(j, order()))]);
  }
  return sum;
}

double Autoregression::samples_for_one() const {
  double rest = 1.0;
  for (const double phi : predictors_.back()) rest -= phi;
  return variances_.back() / (rest * rest);
}

}  // namespace latsch::numerics
