// SPDX-License-Identifier: Apache-2.0
// Solutions and products with several columns at once, kept side by side: number c of unknown i
// stands at i * width + c. For few columns BLAS packs more than it multiplies.
#pragma once

#include <Eigen/Core>

#include "numerics/sparse/symmetric_pattern.h"

namespace latsch::numerics {

constexpr int kSolvedTogether = 8, kMultipliedTogether = 4, kRoom = 8;

/// v <- (L^-1 x, b - B L^-1 x) of v = (x, b): a front's pivots and its rows below them, its panel
/// [rows x pivots] as in front_algebra.h; eight columns.
void eliminate_columns(int pivots, int rows, const float* panel, float* v);
/// x <- L^-T (x - B' b)
void substitute_columns(int pivots, int rows, const float* panel, float* v);

/// The same of one column; kRoom numbers after v are overwritten (set to zero by the second), and
/// as many are read after the panel, which have to be finite.
void eliminate_column(int pivots, int rows, const float* panel, float* v);
void substitute_column(int pivots, int rows, const float* panel, float* v);

/// Y = A X, columns of any number, A by 3 x 3 blocks.
void multiply_columns(const SymmetricPattern& pattern,
                      const double* values,
                      const Eigen::Ref<const Eigen::MatrixXd>& X,
                      Eigen::Ref<Eigen::MatrixXd> Y);

}  // namespace latsch::numerics
