// SPDX-License-Identifier: Apache-2.0
// What the blocks remember of the last step: where their tips are on the road and which share of
// their cells is there, of the segments near the road alone. A value whose copies share what it
// holds, since nobody changes it: a state is copied at no cost.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace latsch::ring_tire {

struct TreadTips {
  enum Column { kX, kY, kZ, kShare, kColumns };

  std::vector<int> segments;    // ascending
  std::vector<double> columns;  // of each segment, `blocks` long: lines one after the other
  int blocks = 0;

  double* column(std::size_t at, int c) { return columns.data() + (at * kColumns + c) * blocks; }
  const double* column(std::size_t at, int c) const {
    return columns.data() + (at * kColumns + c) * blocks;
  }

  bool operator==(const TreadTips&) const = default;
};

class TreadMemory {
 public:
  /// No block touches.
  TreadMemory() = default;
  explicit TreadMemory(std::shared_ptr<const TreadTips> tips) : tips_(std::move(tips)) {}

  const std::shared_ptr<const TreadTips>& tips() const { return tips_; }

  bool operator==(const TreadMemory& other) const {
    if (tips_ == other.tips_) return true;
    return tips_ && other.tips_ && *tips_ == *other.tips_;
  }

 private:
  std::shared_ptr<const TreadTips> tips_;
};

}  // namespace latsch::ring_tire
