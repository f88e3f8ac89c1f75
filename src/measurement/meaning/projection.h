// SPDX-License-Identifier: Apache-2.0
// Projections of columns of a table, with which the dependence of a motion on one load is found
// while the other loads are held constant (partial regression).
#pragma once

#include <cstddef>
#include <vector>

namespace latsch {

inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Subtracts from `values` their projection on `direction`; does nothing if the direction is the
/// zero vector.
inline void project_out(const std::vector<double>& direction, std::vector<double>& values) {
  const double square = dot(direction, direction);
  if (!(square > 0.0)) return;
  const double share = dot(direction, values) / square;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= share * direction[i];
}

}  // namespace latsch
