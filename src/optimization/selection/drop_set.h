// SPDX-License-Identifier: Apache-2.0
// Finds the coefficients that a fit could do without, by its own covariance.
//
// A fit has found coefficients that differ by b from the values that they have if they are dropped.
// C is their covariance. Dropping the set D, and refitting all others, raises -2 log L by
//   b_D' (C_DD)^-1 b_D
// if the residuals are linear in the coefficients. Coefficients that act alike have a small rise
// each and a large one together, so the sets are rated as wholes. [Seber, Lee, Linear Regression
// Analysis, 2003, ch. 4]
//
// The sets are nested: the units are sorted by the rise that dropping one alone causes, for each of
// its coefficients, and set j consists of the first j. One Cholesky factor C = L L' in this order
// rates all of them, because the rise of set j is the sum of the squares of the first entries of
// L^-1 b.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

/// Rise of -2 log L for each coefficient up to which a set is dropped at once. A useless one has 1
/// on average. A larger value drops more at a time and may drop useful ones with them.
constexpr double kRiseOfADrop = 2.0;

/// The units that should be dropped next.
struct DropSet {
  std::vector<int> units;    // indices of the units, by rising single rise
  double rise = 0.0;         // rise that dropping them together causes
  bool stays_below = false;  // true: the rise stays below kRiseOfADrop for each coefficient
};

/// Returns for each unit the rise that dropping it alone causes. A unit is a list of indices of
/// `b`; C is the covariance of b, positive definite.
std::vector<double> single_rises(const Eigen::VectorXd& b,
                                 const Eigen::MatrixXd& C,
                                 const std::vector<std::vector<int>>& units);

/// Returns the largest of the nested sets with at most a third of the units, but at least one,
/// whose rise stays below kRiseOfADrop for each coefficient. If none does, it returns the set that
/// lowers the rise less `price` for each coefficient most, such as BIC with a price of ln m, or, if
/// none lowers it, the single unit with the least rise. Empty without units.
DropSet largest_drop_set(const Eigen::VectorXd& b,
                         const Eigen::MatrixXd& C,
                         const std::vector<std::vector<int>>& units,
                         double price);

}  // namespace latsch
