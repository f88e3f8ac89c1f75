// SPDX-License-Identifier: Apache-2.0
#include "optimization/identifiability/group_spreads.h"

#include <algorithm>
#include <cmath>

#include "numerics/dense/orthogonal_factors.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch {
namespace {

constexpr int kMostRounds = 100;
constexpr double kSettled = 1e-8;  // change of a logarithm that ends the iteration
/// Least spread, as a share of the root mean square of all residuals.
constexpr double kLeastShare = 1e-3;
/// Least degrees of freedom of a group beside the fit, as a share of its values.
constexpr double kLeastLeft = 1e-6;
/// Least eigenvalue of the information on the logarithms of the variances. The information of a
/// group with n degrees of freedom is n / 2.
constexpr double kLeastInformation = 0.02;

double mean_square(const Eigen::VectorXd& x) {
  return x.squaredNorm() / static_cast<double>(x.size());
}

}  // namespace

bool has_several_groups(const std::vector<int>& groups) {
  const auto first =
      std::find_if(groups.begin(), groups.end(), [](int group) { return group >= 0; });
  return std::any_of(first, groups.end(), [&](int group) { return group >= 0 && group != *first; });
}

GroupSpreads::GroupSpreads(const Eigen::VectorXd& x,
                           const Eigen::MatrixXd& G,
                           const std::vector<int>& groups)
    : spreads_(Eigen::VectorXd::Ones(x.size())) {
  std::map<int, std::vector<Eigen::Index>> members;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const int group = groups[static_cast<std::size_t>(k)];
    if (group >= 0) members[group].push_back(k);
  }
  for (auto& [group, rows] : members) rows_.push_back(std::move(rows));
  const auto count = std::ssize(rows_);
  const double least = kLeastShare * kLeastShare * mean_square(x);
  Eigen::VectorXd theta(count), floor(count);
  for (Eigen::Index g = 0; g < count; ++g) {
    theta[g] = floor[g] = std::max(least, mean_square(x(rows_[static_cast<std::size_t>(g)])));
  }
  const auto take = [&] {
    for (Eigen::Index g = 0; g < count; ++g)
      spreads_(rows_[static_cast<std::size_t>(g)]).setConstant(std::sqrt(theta[g]));
    const auto weights = spreads_.cwiseInverse().asDiagonal();
    Q_ = G.cols() > 0 ? numerics::range_basis(weights * G) : Eigen::MatrixXd(x.size(), 0);
  };
  for (int round = 0; round < kMostRounds; ++round) {
    take();
    const Eigen::VectorXd scaled = x.cwiseQuotient(spreads_);
    const Eigen::VectorXd left = scaled - Q_ * (Q_.transpose() * scaled);
    double change = 0.0;
    for (Eigen::Index g = 0; g < count; ++g) {
      const auto& rows = rows_[static_cast<std::size_t>(g)];
      const auto n = static_cast<double>(rows.size());
      const double freedom = std::max(kLeastLeft * n, n - Q_(rows, Eigen::all).squaredNorm());
      const double next = std::max(floor[g], theta[g] * left(rows).squaredNorm() / freedom);
      change = std::max(change, std::abs(std::log(next / theta[g])));
      theta[g] = next;
    }
    if (change < kSettled) break;
  }
  take();
  auto rows_of_group = rows_.begin();
  for (const auto& member : members) {
    const auto& rows = *rows_of_group++;
    freedoms_[member.first] = static_cast<double>(rows.size()) - Q_(rows, Eigen::all).squaredNorm();
  }
  std::vector<Eigen::MatrixXd> grams;
  for (const auto& rows : rows_) {
    const Eigen::MatrixXd own = Q_(rows, Eigen::all);
    grams.emplace_back(own.transpose() * own);
  }
  Eigen::MatrixXd information(count, count);
  for (Eigen::Index a = 0; a < count; ++a) {
    for (Eigen::Index b = 0; b < count; ++b) {
      const Eigen::MatrixXd &A = grams[static_cast<std::size_t>(a)],
                            &B = grams[static_cast<std::size_t>(b)];
      information(a, b) = 0.5 * A.cwiseProduct(B).sum();
      if (a == b)
        information(a, a) +=
            0.5 * static_cast<double>(rows_[static_cast<std::size_t>(a)].size()) - A.trace();
    }
  }
  const auto [values, vectors] = numerics::self_adjoint_eigen(information);
  W_ = vectors * values.cwiseMax(kLeastInformation).cwiseInverse().asDiagonal() *
       vectors.transpose();
}

Eigen::MatrixXd GroupSpreads::more_covariance(const Eigen::MatrixXd& Z) const {
  Eigen::MatrixXd more = Eigen::MatrixXd::Zero(Z.cols(), Z.cols());
  std::vector<Eigen::MatrixXd> along;  // products with the columns of Q, one for each group
  for (const auto& rows : rows_)
    along.emplace_back(Q_(rows, Eigen::all).transpose() * Z(rows, Eigen::all));
  for (std::size_t a = 0; a < rows_.size(); ++a) {
    const auto i = static_cast<Eigen::Index>(a);
    const Eigen::MatrixXd own = Z(rows_[a], Eigen::all);
    more += W_(i, i) * (own.transpose() * own);
    for (std::size_t b = 0; b < rows_.size(); ++b)
      more -= W_(i, static_cast<Eigen::Index>(b)) * (along[a].transpose() * along[b]);
  }
  return 2.0 * more;
}

double GroupSpreads::relative_variance(const Eigen::VectorXd& z) const {
  Eigen::VectorXd shares(std::ssize(rows_));
  for (std::size_t g = 0; g < rows_.size(); ++g)
    shares[static_cast<Eigen::Index>(g)] = z(rows_[g]).squaredNorm() / z.squaredNorm();
  return shares.dot(W_ * shares);
}

}  // namespace latsch
