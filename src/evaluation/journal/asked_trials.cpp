// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/asked_trials.h"

#include <fmt/format.h>

#include <sstream>

#include "evaluation/trial/encoding.h"

namespace latsch {

AskedTrials::AskedTrials(std::span<const JournalMark> marks) {
  for (const JournalMark& mark : marks) {
    if (mark.kind != kKind) continue;
    if (!is_marked_) first_ = mark.trials;
    is_marked_ = true;
    last_ = mark.trials;
    std::istringstream text(mark.text);
    for (std::uint64_t point = 0; text >> std::hex >> point;) points_.insert(point);
  }
}

bool AskedTrials::contains(long row, const DesignPoint& point) const {
  if (!is_marked_ || row < first_ || row >= last_) return true;
  return points_.contains(hash(point.bits()));
}

std::optional<std::string> AskedTrials::mark_for(const std::set<std::string>& points,
                                                 long trials) const {
  std::string text;
  for (const std::string& bits : points) {
    const std::uint64_t point = hash(bits);
    if (!points_.contains(point)) text += fmt::format("{}{:x}", text.empty() ? "" : " ", point);
  }
  if (text.empty() && is_marked_ && last_ == trials) return std::nullopt;
  return text;
}

}  // namespace latsch
