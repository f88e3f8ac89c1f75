// SPDX-License-Identifier: Apache-2.0
// Distinguishes the slip of a rolling tire that still relaxes from forces that vary with the
// rotation of the wheel. The tire rolls in rounds of equal length L. The range r_k of round k is
// the largest difference of a force over the second half of that round.
//   slip of relaxation length s:   r_k ~ exp(-k L / s),    falls from round to round
//   segments and blocks of a belt:   r_k goes up and down about a constant. The steps of the rounds
//   sample the passing segments at changing phases, so the sampled force beats.
// Two quarters of the rounds are therefore compared by their largest ranges, because a single range
// of a beat may be small by chance:
//   falling if   max(last quarter) < f^(w/3) max(quarter before),   w: rounds of a quarter
// where f is the share of the range that remains after three rounds. A relaxation of constant
// length meets this condition after any number of rounds, or after none.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace latsch::car {

class FallingRanges {
 public:
  /// Adds the force of one step in the second half of a round, N.
  void add(const Eigen::Vector3d& force) {
    low_ = low_.cwiseMin(force);
    high_ = high_.cwiseMax(force);
  }
  void end_round() {
    ranges_.push_back((high_ - low_).maxCoeff());
    low_.setConstant(std::numeric_limits<double>::infinity());
    high_ = -low_;
  }
  /// Returns the largest range of the last quarter of the rounds, N, if the ranges still fall and
  /// are above `least` (N); otherwise 0. At least four rounds are needed.
  double still_falling(double least) const {
    const auto quarter = static_cast<std::ptrdiff_t>(ranges_.size() / 4);
    assert(quarter > 0);
    const auto middle = ranges_.end() - quarter;
    const double before = *std::max_element(middle - quarter, middle);
    const double last = *std::max_element(middle, ranges_.end());
    const double remains = std::pow(kFalls, static_cast<double>(quarter) / 3.0);
    return last > least && last < remains * before ? last : 0.0;
  }

 private:
  // Share of the range that remains after three rounds; rounds of 0.3 m: a relaxation length of
  // 8.5 m.
  static constexpr double kFalls = 0.9;

  Eigen::Vector3d low_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()),
                  high_ = -low_;
  std::vector<double> ranges_;
};

}  // namespace latsch::car
