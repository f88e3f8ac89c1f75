// SPDX-License-Identifier: Apache-2.0
// Search for the nearest corner of a long line in the plane, in a tree of boxes around its
// stretches.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::road {

class LineIndex {
 public:
  LineIndex() = default;
  /// Takes at least one point. The points are not stored: `nearest` must be given the same ones.
  explicit LineIndex(const std::vector<Eigen::Vector2d>& points);

  /// Returns the first of the nearest points.
  int nearest(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& p) const;

 private:
  struct Box {
    Eigen::Vector2d low, high;
    double squared_distance(const Eigen::Vector2d& p) const;
  };

  int leaves_ = 0;          // a power of two
  std::vector<Box> boxes_;  // children of i: 2i and 2i + 1; the root is 1
};

}  // namespace latsch::road
