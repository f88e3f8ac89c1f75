// SPDX-License-Identifier: Apache-2.0
// Results of the tread blocks for the contact: forces, footprint, energy, and the depth of a tire
// pushed into the road.
//
// The outline is where the depth of the unloaded tips is zero, interpolated linearly between a
// block on the road and its neighbor above the road: along the lines and across them. So the
// outline moves smoothly with the load, by less than a block.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "models/ring_tire/tread/touching_blocks.h"

namespace latsch::ring_tire {

using Eigen::Vector3d;

double RingTreadContact::deepest(const NodeValues& q,
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

std::vector<BlockContact> RingTreadContact::contacts(const NodeValues& q) const {
  std::vector<BlockContact> contacts;
  see_blocks(q, [&](const BlockState& block) {
    if (!(block.share > 0.0)) return;
    const Vector3d push =
        normal_ * CellSquares(block.depth, block.half, bottom_).first_moment * block.normal;
    contacts.push_back({.tip = block.tip,
                        .root = block.root,
                        .unloaded = block.unloaded,
                        .force = block.Fn * block.normal + block.F,
                        .moment = half_cell(block.patch, block.station, q).cross(push),
                        .area = area_,
                        .pressure = block.Fn / (positive_ * area_),
                        .sticks = block.gripped == 1.0 || block.F.isZero(0.0)});
  });
  return contacts;
}

namespace {

/// A block on a line of the footprint: its position along the line and its depth.
struct Dot {
  double at, depth;
};

/// Beginning and end of the contact on such a line; both 0 if nothing touches.
struct Span {
  double begin = 0.0, end = 0.0;
  int above = 0;  // number of blocks between the two that do not touch
};

/// Returns the distance from a block at the edge of the contact to the point of zero depth, at most
/// `spacing`. The tread may end half a spacing beyond the block.
double beyond(const Dot& edge, const Dot* next, double spacing) {
  if (next == nullptr || std::abs(next->at - edge.at) > 1.5 * spacing) return 0.5 * spacing;
  return std::abs(next->at - edge.at) * edge.depth / (edge.depth - next->depth);
}

Span span_of(std::vector<Dot>& dots, double spacing) {
  std::sort(dots.begin(), dots.end(), [](const Dot& a, const Dot& b) { return a.at < b.at; });
  const auto touches = [](const Dot& dot) { return dot.depth > 0.0; };
  const auto first = std::find_if(dots.begin(), dots.end(), touches);
  if (first == dots.end()) return {};
  const auto last = std::find_if(dots.rbegin(), dots.rend(), touches).base() - 1;
  return {first->at - beyond(*first, first == dots.begin() ? nullptr : &*(first - 1), spacing),
          last->at + beyond(*last, last + 1 == dots.end() ? nullptr : &*(last + 1), spacing),
          static_cast<int>(last - first + 1 - std::count_if(first, last + 1, touches))};
}

}  // namespace

Footprint RingTreadContact::footprint(const NodeValues& q,
                                      const Vector3d& center,
                                      const Vector3d& heading) const {
  const Vector3d left = Vector3d::UnitZ().cross(heading);
  const double width = 2.0 * half_width_ / lines_, length = area_ / width;
  std::vector<std::vector<Dot>> along(static_cast<std::size_t>(lines_));
  std::vector<std::vector<Dot>> across(patches_.size() * static_cast<std::size_t>(stride_));
  Footprint print;
  see_blocks(q, [&](const BlockState& block) {
    const Vector3d at = block.tip - center, root = block.root - center;
    along[static_cast<std::size_t>(block.line)].push_back({heading.dot(root), block.depth});
    across[block.patch * static_cast<std::size_t>(stride_) +
           static_cast<std::size_t>(block.station)]
        .push_back({left.dot(root), block.depth});
    if (!(block.Fn > 0.0)) return;
    const Vector3d F = block.Fn * block.normal + block.F;
    const Patch& patch = patches_[block.patch];
    const double factor =
        patch.level ? patch.ground.friction
                    : column(block.patch, kFriction)[block.line * stride_ + block.station];
    const double pressure = block.Fn * block_law().by_force / std::max(block.share, 1e-300);
    print.load += F.z();
    print.elements.push_back({.x = heading.dot(at),
                              .y = left.dot(at),
                              .length = length,
                              .width = width,
                              .pressure = F.z() / area_,
                              .shear_x = heading.dot(F) / area_,
                              .shear_y = left.dot(F) / area_,
                              .friction = factor * law_.mu(0.0, pressure)});
  });
  double front = -kNoRoad, rear = kNoRoad;
  for (auto& line : along) {
    const Span span = span_of(line, length);
    if (span.begin == span.end) continue;
    rear = std::min(rear, span.begin);
    front = std::max(front, span.end);
    print.area += (span.end - span.begin - span.above * length) * width;
  }
  print.length = std::max(0.0, front - rear);
  for (auto& station : across) {
    const Span span = span_of(station, width);
    print.width = std::max(print.width, span.end - span.begin);
  }
  return print;
}

double RingTreadContact::energy(const NodeValues& q) const {
  double sum = 0.0;
  see_touching(q, [&](const BlockState& block) {
    sum += 0.5 * (normal_ * CellSquares(block.depth, block.half, bottom_).mean +
                  tangential_ * block.share * (block.tip - block.root).squaredNorm());
  });
  return sum;
}

}  // namespace latsch::ring_tire
