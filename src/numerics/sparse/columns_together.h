// SPDX-License-Identifier: Apache-2.0
// Solutions and products with several columns at once, stored side by side: column c of unknown i
// is at i * width + c. For few columns BLAS spends more time packing than multiplying.
#pragma once

#include <Eigen/Core>

#include "numerics/sparse/symmetric_pattern.h"

namespace latsch::numerics {

constexpr int kSolvedTogether = 8, kMultipliedTogether = 4, kRoom = 8;

/// Computes v <- (L^-1 x, b - B L^-1 x) for v = (x, b) with eight columns, where x are the pivots
/// of a front and b the rows below them. `panel` [rows x pivots] is stored as in front_algebra.h.
void eliminate_columns(int pivots, int rows, const float* panel, float* v);
/// Computes x <- L^-T (x - B' b).
void substitute_columns(int pivots, int rows, const float* panel, float* v);

/// Work as the functions above for one column. The kRoom numbers after v are overwritten (the
/// second function sets them to zero). kRoom numbers after the panel are read, so they must exist
/// and be finite.
void eliminate_column(int pivots, int rows, const float* panel, float* v);
void substitute_column(int pivots, int rows, const float* panel, float* v);

/// Computes Y = A X for any number of columns, A in 3 x 3 blocks.
void multiply_columns(const SymmetricPattern& pattern,
                      const double* values,
                      const Eigen::Ref<const Eigen::MatrixXd>& X,
                      Eigen::Ref<Eigen::MatrixXd> Y);

}  // namespace latsch::numerics
