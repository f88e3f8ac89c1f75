// SPDX-License-Identifier: Apache-2.0
// Finds the vertex of a long polyline in the plane that is nearest to a point, through a tree of
// bounding boxes around stretches of the line.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch::road {

class LineIndex {
 public:
  LineIndex() = default;
  /// Builds the index of at least one point. The points are not stored, so nearest() must be called
  /// with the same ones.
  explicit LineIndex(const std::vector<Eigen::Vector2d>& points);

  /// Returns the index of the nearest point; of several equally near ones the first.
  int nearest(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& p) const;

 private:
  struct Box {
    Eigen::Vector2d low, high;
    double squared_distance(const Eigen::Vector2d& p) const;
  };

  int leaves_ = 0;  // number of leaves of the tree, a power of two
  // Boxes of the tree: the root is 1, the children of box i are 2i and 2i + 1.
  std::vector<Box> boxes_;
};

}  // namespace latsch::road
