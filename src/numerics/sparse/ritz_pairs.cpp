// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/ritz_pairs.h"

#include <cmath>
#include <limits>
#include <utility>

#include "numerics/dense/dense_products.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch::numerics {
namespace {

constexpr int kMostSteps = 20;
constexpr double kRounding = 1e-9;  // changes this small that do not fall any more are
// Relative to the largest: a direction this small is a combination of the others to rounding.
constexpr double kDependent = 1e-12;

/// Vectors, and the matrices times them.
struct Span {
  Eigen::MatrixXd V, KV, MV;

  Span(const SymmetricMatrix& K, const SymmetricMatrix& M, Eigen::MatrixXd vectors)
      : V(std::move(vectors)), KV(V.rows(), V.cols()), MV(V.rows(), V.cols()) {
    K.multiply(V, KV);
    M.multiply(V, MV);
  }
};

Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  Eigen::MatrixXd C(A.rows(), B.cols());
  add_product<double>(1.0, A, B, 0.0, C);
  return C;
}

/// The lowest `count` Ritz pairs of the spans' sum. Columns are scaled by their masses first.
Eigen::VectorXd rotate(Span& x, const Span* d, Eigen::Index count) {
  const Eigen::Index k = x.V.cols(), m = d ? d->V.cols() : 0;
  Eigen::MatrixXd A(k + m, k + m), B(k + m, k + m);
  A.topLeftCorner(k, k) = overlaps<double>(x.V, x.KV);
  B.topLeftCorner(k, k) = overlaps<double>(x.V, x.MV);
  if (d) {
    A.bottomLeftCorner(m, k) = overlaps<double>(d->V, x.KV);
    B.bottomLeftCorner(m, k) = overlaps<double>(d->V, x.MV);
    A.bottomRightCorner(m, m) = overlaps<double>(d->V, d->KV);
    B.bottomRightCorner(m, m) = overlaps<double>(d->V, d->MV);
  }
  A = Eigen::MatrixXd(A.selfadjointView<Eigen::Lower>());
  B = Eigen::MatrixXd(B.selfadjointView<Eigen::Lower>());
  const Eigen::VectorXd scale = B.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const SelfAdjointEigen<double> mass =
      self_adjoint_eigen(Eigen::MatrixXd(scale.asDiagonal() * B * scale.asDiagonal()));
  Eigen::Index first = 0;
  const double smallest = kDependent * mass.values[k + m - 1];
  while (first < k + m - count && !(mass.values[first] > smallest)) ++first;
  const Eigen::Index kept = k + m - first;
  const Eigen::MatrixXd W = scale.asDiagonal() * mass.vectors.rightCols(kept) *
                            mass.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  const SelfAdjointEigen<double> ritz = self_adjoint_eigen(Eigen::MatrixXd(W.transpose() * A * W));
  const Eigen::MatrixXd S = W * ritz.vectors.leftCols(count);
  const auto turn = [&](Eigen::MatrixXd& of_x, const Eigen::MatrixXd* of_d) {
    Eigen::MatrixXd turned = product(of_x, S.topRows(k));
    if (of_d) add_product<double>(1.0, *of_d, S.bottomRows(m), 1.0, turned);
    of_x = std::move(turned);
  };
  turn(x.V, d ? &d->V : nullptr);
  turn(x.KV, d ? &d->KV : nullptr);
  turn(x.MV, d ? &d->MV : nullptr);
  return ritz.values.head(count);
}

/// Of a sequence whose changes fall as the last two did.
double error_left(double change, double before) {
  if (!std::isfinite(before)) return change;
  return change < before ? change * change / (before - change)
                         : std::numeric_limits<double>::infinity();
}

}  // namespace

EigenPairs<double> ritz_pairs(const SymmetricMatrix& K,
                              const SymmetricMatrix& M,
                              const std::function<void(Eigen::Ref<Eigen::MatrixXd>)>& precondition,
                              Eigen::MatrixXd X,
                              double tolerance) {
  EigenPairs<double> pairs;
  const Eigen::Index count = X.cols();
  Span x(K, M, std::move(X));
  pairs.values = rotate(x, nullptr, count);
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostSteps && !pairs.converged; ++step) {
    Eigen::MatrixXd D = x.KV - x.MV * pairs.values.asDiagonal();
    precondition(D);
    pairs.solves += static_cast<int>(count);
    // What of D lies in X would be told apart from it by its last digits alone.
    add_product<double>(-1.0, x.V, overlaps<double>(x.MV, D), 1.0, D);
    const Span d(K, M, std::move(D));
    const Eigen::VectorXd values = rotate(x, &d, count);
    const double change = ((values - pairs.values).array() / values.array()).abs().maxCoeff();
    const double left = error_left(change, before);
    pairs.converged = left <= tolerance || (change <= kRounding && change >= before);
    pairs.values = values;
    before = change;
  }
  pairs.vectors = std::move(x.V);
  return pairs;
}

}  // namespace latsch::numerics
