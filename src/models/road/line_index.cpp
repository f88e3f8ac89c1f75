// SPDX-License-Identifier: Apache-2.0
#include "models/road/line_index.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace latsch::road {
namespace {

constexpr int kLeaf = 16;  // number of points per leaf
constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

double LineIndex::Box::squared_distance(const Eigen::Vector2d& p) const {
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

LineIndex::LineIndex(const std::vector<Eigen::Vector2d>& points) {
  assert(!points.empty());
  const int count = static_cast<int>(points.size());
  leaves_ = 1;
  while (leaves_ * kLeaf < count) leaves_ *= 2;
  const Box nothing{Eigen::Vector2d::Constant(kInfinite), Eigen::Vector2d::Constant(-kInfinite)};
  boxes_.assign(2 * leaves_, nothing);
  for (int i = 0; i < count; ++i) {
    Box& box = boxes_[leaves_ + i / kLeaf];
    box.low = box.low.cwiseMin(points[i]);
    box.high = box.high.cwiseMax(points[i]);
  }
  for (int i = leaves_ - 1; i > 0; --i) {
    boxes_[i].low = boxes_[2 * i].low.cwiseMin(boxes_[2 * i + 1].low);
    boxes_[i].high = boxes_[2 * i].high.cwiseMax(boxes_[2 * i + 1].high);
  }
}

int LineIndex::nearest(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& p) const {
  int best = 0;
  double least = kInfinite;
  std::array<int, 64> open;  // stack of open boxes; at most two per level of the tree
  int size = 0;
  open[size++] = 1;
  while (size > 0) {
    const int box = open[--size];
    if (boxes_[box].squared_distance(p) > least) continue;
    if (box < leaves_) {
      const bool left =
          boxes_[2 * box].squared_distance(p) <= boxes_[2 * box + 1].squared_distance(p);
      open[size++] = 2 * box + (left ? 1 : 0);
      open[size++] = 2 * box + (left ? 0 : 1);
      continue;
    }
    const int begin = (box - leaves_) * kLeaf;
    const int end = std::min<int>(begin + kLeaf, static_cast<int>(points.size()));
    for (int i = begin; i < end; ++i) {
      const double distance = (points[i] - p).squaredNorm();
      if (distance < least || (distance == least && i < best)) {
        least = distance;
        best = i;
      }
    }
  }
  return best;
}

}  // namespace latsch::road
