// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/davidson.h"

#include <numeric>
#include <utility>
#include <vector>

#include "numerics/dense/dense_products.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch::numerics {
namespace {

using Eigen::MatrixXd;

constexpr int kMostSteps = 30;
constexpr double kDependent = 1e-8;  // of its length: a direction that is in the space already

MatrixXd product(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd C(A.rows(), B.cols());
  add_product<double>(1.0, A, B, 0.0, C);
  return C;
}

MatrixXd times(const SymmetricMatrix& A, const MatrixXd& X) {
  MatrixXd AX(X.rows(), X.cols());
  A.multiply(X, AX);
  return AX;
}

void append(const MatrixXd& columns, MatrixXd& to) {
  to.conservativeResize(columns.rows(), to.cols() + columns.cols());
  to.rightCols(columns.cols()) = columns;
}

/// The space that pairs are sought in, orthonormal in M.
struct Space {
  const SymmetricMatrix &K, &M;
  MatrixXd V, KV, MV;

  /// What is new in the directions D. Little may be left of them: M times it is made once more, not
  /// M times what the second pass takes away.
  void extend(MatrixXd D) {
    MatrixXd MD;
    for (int pass = 0; pass < 2; ++pass) {
      if (V.cols() > 0) {
        const MatrixXd old = overlaps<double>(MV, D);
        add_product<double>(-1.0, V, old, 1.0, D);
        if (pass > 0) add_product<double>(-1.0, MV, old, 1.0, MD);
      }
      if (pass == 0) MD = times(M, D);
      const auto [square, U] = self_adjoint_eigen(overlaps<double>(D, MD));
      const double largest = square.size() > 0 ? square[square.size() - 1] : 0.0;
      Eigen::Index first = 0;
      while (first < square.size() && !(square[first] > kDependent * kDependent * largest)) ++first;
      const Eigen::Index kept = square.size() - first;
      const MatrixXd scaled =
          U.rightCols(kept) * square.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
      D = product(D, scaled);
      MD = product(MD, scaled);
    }
    append(times(K, D), KV);
    append(MD, MV);
    append(D, V);
  }
};

}  // namespace

EigenPairs<double> davidson(const SymmetricMatrix& K,
                            const SymmetricMatrix& M,
                            const std::function<void(Eigen::Ref<MatrixXd> X)>& solve,
                            const MatrixXd& vectors,
                            double tolerance) {
  EigenPairs<double> pairs;
  const Eigen::Index count = vectors.cols();
  Space space{K, M, {}, {}, {}};
  space.extend(vectors);
  std::vector<Eigen::Index> erring(static_cast<std::size_t>(count));
  std::iota(erring.begin(), erring.end(), 0);
  for (int step = 0; step < kMostSteps; ++step) {
    const auto [lambda, S] = self_adjoint_eigen(overlaps<double>(space.V, space.KV));
    if (S.cols() < count) break;
    const MatrixXd of_erring = S(Eigen::all, erring);
    MatrixXd D =
        product(space.KV, of_erring) - product(space.MV, of_erring) * lambda(erring).asDiagonal();
    solve(D);
    pairs.solves += static_cast<int>(D.cols());
    const Eigen::RowVectorXd errors = D.cwiseProduct(times(M, D)).colwise().sum().cwiseSqrt();
    std::vector<Eigen::Index> still, columns;
    // The first corrections are there: where one is needed, all make the others better for nothing.
    const bool takes_all = step == 0 && (errors.array() > tolerance).any();
    for (std::size_t i = 0; i < erring.size(); ++i) {
      if (!takes_all && errors[static_cast<Eigen::Index>(i)] <= tolerance) continue;
      still.push_back(erring[i]);
      columns.push_back(static_cast<Eigen::Index>(i));
    }
    pairs.values = lambda.head(count);
    pairs.converged = still.empty();
    if (pairs.converged || step + 1 == kMostSteps) {
      pairs.vectors = product(space.V, S.leftCols(count));
      break;
    }
    space.extend(D(Eigen::all, columns));
    erring = std::move(still);
  }
  return pairs;
}

}  // namespace latsch::numerics
