// SPDX-License-Identifier: Apache-2.0
// The numbers of a point, or of what was found there, as a vector of Eigen's.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

inline Eigen::VectorXd to_vector(const std::vector<double>& u) {
  return Eigen::Map<const Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size()));
}

}  // namespace latsch
