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

}  // namespace latsch::road
