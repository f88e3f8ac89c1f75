// SPDX-License-Identifier: Apache-2.0
#include "optimization/region/generating_set.h"

#include <cmath>

namespace latsch {
namespace {

bool is_prime(int number) {
  for (int i = 2; i * i <= number; ++i) {
    if (number % i == 0) return false;
  }
  return number > 1;
}

int next_prime(int after) {
  int number = after + 1;
  while (!is_prime(number)) ++number;
  return number;
}

/// Returns term `index` of the van der Corput sequence: the digits of the index in reverse order
/// after the point.
double mirrored(int index, int base) {
  double value = 0.0;
  double digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) value += digit * (index % base);
  return value;
}

/// Returns a term of Halton's sequence in the cube from -1 to 1 as a unit vector.
Eigen::VectorXd quasi_random_direction(int size, int index) {
  Eigen::VectorXd v(size);
  for (int i = 0, base = 2; i < size; ++i, base = next_prime(base)) {
    v[i] = 2.0 * mirrored(index, base) - 1.0;
  }
  const double length = v.norm();
  return length > 1e-3 ? Eigen::VectorXd(v / length) : Eigen::VectorXd::Unit(size, 0);
}

/// Returns orthonormal columns that are different for every value of `turn`.
Eigen::MatrixXd turned_axes(int size, int turn) {
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(size, size);
  if (turn == 0 || size < 2) return I;
  // The first terms of Halton's sequence lie on a line, so they are left out.
  const Eigen::VectorXd v = quasi_random_direction(size, turn + next_prime(size + 1));
  return I - 2.0 * v * v.transpose();
}

/// Returns the unit vectors to the vertices of a regular simplex, as columns, in the space spanned
/// by the columns of Q.
Eigen::MatrixXd simplex(const Eigen::MatrixXd& Q) {
  const int size = static_cast<int>(Q.cols());
  const double n = size;
  const Eigen::VectorXd sum = Q.rowwise().sum();
  Eigen::MatrixXd corners(size, size + 1);
  const double back = (std::sqrt(n + 1.0) - 1.0) / std::pow(n, 1.5);
  corners.leftCols(size) = (std::sqrt((n + 1.0) / n) * Q).colwise() - back * sum;
  corners.col(size) = -sum / std::sqrt(n);
  return corners;
}

}  // namespace

std::vector<Eigen::VectorXd> generating_set(const std::vector<Bound>& at, int turn) {
  const int n = static_cast<int>(at.size());
  std::vector<Eigen::VectorXd> directions;
  std::vector<int> free;
  for (int i = 0; i < n; ++i) {
    if (at[i] == Bound::none) {
      free.push_back(i);
    } else {
      directions.push_back((at[i] == Bound::lower ? 1.0 : -1.0) * Eigen::VectorXd::Unit(n, i));
    }
  }
  if (free.empty()) return directions;
  const Eigen::MatrixXd corners = simplex(turned_axes(static_cast<int>(free.size()), turn));
  for (Eigen::Index k = 0; k < corners.cols(); ++k) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(n);
    for (std::size_t i = 0; i < free.size(); ++i) d[free[i]] = corners(i, k);
    directions.push_back(std::move(d));
  }
  return directions;
}

}  // namespace latsch
