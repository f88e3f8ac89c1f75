// SPDX-License-Identifier: Apache-2.0
// Converts the numbers of a point, or its results, to an Eigen vector.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

inline Eigen::VectorXd to_vector(const std::vector<double>& u) {
  return Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size()));
}

}  // namespace latsch
