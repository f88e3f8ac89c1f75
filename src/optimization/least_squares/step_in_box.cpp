// SPDX-License-Identifier: Apache-2.0
#include "optimization/least_squares/step_in_box.h"

#include <algorithm>
#include <utility>

namespace latsch {

std::vector<int> free_in_box(const Eigen::VectorXd& z,
                             const Eigen::VectorXd& g,
                             const Eigen::VectorXd& lower,
                             const Eigen::VectorXd& upper) {
  std::vector<int> free;
  for (int i = 0; i < z.size(); ++i) {
    const bool is_held = (z[i] <= lower[i] && g[i] > 0.0) || (z[i] >= upper[i] && g[i] < 0.0);
    if (!is_held) free.push_back(i);
  }
  return free;
}

Eigen::VectorXd step_in_box(const Eigen::VectorXd& lower,
                            const Eigen::VectorXd& upper,
                            std::vector<int> free,
                            const FreeStep& step) {
  Eigen::VectorXd p = Eigen::VectorXd::Zero(lower.size());
  while (!free.empty()) {
    const Eigen::VectorXd wished = step(p, free);
    std::vector<int> inside;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const int i = free[k];
      const double possible = std::clamp(wished[static_cast<Eigen::Index>(k)], lower[i], upper[i]);
      if (possible == wished[static_cast<Eigen::Index>(k)]) {
        inside.push_back(i);
      } else {
        p[i] = possible;
      }
    }
    if (inside.size() == free.size()) {
      p(free) = wished;
      break;
    }
    free = std::move(inside);
  }
  return p;
}

}  // namespace latsch
