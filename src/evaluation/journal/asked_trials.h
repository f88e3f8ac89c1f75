// SPDX-License-Identifier: Apache-2.0
// Separates the requested trials of a journal from speculation that was never needed.
//
// Speculative trials, which run ahead of a search, depend on the workers and their timing. They
// save time if the search later requests their points, but they must not be results: a best trial
// that only three workers find would make the result depend on the number of workers. Every command
// therefore ends by writing a mark with the points whose outcomes it used, and a trial counts if a
// mark names its point. Before the first mark (journals of older programs) and after the last one
// (commands that were killed, or are running) the purpose of trials is not known, so all of them
// count.
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

  /// True if the trial in the given row of the journal, the first being 0, counts as requested.
  bool contains(long row, const DesignPoint& point) const;

  /// Returns the text of a mark for those of these points (DesignPoint::bits) that are not marked
  /// yet. Returns nullopt if all are marked and no mark is needed for a journal with this number of
  /// trials.
  std::optional<std::string> mark_for(const std::set<std::string>& points, long trials) const;

  static constexpr const char* kKind = "asked";

 private:
  bool is_marked_ = false;
  long first_ = 0;  // number of trials at the first mark
  long last_ = 0;   // number of trials at the last mark
  std::set<std::uint64_t> points_;
};

}  // namespace latsch
