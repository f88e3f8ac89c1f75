// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/symmetric_matrix.h"

#include <algorithm>
#include <cassert>

#include "numerics/sparse/columns_together.h"

namespace latsch::numerics {
namespace {

using Block = Eigen::Matrix3d;
using BlockVector = Eigen::Vector3d;

void multiply_nodes(const SymmetricPattern& pattern,
                    const double* values,
                    const double* x,
                    double* y) {
  const auto start = pattern.row_start();
  const auto column = pattern.column();
  for (int i = 0; i < pattern.block_rows(); ++i) {
    const BlockVector x_i(x + 3 * i);
    BlockVector y_i = BlockVector::Zero();
    const int diagonal = start[i + 1] - 1;
    for (int k = start[i]; k < diagonal; ++k) {
      const double* b = values + 9 * k;
      const double* x_j = x + 3 * column[k];
      double* y_j = y + 3 * column[k];
      // Column c of the block is used twice: in the product for row i, and as a row of the
      // transposed block in the product for row j.
      for (int c = 0; c < 3; ++c) {
        y_i[0] += b[3 * c] * x_j[c];
        y_i[1] += b[3 * c + 1] * x_j[c];
        y_i[2] += b[3 * c + 2] * x_j[c];
        y_j[c] += b[3 * c] * x_i[0] + b[3 * c + 1] * x_i[1] + b[3 * c + 2] * x_i[2];
      }
    }
    y_i += Eigen::Map<const Block>(values + 9 * diagonal) * x_i;
    // Later block rows add to this result.
    Eigen::Map<BlockVector>(y + 3 * i) = y_i;
  }
}

void multiply_scalars(const SymmetricPattern& pattern,
                      const double* values,
                      const double* x,
                      double* y) {
  const auto start = pattern.row_start();
  const auto column = pattern.column();
  for (int i = 0; i < pattern.size(); ++i) {
    const int diagonal = start[i + 1] - 1;
    double sum = values[diagonal] * x[i];
    for (int k = start[i]; k < diagonal; ++k) {
      sum += values[k] * x[column[k]];
      y[column[k]] += values[k] * x[i];
    }
    y[i] = sum;
  }
}

}  // namespace

SymmetricMatrix::SymmetricMatrix(const SymmetricPattern& pattern)
    : pattern_(&pattern), values_(pattern.value_count(), 0.0) {}

void SymmetricMatrix::set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }

void SymmetricMatrix::add_element(int element, const double* K) {
  const int n = pattern_->element_size(element);
  if (pattern_->block_size() == 1) {
    for (const auto& s : pattern_->scatter(element)) values_[s.target] += K[s.column * n + s.row];
    return;
  }
  for (const auto& s : pattern_->scatter(element)) {
    double* to = &values_[s.target];
    const double* from = K + s.column * n + s.row;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) to[3 * c + r] += from[c * n + r];
    }
  }
}

void SymmetricMatrix::add(double factor, const SymmetricMatrix& other) {
  assert(pattern_ == other.pattern_);
  for (size_t k = 0; k < values_.size(); ++k) values_[k] += factor * other.values_[k];
}

void SymmetricMatrix::add_to_diagonal(double value) {
  const int b = pattern_->block_size();
  for (int i = 0; i < pattern_->block_rows(); ++i) {
    double* block = &values_[(pattern_->row_start()[i + 1] - 1) * b * b];
    for (int c = 0; c < b; ++c) block[c * b + c] += value;
  }
}

void SymmetricMatrix::multiply(const double* x, double* y) const {
  assert(x != y);
  if (pattern_->block_size() == 3) {
    multiply_nodes(*pattern_, values_.data(), x, y);
  } else {
    multiply_scalars(*pattern_, values_.data(), x, y);
  }
}

void SymmetricMatrix::multiply(const Eigen::Ref<const Eigen::MatrixXd>& X,
                               Eigen::Ref<Eigen::MatrixXd> Y) const {
  if (pattern_->block_size() == 3 && X.cols() > 1) {
    multiply_columns(*pattern_, values_.data(), X, Y);
    return;
  }
  for (Eigen::Index k = 0; k < X.cols(); ++k) multiply(X.col(k).data(), Y.col(k).data());
}

double SymmetricMatrix::coefficient(int row, int column) const {
  if (row < column) std::swap(row, column);
  const int b = pattern_->block_size();
  const int block = pattern_->find(row / b, column / b);
  return block < 0 ? 0.0 : values_[block + (column % b) * b + row % b];
}

Eigen::VectorXd SymmetricMatrix::diagonal() const {
  Eigen::VectorXd d(size());
  for (int i = 0; i < size(); ++i) d[i] = coefficient(i, i);
  return d;
}

}  // namespace latsch::numerics
