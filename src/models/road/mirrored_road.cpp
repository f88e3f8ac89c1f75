// SPDX-License-Identifier: Apache-2.0
#include "models/road/mirrored_road.h"

#include <vector>

namespace latsch::road {

GroundPoint MirroredRoad::at(double x, double y, double time) const {
  GroundPoint ground = road_.at(x, -y, time);
  ground.normal.y() = -ground.normal.y();
  ground.velocity.y() = -ground.velocity.y();
  ground.turning.x() = -ground.turning.x();
  ground.turning.z() = -ground.turning.z();
  return ground;
}

void MirroredRoad::below(const GroundRow& row, double time, const RowGround& ground) const {
  const auto n = static_cast<std::size_t>(row.count);
  std::vector<double> y(2 * n + 1);
  double* const border_y = y.data() + n;
  for (std::size_t j = 0; j < n; ++j) y[j] = -row.y[j];
  for (std::size_t j = 0; j <= n; ++j) border_y[j] = -row.border_y[j];
  road_.below({row.count, row.x, y.data(), row.border_x, border_y}, time, ground);
  for (std::size_t j = 0; j < n; ++j) {
    ground.slope[1][j] = -ground.slope[1][j];
    ground.velocity[1][j] = -ground.velocity[1][j];
  }
}

}  // namespace latsch::road
