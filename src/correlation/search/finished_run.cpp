// SPDX-License-Identifier: Apache-2.0
#include "correlation/search/finished_run.h"

#include <fmt/format.h>

#include "correlation/analysis/identification_start.h"

namespace latsch::correlation {
namespace {

constexpr const char* kFinished = "finished";

/// Returns a text that contains everything on which the result of a study depends, except for the
/// identity of the journal.
std::string key_of(const Study& study) {
  return fmt::format("{}/{}/{} ",
                     study.search_key,
                     study.run.intervals,
                     static_cast<int>(study.run.on_failure.then));
}

}  // namespace

void mark_finished(const Study& study, const DesignPoint& begin, Journal& journal) {
  if (finished_run(study, journal) == begin) return;
  journal.mark(kFinished, key_of(study) + text_of_point(begin));
}

std::optional<DesignPoint> finished_run(const Study& study, const Journal& journal) {
  const std::string key = key_of(study);
  std::optional<DesignPoint> begin;
  for (const JournalMark& mark : journal.marks()) {
    if (mark.kind != kFinished) continue;
    const bool is_last = mark.trials == journal.size() && mark.text.starts_with(key);
    begin = is_last ? point_of_text(study, mark.text.substr(key.size())) : std::nullopt;
  }
  return begin;
}

}  // namespace latsch::correlation
