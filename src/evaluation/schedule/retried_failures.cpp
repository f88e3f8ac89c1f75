// SPDX-License-Identifier: Apache-2.0
#include "evaluation/schedule/retried_failures.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

namespace latsch {
namespace {

constexpr const char* kRetry = "retry";
constexpr const char* kLimits = "limits";
constexpr const char* kAll = "all";
constexpr const char* kTimeout = "timeout";
constexpr const char* kProgramTimeout = "program timeout";
constexpr const char* kMemory = "memory";

bool says(const Failure& failure, std::string_view words) {
  return failure.reason.find(words) != std::string::npos;
}

/// True if the failure may be due to a lack of memory: a process that is refused memory may report
/// this or just end.
bool may_lack_memory(const Failure& failure) {
  static constexpr std::array<std::string_view, 8> kWords{"out of memory",
                                                          "Out of memory",
                                                          "OutOfMemory",
                                                          "MemoryError",
                                                          "bad_alloc",
                                                          "annot allocate",
                                                          "killed by signal",
                                                          "exited with code"};
  for (const std::string_view words : kWords) {
    if (says(failure, words)) return true;
  }
  return false;
}

bool concerns(const std::string& what, const Failure& failure) {
  // The text is a part of the message in outside_program.cpp.
  const bool is_program = says(failure, "allowed to it");
  if (what == kTimeout) return failure.cause == Cause::timeout && !is_program;
  if (what == kProgramTimeout) return failure.cause == Cause::timeout && is_program;
  if (what == kMemory) return failure.cause != Cause::timeout && may_lack_memory(failure);
  return what == kAll;
}

/// True if a mark says that this failure is to be repeated. `row` is the row of its trial in the
/// journal, counted from 1.
bool is_to_be_tried_again(const std::vector<JournalMark>& marks, long row, const Failure& failure) {
  for (const JournalMark& mark : marks) {
    if (mark.kind == kRetry && row <= mark.trials && concerns(mark.text, failure)) return true;
  }
  return false;
}

/// Returns the number of points whose latest trial is a failure that `what` concerns and that still
/// counts.
long failed_points(const Journal& journal, const std::string& what) {
  std::set<std::string> failed;
  TrialsThatCount(journal).for_each([&](const Trial& trial) {
    const auto& result = trial.outcome.result;
    if (!result && concerns(what, result.failure())) {
      failed.insert(trial.point.bits());
    } else {
      failed.erase(trial.point.bits());
    }
  });
  return std::ssize(failed);
}

long retry(Journal& journal, const char* what) {
  const long points = failed_points(journal, what);
  if (points > 0) journal.mark(kRetry, what);
  return points;
}

std::string text_of(const TrialLimits& limits) {
  return fmt::format("{} {} {}", limits.timeout, limits.program_timeout, limits.memory);
}

std::optional<TrialLimits> last_limits(const Journal& journal) {
  std::optional<TrialLimits> last;
  for (const JournalMark& mark : journal.marks()) {
    if (mark.kind != kLimits) continue;
    TrialLimits limits;
    std::istringstream text(mark.text);
    if (text >> limits.timeout >> limits.program_timeout >> limits.memory) last = limits;
  }
  return last;
}

bool is_raised(double before, double now) { return before > 0.0 && (now > before || now == 0.0); }

}  // namespace

long retry_failures(Journal& journal) { return retry(journal, kAll); }

long retry_what_limits_forbade(Journal& journal, const TrialLimits& limits) {
  const auto before = last_limits(journal);
  if (before && text_of(*before) == text_of(limits)) return 0;
  long points = 0;
  if (before) {
    if (is_raised(before->timeout, limits.timeout)) points += retry(journal, kTimeout);
    if (is_raised(before->program_timeout, limits.program_timeout)) {
      points += retry(journal, kProgramTimeout);
    }
    if (is_raised(before->memory, limits.memory)) points += retry(journal, kMemory);
  }
  journal.mark(kLimits, text_of(limits));
  return points;
}

void TrialsThatCount::append(std::span<const Trial> trials) {
  assert(written_ && "for reading only");
  written_->append(trials);
}

void TrialsThatCount::begin_asking() {
  assert(written_ && "for reading only");
  written_->begin_asking();
}

void TrialsThatCount::keep_asked(const std::set<std::string>& points) {
  assert(written_ && "for reading only");
  written_->keep_asked(points);
}

void TrialsThatCount::for_each(const std::function<void(const Trial&)>& visit) const {
  long row = 0;
  read_->for_each([&](const Trial& trial) {
    if (++row > trials_) return;
    const auto& result = trial.outcome.result;
    if (!asked_.contains(row - 1, trial.point)) return;
    if (!result && is_to_be_tried_again(read_->marks(), row, result.failure())) return;
    visit(trial);
  });
}

}  // namespace latsch
