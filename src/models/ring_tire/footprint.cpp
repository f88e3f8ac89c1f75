// SPDX-License-Identifier: Apache-2.0
// What the tread blocks tell about the contact: resultants, footprint, energy, depth of a tire
// pushed into the road.
#include <algorithm>
#include <limits>

#include "models/ring_tire/tread_contact.h"

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

/// What one block of a patch does.
struct TreadContact::BlockState {
  Vector3d normal, F, root, tip;
  double Fn, gripped;
};

/// Calls `see` with the state of every block that touches, in the order of the patches; q: of the
/// last add_force.
template <class See>
void TreadContact::see_touching(const NodeValues& q, const See& see) const {
  std::vector<double> columns(static_cast<std::size_t>(9 * stride_));
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const Patch& patch = patches_[i];
    station_columns(stations_of(i, q, q), columns.data());
    for (int line = 0; line < lines_; ++line)
      for (int j = patch.begin; j < patch.end; ++j) {
        const int block = line * stride_ + j;
        const auto at = [&](int c) { return column(i, c)[block]; };
        if (!(at(kFn) > 0.0)) continue;
        BlockState state{.normal = {at(kNormal), at(kNormal + 1), at(kNormal + 2)},
                         .F = {at(kF), at(kF + 1), at(kF + 2)},
                         .root = tip(columns.data(), line, j),
                         .tip = {at(kTip), at(kTip + 1), at(kTip + 2)},
                         .Fn = at(kFn),
                         .gripped = at(kGripped)};
        if (patch.level) {
          state.normal = Vector3d::UnitZ();
          state.F.z() = 0.0;
          state.tip.z() = patch.ground.height;
        }
        state.root += state.normal * state.normal.dot(state.tip - state.root);
        see(state);
      }
  }
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
