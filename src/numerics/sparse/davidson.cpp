// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/davidson.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "numerics/dense/dense_products.h"
#include "numerics/dense/self_adjoint_eigen.h"
#include "numerics/sparse/columns_together.h"

namespace latsch::numerics {
namespace {

using Eigen::MatrixXd;

constexpr int kMostSteps = 30;
// Relative length below which a direction counts as linearly dependent on the others.
constexpr double kDependent = 1e-8;
// Ratio of the squared lengths of the shortest and the longest new direction. Below it, one pass of
// orthogonalization leaves errors that scaling to unit length would magnify, so another pass
// follows.
constexpr double kNearlyDependent = 1e-6;
// Smallest factor by which the next correction is assumed to reduce the error of a pair. For tires
// the factor is 0.1 to 0.2.
constexpr double kFastest = 0.1;

using Columns = Eigen::Ref<const MatrixXd>;

MatrixXd product(const Columns& A, const Columns& B) {
  MatrixXd C(A.rows(), B.cols());
  add_product<double>(1.0, A, B, 0.0, C);
  return C;
}

MatrixXd times(const SymmetricMatrix& A, const Columns& X) {
  MatrixXd AX(X.rows(), X.cols());
  A.multiply(X, AX);
  return AX;
}

/// Makes the columns of D orthonormal in M (MD = M D) and drops columns that are nearly linear
/// combinations of the others. Returns the ratio of the smallest squared length of a kept direction
/// to the largest.
double make_orthonormal(MatrixXd& D, MatrixXd& MD) {
  const auto [square, U] = self_adjoint_eigen(overlaps<double>(D, MD));
  const double largest = square.size() > 0 ? square[square.size() - 1] : 0.0;
  Eigen::Index first = 0;
  while (first < square.size() && !(square[first] > kDependent * kDependent * largest)) ++first;
  const Eigen::Index kept = square.size() - first;
  const MatrixXd scaled =
      U.rightCols(kept) * square.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  D = product(D, scaled);
  MD = product(MD, scaled);
  return kept > 0 ? square[first] / largest : 1.0;
}

/// Returns the pairs whose errors are above the tolerance. If there are more than fit into one
/// solution with several right-hand sides, returns those with the largest errors.
std::vector<Eigen::Index> worst(const Eigen::VectorXd& errors, double tolerance) {
  std::vector<Eigen::Index> erring;
  for (Eigen::Index i = 0; i < errors.size(); ++i)
    if (errors[i] > tolerance) erring.push_back(i);
  if (std::ssize(erring) <= kSolvedTogether) return erring;
  std::ranges::stable_sort(erring, std::greater(), [&](Eigen::Index i) { return errors[i]; });
  erring.resize(kSolvedTogether);
  return erring;
}

}  // namespace

Davidson::Davidson(const SymmetricMatrix& K,
                   const SymmetricMatrix& M,
                   Solve solve,
                   const MatrixXd& vectors)
    : K_(K), M_(M), solve_(std::move(solve)), count_(vectors.cols()) {
  extend(vectors);
}

/// Adds the part of D that is orthogonal to the search space to it. This part may be small, so M D
/// is computed again rather than updated in the second pass.
void Davidson::extend(MatrixXd D) {
  MatrixXd MD;
  for (int pass = 0; pass < 2; ++pass) {
    if (size_ > 0) {
      const MatrixXd old = overlaps<double>(MV(), D);
      add_product<double>(-1.0, V(), old, 1.0, D);
      if (pass > 0) add_product<double>(-1.0, MV(), old, 1.0, MD);
    }
    if (pass == 0) MD = times(M_, D);
    make_orthonormal(D, MD);
  }
  append(D, MD);
}

/// Adds directions D whose product M D is known to the search space. Corrections of pairs with
/// small errors are nearly orthogonal to the space, so one pass of orthogonalization suffices
/// unless the corrections are nearly equal to each other.
void Davidson::extend(MatrixXd D, MatrixXd MD) {
  for (int pass = 0; pass < 2; ++pass) {
    const MatrixXd old = overlaps<double>(MV(), D);
    add_product<double>(-1.0, V(), old, 1.0, D);
    add_product<double>(-1.0, MV(), old, 1.0, MD);
    if (make_orthonormal(D, MD) > kNearlyDependent) break;
  }
  append(D, MD);
}

void Davidson::append(const MatrixXd& D, const MatrixXd& MD) {
  const Eigen::Index added = D.cols(), size = size_ + added;
  if (size > V_.cols())
    for (MatrixXd* of : {&V_, &KV_, &MV_}) of->conservativeResize(D.rows(), 2 * size);
  V_.middleCols(size_, added) = D;
  MV_.middleCols(size_, added) = MD;
  K_.multiply(D, KV_.middleCols(size_, added));
  size_ = size;
}

MatrixXd Davidson::corrections(const std::vector<Eigen::Index>& pairs,
                               const Eigen::VectorXd& lambda,
                               const MatrixXd& S) const {
  const MatrixXd own = S(Eigen::all, pairs);
  MatrixXd D = product(KV(), own) - product(MV(), own) * lambda(pairs).asDiagonal();
  solve_(D);
  return D;
}

EigenPairs<double> Davidson::find(Eigen::Index wanted, double tolerance) {
  EigenPairs<double> pairs;
  std::vector<Eigen::Index> erring(static_cast<std::size_t>(wanted));
  std::iota(erring.begin(), erring.end(), 0);
  for (int step = 0; step < kMostSteps; ++step) {
    const auto [lambda, S] = self_adjoint_eigen(overlaps<double>(V(), KV()));
    if (S.cols() < wanted) break;
    const MatrixXd D = corrections(erring, lambda, S);
    pairs.solves += static_cast<int>(D.cols());
    const Eigen::RowVectorXd errors = D.cwiseProduct(times(M_, D)).colwise().sum().cwiseSqrt();
    std::vector<Eigen::Index> still, columns;
    // In the first step the corrections of all pairs are known. If one pair needs its correction,
    // all corrections are used, because they improve the other pairs at no cost.
    const bool takes_all = step == 0 && (errors.array() > tolerance).any();
    for (std::size_t i = 0; i < erring.size(); ++i) {
      if (!takes_all && errors[static_cast<Eigen::Index>(i)] <= tolerance) continue;
      still.push_back(erring[i]);
      columns.push_back(static_cast<Eigen::Index>(i));
    }
    pairs.values = lambda.head(wanted);
    pairs.converged = still.empty();
    if (pairs.converged || step + 1 == kMostSteps) {
      pairs.vectors = product(V(), S.leftCols(wanted));
      break;
    }
    extend(D(Eigen::all, columns));
    erring = std::move(still);
  }
  return pairs;
}

/// Reduces the search space to its lowest Ritz vectors, one and a half times as many as the wanted
/// pairs. Further vectors hardly speed up convergence but cost as much in every product.
Eigen::VectorXd Davidson::compress() {
  const auto [lambda, S] = self_adjoint_eigen(overlaps<double>(V(), KV()));
  const Eigen::Index kept = std::min(count_ + count_ / 2, lambda.size());
  const MatrixXd lowest = S.leftCols(kept);
  for (MatrixXd* of : {&V_, &KV_, &MV_}) of->leftCols(kept) = product(of->leftCols(size_), lowest);
  size_ = kept;
  return lambda.head(kept);
}

EigenPairs<double> Davidson::sharpen(Eigen::Index wanted, double tolerance) {
  EigenPairs<double> pairs;
  MatrixXd T = compress().asDiagonal();
  // The errors of all pairs in the last step, and their estimates for the next one.
  Eigen::VectorXd last = Eigen::VectorXd::Zero(wanted), next = Eigen::VectorXd::Ones(wanted);
  for (int step = 0; step < kMostSteps; ++step) {
    const auto [lambda, S] = self_adjoint_eigen(T);
    if (S.cols() < wanted) break;
    const std::vector<Eigen::Index> erring = worst(next, tolerance);
    pairs.converged = erring.empty();
    if (pairs.converged) {
      pairs.values = lambda.head(wanted);
      pairs.vectors = product(V(), S.leftCols(wanted));
      break;
    }
    MatrixXd D = corrections(erring, lambda, S);
    MatrixXd MD = times(M_, D);
    pairs.solves += static_cast<int>(D.cols());
    for (std::size_t c = 0; c < erring.size(); ++c) {
      const Eigen::Index i = erring[c], column = static_cast<Eigen::Index>(c);
      const double error = std::sqrt(D.col(column).dot(MD.col(column)));
      const double left = last[i] > 0.0 ? std::max(error / last[i], kFastest) : 1.0;
      next[i] = left * error;
      last[i] = error;
    }
    extend(std::move(D), std::move(MD));
    const Eigen::Index old = T.cols();
    const MatrixXd added = overlaps<double>(V(), KV().rightCols(size_ - old));
    T.conservativeResize(size_, size_);
    T.rightCols(size_ - old) = added;
    T.bottomRows(size_ - old) = added.transpose();
  }
  return pairs;
}

}  // namespace latsch::numerics
