// SPDX-License-Identifier: Apache-2.0
#include "studio/shelf/trial_table.h"

#include <algorithm>
#include <tuple>

#include "correlation/target/best_trial.h"
#include "evaluation/journal/journal.h"

namespace latsch::studio {

using correlation::PartedTarget;
using correlation::TargetParts;

bool Rank::operator<(const Rank& other) const {
  return std::pair(std::max(violation, kFulfilled), target) <
         std::pair(std::max(other.violation, kFulfilled), other.target);
}

namespace {

Rank rank_of(const PartedTarget::Weighting& weighting, const TargetParts& parts) {
  return {parts.violation, weighting.target(parts)};
}

}  // namespace

TrialTable::TrialTable(const correlation::Study& study)
    : space_(study.space),
      study_(study),
      target_(study),
      own_weights_(target_.weighting(target_.weights())),
      follower_(study.run.journal),
      ownership_(study, {}) {}

bool TrialTable::is_inside(const DesignPoint& point) const {
  return space_.contains(point) && correlation::keeps_held(study_, point);
}

bool TrialTable::can_be_best(std::size_t row) const {
  return is_inside(rows_[row].point) &&
         ownership_.can_be_best(static_cast<long>(row), rows_[row].point);
}

bool TrialTable::is_foreign(std::size_t row) const {
  return ownership_.is_known() && !ownership_.is_own(static_cast<long>(row), rows_[row].point);
}

correlation::TrialCounts TrialTable::counts_read() const {
  correlation::TrialCounts counts{.trials = static_cast<long>(rows_.size()), .failed = failed_};
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (is_foreign(row)) ++counts.foreign;
    if (!is_foreign(row) && rows_[row].parts && this->counts(row)) ++counts.own_succeeded;
  }
  return counts;
}

void TrialTable::take(const Trial& trial) {
  TableRow row{trial.point, std::nullopt, -1, Cause::point, 0.0F};
  row.seconds = static_cast<float>(trial.outcome.wall_time);
  const auto& result = trial.outcome.result;
  auto parts = result ? target_.parts(trial.point, *result) : Result<TargetParts>(result.failure());
  const std::size_t place = rows_.size();
  if (parts) {
    row.parts = std::move(*parts);
    if (trial.point == space_.initial()) {
      initial_ = place;
      initial_channels_ = *result;
    }
    const bool is_best = !kept_best_ || rank_of(own_weights_, *row.parts) <
                                            rank_of(own_weights_, *rows_[*kept_best_].parts);
    if (is_best && is_inside(trial.point)) {
      kept_best_ = place;
      kept_best_channels_ = *result;
    }
  } else {
    ++failed_;
    row.cause = parts.failure().cause;
    const auto [known, is_new] =
        reason_places_.emplace(parts.failure().reason, static_cast<int>(reasons_.size()));
    if (is_new) reasons_.push_back(known->first);
    row.reason = known->second;
  }
  rows_.push_back(std::move(row));
}

bool TrialTable::follow(long most) {
  const auto news = follower_.read(most, [&](const Trial& trial) { take(trial); });
  has_more_ = news.has_more;
  if (news.begins_anew) {
    rows_.clear();
    reasons_.clear();
    reason_places_.clear();
    failed_ = 0;
    kept_best_.reset();
    initial_.reset();
  }
  if (news.has_marks) {
    asked_ = AskedTrials(follower_.marks());
    ownership_ = correlation::TrialOwnership(study_, follower_.marks());
  }
  if (news.begins_anew || news.has_marks) ++edition_;
  return news.begins_anew || news.has_marks || news.trials > 0;
}

bool TrialTable::counts(std::size_t row) const {
  return asked_.contains(static_cast<long>(row), rows_[row].point);
}

std::optional<std::size_t> TrialTable::best(const PartedTarget::Weighting& weighting) const {
  std::optional<std::size_t> best;
  Rank least;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (!rows_[k].parts) continue;
    const Rank rank = rank_of(weighting, *rows_[k].parts);
    if (!(rank < least) || !counts(k) || !can_be_best(k)) continue;
    least = rank;
    best = k;
  }
  return best;
}

const Channels* TrialTable::kept_channels(std::size_t row) const {
  if (row == kept_best_) return &kept_best_channels_;
  if (row == initial_) return &initial_channels_;
  return nullptr;
}

Result<Channels> read_channels(const std::filesystem::path& journal, std::size_t row) {
  Result<Channels> found = Failure{"trial " + std::to_string(row + 1) + " is not in the journal"};
  std::size_t place = 0;
  JournalFollower(journal).read(static_cast<long>(row) + 1, [&](const Trial& trial) {
    if (place++ == row) found = trial.outcome.result;
  });
  return found;
}

}  // namespace latsch::studio
