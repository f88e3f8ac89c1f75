// SPDX-License-Identifier: Apache-2.0
// Detects Newton corrections that repeat themselves with a factor ρ: along one direction the
// tangent is wrong, too soft if ρ < 0, and the remaining corrections form a geometric series,
//   d + ρ d + ρ² d .. = d/(1 - ρ),  ρ = d_before . d/(d_before . d_before)
// [Aitken's process, along one direction]. It is used only if corrections are nearly parallel. This
// happens with sections under blocks whose dampers carry as much as their springs: these are twice
// as stiff as in the tangent.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace latsch::ring_tire {

class RepeatedCorrection {
 public:
  /// Forgets the last correction.
  void start() { squares_ = 0.0; }
  /// Returns the factor for a correction of nodes and sections that is the first of a series;
  /// otherwise 1.
  double lengthening(const Eigen::Matrix4Xd& nodes, const Eigen::VectorXd& sections) {
    constexpr double kLeast = 0.5, kMost = 0.98;  // limits of |ρ|
    constexpr double kAlike = 0.95;               // least cosine of parallel corrections
    const auto x = nodes.topRows<3>().reshaped();
    const double own = x.squaredNorm() + sections.squaredNorm();
    double by = 1.0;
    if (squares_ > 0.0 && sections.size() == sections_.size()) {
      const double along = x.dot(nodes_) + sections.dot(sections_), ratio = along / squares_;
      if (std::abs(ratio) > kLeast && std::abs(ratio) < kMost &&
          std::abs(along) > kAlike * std::sqrt(own * squares_))
        by = 1.0 / (1.0 - ratio);
    }
    squares_ = by == 1.0 ? own : 0.0;  // after a leap a new series begins
    nodes_ = x;
    sections_ = sections;
    return by;
  }

 private:
  double squares_ = 0.0;  // 0: none
  Eigen::VectorXd nodes_, sections_;
};

}  // namespace latsch::ring_tire
