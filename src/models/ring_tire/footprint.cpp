// SPDX-License-Identifier: Apache-2.0
// What the tread blocks tell about the contact: resultants, footprint, energy, depth of a tire
// pushed into the road.
#include <algorithm>
#include <limits>

#include "models/ring_tire/touching_blocks.h"

namespace latsch::ring_tire {

using Eigen::Vector3d;

double TreadContact::deepest(const NodeValues& q,
                             const RimFrame& rim,
                             const road::Road& road,
                             double time) {
  a_ = rim.a;
  double deepest = -std::numeric_limits<double>::infinity();
  for (int segment = 0; segment < nodes_; ++segment) {
    patches_.clear();
    add_patch(q, segment);
    for (int line = 0; line < lines_; ++line)
      for (int j = 0; j < blocks_; ++j) {
        const Vector3d at = tip(line, j);
        if (at.z() > rim.center.z()) continue;
        deepest = std::max(deepest, road.height(at.x(), at.y(), time) - at.z());
      }
  }
  patches_.clear();
  return deepest;
}

std::vector<BlockContact> TreadContact::footprint(const NodeValues& q) const {
  std::vector<BlockContact> contacts;
  see_touching(q, [&](const BlockState& block) {
    contacts.push_back({.tip = block.tip,
                        .root = block.root,
                        .force = block.Fn * block.normal + block.F,
                        .area = area_,
                        .pressure = block.Fn / (positive_ * area_),
                        .sticks = block.gripped == 1.0 || block.F.isZero(0.0)});
  });
  return contacts;
}

double TreadContact::energy(const NodeValues& q) const {
  double sum = 0.0;
  see_touching(q, [&](const BlockState& block) {
    sum += 0.5 *
           (block.Fn * block.Fn / normal_ + tangential_ * (block.tip - block.root).squaredNorm());
  });
  return sum;
}

}  // namespace latsch::ring_tire
