// SPDX-License-Identifier: Apache-2.0
// State of the blocks at the end of the last step: the positions of their tips on the road and the
// shares of their cells on it, only for the segments near the road. It is a value whose copies
// share their data, which never change, so copying a state is cheap.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace latsch::ring_tire {

struct TreadTips {
  enum Column { kX, kY, kZ, kShare, kColumns };

  std::vector<int> segments;    // ascending
  std::vector<double> columns;  // for each segment, `blocks` long: lines one after the other
  int blocks = 0;

  double* column(std::size_t at, int c) { return columns.data() + (at * kColumns + c) * blocks; }
  const double* column(std::size_t at, int c) const {
    return columns.data() + (at * kColumns + c) * blocks;
  }

  bool operator==(const TreadTips&) const = default;
};

class TreadMemory {
 public:
  /// A state without touching blocks.
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
