// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/trial_ownership.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "evaluation/trial/encoding.h"

namespace latsch::correlation {
namespace {

constexpr const char* kTarget = "target";
constexpr const char* kEnded = "ended";
constexpr const char* kDesign = "design";
constexpr const char* kTakenOver = "taken over";

/// Returns the text of the mark that a search leaves at its end. It names the last stage, whose
/// result is that of the study.
std::string ending_of(const Study& study) {
  const std::string& stage =
      study.stage.empty() && !study.stages.empty() ? study.stages.back().name : study.stage;
  return stage.empty() ? study.target_key : study.target_key + "/" + stage;
}

/// Writes a mark unless the last mark of its kind has the same text.
void mark_once(Journal& journal, const char* kind, const std::string& text) {
  const auto& marks = journal.marks();
  const auto last = std::find_if(
      marks.rbegin(), marks.rend(), [&](const auto& mark) { return mark.kind == kind; });
  if (last == marks.rend() || last->text != text) journal.mark(kind, text);
}

}  // namespace

TrialOwnership::TrialOwnership(const Study& study, std::span<const JournalMark> marks) {
  const std::string ending = ending_of(study);
  for (const JournalMark& mark : marks) {
    if (mark.kind == kTarget) {
      is_known_ = true;
      stretches_.push_back({mark.trials, mark.text == study.target_key});
    } else if (mark.kind == kEnded) {
      has_ended_ = has_ended_ || mark.text == ending;
    } else if (mark.kind == kDesign && mark.text.starts_with(study.target_key)) {
      std::istringstream text(mark.text.substr(study.target_key.size()));
      for (std::uint64_t point = 0; text >> std::hex >> point;) taken_.insert(point);
    }
  }
}

bool TrialOwnership::is_own(long row, const DesignPoint& point) const {
  if (!taken_.empty() && taken_.contains(hash(point.bits()))) return true;
  const auto after = std::upper_bound(
      stretches_.begin(), stretches_.end(), row, [](long at, const Stretch& stretch) {
        return at < stretch.begin;
      });
  return after != stretches_.begin() && std::prev(after)->is_own;
}

void mark_target(const Study& study, Journal& journal) {
  mark_once(journal, kTarget, study.target_key);
}

void mark_taken_over(Journal& journal) { mark_once(journal, kTarget, kTakenOver); }

void mark_ended(const Study& stage, Journal& journal) {
  if (!TrialOwnership(stage, journal.marks()).has_ended()) journal.mark(kEnded, ending_of(stage));
}

void mark_design(const Study& study, const std::vector<DesignPoint>& points, Journal& journal) {
  std::set<std::string> planned;
  for (const DesignPoint& point : points) planned.insert(point.bits());
  const TrialOwnership known(study, journal.marks());
  std::set<std::uint64_t> taken;
  long row = 0;
  journal.for_each([&](const Trial& trial) {
    if (!known.is_own(row++, trial.point) && planned.contains(trial.point.bits()))
      taken.insert(hash(trial.point.bits()));
  });
  if (taken.empty()) return;
  std::string text = study.target_key;
  for (const std::uint64_t point : taken) text += fmt::format(" {:x}", point);
  journal.mark(kDesign, text);
}

namespace {

std::string succeeded_in_words(const TrialCounts& counts) {
  return fmt::format("{} trial{}, {} succeeded and {} failed",
                     counts.trials,
                     counts.trials == 1 ? "" : "s",
                     counts.succeeded(),
                     counts.failed);
}

}  // namespace

std::string in_words_below_result(const TrialCounts& counts) {
  std::string text = succeeded_in_words(counts);
  if (counts.foreign > 0)
    text += fmt::format(
        "; {} of them {} simulated earlier, for other measurements, weights or bounds, on which no "
        "simulation depends: the search took {} in place of new ones",
        counts.foreign == counts.trials && counts.trials > 1 ? "all"
                                                             : std::to_string(counts.foreign),
        counts.foreign == 1 ? "was" : "were",
        counts.foreign == 1 ? "it" : "them");
  return text;
}

std::string in_words(const TrialCounts& counts) {
  std::string text = succeeded_in_words(counts);
  if (counts.foreign > 0)
    text += fmt::format(
        "; {} of them {} run for the study as it stands, {} for other measurements, weights or "
        "bounds",
        counts.own(),
        counts.own() == 1 ? "was" : "were",
        counts.foreign);
  return text;
}

}  // namespace latsch::correlation
