// SPDX-License-Identifier: Apache-2.0
#include "numerics/sparse/columns_together.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#define LATSCH_KERNELS_IN "numerics/sparse/column_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::numerics {

void eliminate_columns(int pivots, int rows, const float* panel, float* v) {
  LATSCH_KERNEL(forward)(pivots, rows, panel, v);
}

void substitute_columns(int pivots, int rows, const float* panel, float* v) {
  LATSCH_KERNEL(backward)(pivots, rows, panel, v);
}

void eliminate_column(int pivots, int rows, const float* panel, float* v) {
  LATSCH_KERNEL(forward_one)(pivots, rows, panel, v);
}

void substitute_column(int pivots, int rows, const float* panel, float* v) {
  std::fill_n(v + rows, kRoom, 0.0f);
  LATSCH_KERNEL(backward_one)(pivots, rows, panel, v);
}

void multiply_columns(const SymmetricPattern& pattern,
                      const double* values,
                      const Eigen::Ref<const Eigen::MatrixXd>& X,
                      Eigen::Ref<Eigen::MatrixXd> Y) {
  constexpr int kWidth = kMultipliedTogether;
  const auto kernel = LATSCH_KERNEL(multiply);
  const Eigen::Index n = X.rows();
  Eigen::Matrix<double, kWidth, Eigen::Dynamic> x(kWidth, n), y(kWidth, n);
  for (Eigen::Index first = 0; first < X.cols(); first += kWidth) {
    const Eigen::Index columns = std::min<Eigen::Index>(kWidth, X.cols() - first);
    x.setZero();
    x.topRows(columns) = X.middleCols(first, columns).transpose();
    kernel(pattern.block_rows(),
           pattern.row_start().data(),
           pattern.column().data(),
           values,
           x.data(),
           y.data());
    Y.middleCols(first, columns) = y.topRows(columns).transpose();
  }
}

}  // namespace latsch::numerics
