// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/slopes/sharpened_modes.h"

#include <fmt/format.h>

#include <vector>

#include "numerics/dense/dense_products.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch::fe_tire {
namespace {

constexpr int kMostSteps = 30;
constexpr double kOfCorrections = 1e-2;  // what may be left of their equations
constexpr double kDependent = 1e-8;      // of its length: a direction that is in the space already

using Eigen::MatrixXd;

MatrixXd product(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd C(A.rows(), B.cols());
  numerics::add_product<double>(1.0, A, B, 0.0, C);
  return C;
}

MatrixXd times(const numerics::SymmetricMatrix& A, const MatrixXd& X) {
  MatrixXd AX(X.rows(), X.cols());
  A.multiply(X, AX);
  return AX;
}

void append(const MatrixXd& columns, MatrixXd& to) {
  to.conservativeResize(columns.rows(), to.cols() + columns.cols());
  to.rightCols(columns.cols()) = columns;
}

/// The space modes are sought in, orthonormal in M.
struct Space {
  const numerics::SymmetricMatrix &K, &M;
  MatrixXd V, KV, MV;

  /// What is new in the directions D.
  void extend(MatrixXd D) {
    for (int pass = 0; pass < 2; ++pass) {
      if (V.cols() > 0)
        numerics::add_product<double>(-1.0, V, numerics::overlaps<double>(MV, D), 1.0, D);
      const MatrixXd gram = numerics::overlaps<double>(D, times(M, D));
      const auto [square, U] = numerics::self_adjoint_eigen(gram);
      const double largest = square.size() > 0 ? square[square.size() - 1] : 0.0;
      Eigen::Index first = 0;
      while (first < square.size() && !(square[first] > kDependent * kDependent * largest)) ++first;
      const Eigen::Index kept = square.size() - first;
      D = product(D, U.rightCols(kept) * square.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal());
    }
    append(times(K, D), KV);
    append(times(M, D), MV);
    append(D, V);
  }
};

}  // namespace

Result<MatrixXd> sharpened(const MatrixXd& vectors,
                           const numerics::SymmetricMatrix& K,
                           const numerics::Factorization& factor,
                           const numerics::SymmetricMatrix& M,
                           double tolerance) {
  const Eigen::Index count = vectors.cols();
  Space space{K, M, {}, {}, {}};
  space.extend(vectors);
  std::vector<Eigen::Index> erring(static_cast<std::size_t>(count));
  for (Eigen::Index i = 0; i < count; ++i) erring[static_cast<std::size_t>(i)] = i;
  for (int step = 0; step < kMostSteps; ++step) {
    const auto [lambda, S] =
        numerics::self_adjoint_eigen(numerics::overlaps<double>(space.V, space.KV));
    if (S.cols() < count) break;
    const MatrixXd of_erring = S(Eigen::all, erring);
    MatrixXd D =
        product(space.KV, of_erring) - product(space.MV, of_erring) * lambda(erring).asDiagonal();
    factor.solve_columns(D, kOfCorrections);
    const Eigen::RowVectorXd errors = D.cwiseProduct(times(M, D)).colwise().sum().cwiseSqrt();
    std::vector<Eigen::Index> still, columns;
    for (std::size_t i = 0; i < erring.size(); ++i) {
      if (errors[static_cast<Eigen::Index>(i)] <= tolerance) continue;
      still.push_back(erring[i]);
      columns.push_back(static_cast<Eigen::Index>(i));
    }
    if (still.empty()) return product(space.V, S.leftCols(count));
    space.extend(D(Eigen::all, columns));
    erring = std::move(still);
  }
  return Failure{
      fmt::format("slopes: shapes of {} of {} modes do not converge", erring.size(), count)};
}

}  // namespace latsch::fe_tire
