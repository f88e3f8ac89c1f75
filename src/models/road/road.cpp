// SPDX-License-Identifier: Apache-2.0
#include "models/road/road.h"

namespace latsch::road {

double Road::mean_height(const Eigen::Vector2d& from,
                         const Eigen::Vector2d& to,
                         double time) const {
  constexpr int kSamples = 16;
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector2d at = from + (i + 0.5) / kSamples * (to - from);
    sum += height(at.x(), at.y(), time);
  }
  return sum / kSamples;
}

std::string Road::beyond(double, double) const { return {}; }

void Road::below(const GroundRow& row, double time, const RowGround& ground) const {
  for (int j = 0; j <= row.count; ++j)
    ground.border_height[j] = height(row.border_x[j], row.border_y[j], time);
  for (int j = 0; j < row.count; ++j) {
    const GroundPoint middle = at(row.x[j], row.y[j], time);
    ground.height[j] = ground.mean[j] = middle.height;
    if (!is_straight(ground.border_height[j], middle.height, ground.border_height[j + 1]))
      ground.mean[j] = mean_height(
          {row.border_x[j], row.border_y[j]}, {row.border_x[j + 1], row.border_y[j + 1]}, time);
    for (int i = 0; i < 2; ++i) ground.slope[i][j] = -middle.normal[i] / middle.normal.z();
    ground.friction[j] = middle.friction;
    for (int i = 0; i < 3; ++i) ground.velocity[i][j] = middle.velocity[i];
  }
}

}  // namespace latsch::road
