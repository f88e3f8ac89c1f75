// SPDX-License-Identifier: Apache-2.0
// Which trials of a journal somebody asked for, and which were speculation that never came true.
//
// What runs ahead of a search depends on the workers and their timing. It saves time where the
// search arrives there, but it must not be a result: a best trial that only three workers find
// would make the result depend on them. So whoever ends keeps a mark of the points it was answered;
// a trial counts where a mark names its point. Before the first mark (journals of older programs)
// and behind the last one (commands that were killed, or that run now) nobody has said what a trial
// was for: there all count.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "evaluation/journal/journal_mark.h"
#include "optimization/problem/design_point.h"

namespace latsch {

class AskedTrials {
 public:
  explicit AskedTrials(std::span<const JournalMark> marks);

  bool is_marked() const { return is_marked_; }

  /// Of the trial in that row of the journal, the first is 0.
  bool contains(long row, const DesignPoint& point) const;

  /// The text of a mark for these points (DesignPoint::bits) but those that are known; nullopt
  /// where it would say nothing about a journal of so many trials.
  std::optional<std::string> mark_for(const std::set<std::string>& points, long trials) const;

  static constexpr const char* kKind = "asked";

 private:
  bool is_marked_ = false;
  long first_ = 0;  // trials there were at the first mark
  long last_ = 0;   // and at the last one
  std::set<std::uint64_t> points_;
};

}  // namespace latsch
