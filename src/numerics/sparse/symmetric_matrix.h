// SPDX-License-Identifier: Apache-2.0
// Sparse symmetric matrix on a fixed pattern: assembled from element matrices, multiplied with
// vectors.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "numerics/sparse/symmetric_pattern.h"

namespace latsch::numerics {

class SymmetricMatrix {
 public:
  /// Makes a zero matrix. The pattern must outlive the matrix.
  explicit SymmetricMatrix(const SymmetricPattern& pattern);

  const SymmetricPattern& pattern() const { return *pattern_; }
  int size() const { return pattern_->size(); }

  void set_zero();
  /// Adds a symmetric element matrix, n x n column-major with both triangles filled. Rows of held
  /// unknowns are dropped.
  void add_element(int element, const double* K);
  /// Adds factor * other. Both must have the same pattern.
  void add(double factor, const SymmetricMatrix& other);
  void add_to_diagonal(double value);

  /// Computes y = A x without allocation; x and y must be different vectors.
  void multiply(const double* x, double* y) const;
  /// Computes Y = A X, column by column.
  void multiply(const Eigen::Ref<const Eigen::MatrixXd>& X, Eigen::Ref<Eigen::MatrixXd> Y) const;

  /// Slow, because it searches: for tests and messages.
  double coefficient(int row, int column) const;
  Eigen::VectorXd diagonal() const;

  std::span<const double> values() const { return values_; }
  std::span<double> values() { return values_; }

 private:
  const SymmetricPattern* pattern_;
  std::vector<double> values_;
};

}  // namespace latsch::numerics
