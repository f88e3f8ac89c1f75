// SPDX-License-Identifier: Apache-2.0
// The trials of a study as a page shows them: every row of the journal with the parts of its
// target, computed as the rows arrive. Other weights, or another range out of fifty thousand
// trials, then need only a pass over numbers in memory. The channels stay in the journal, except
// those of the best and of the initial point.
//
// Trials are numbered from 1, as in the journal. A trial that the search did not request
// (asked_trials.h) has a number but does not count.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "correlation/target/target_parts.h"
#include "correlation/target/trial_ownership.h"
#include "evaluation/journal/asked_trials.h"
#include "evaluation/journal/journal_follower.h"

namespace latsch::studio {

struct TableRow {
  DesignPoint point;
  std::optional<correlation::TargetParts> parts;  // nullopt: the trial has failed
  /// Index of the failure's reason in TrialTable::reasons(); -1: no failure.
  int reason = -1;
  Cause cause = Cause::point;
  float seconds = 0.0F;  // s, duration of the trial
};

class TrialTable {
 public:
  explicit TrialTable(const correlation::Study& study);

  /// Reads at most `most` new trials. Returns true if anything changed. Throws the same errors as
  /// JournalFollower.
  bool follow(long most);
  bool has_more() const { return has_more_; }
  /// Number that increases if the journal was replaced, so that the table was emptied, or if trials
  /// were marked as not requested.
  int edition() const { return edition_; }

  const std::vector<TableRow>& rows() const { return rows_; }
  /// Returns the reasons of failures, each sentence once.
  const std::vector<std::string>& reasons() const { return reasons_; }
  bool counts(std::size_t row) const;
  long failed() const { return failed_; }
  /// Counts the rows that have been read, as the terminal does (search/search_standing.h).
  correlation::TrialCounts counts_read() const;
  /// True if the trial may count as the best of the present study (target/trial_ownership.h).
  bool can_be_best(std::size_t row) const;
  /// True if the trial was run for other measurements, weights or bounds than those of the present
  /// study.
  bool is_foreign(std::size_t row) const;
  const correlation::TrialOwnership& ownership() const { return ownership_; }
  /// Returns the number of trials in the journal, whether read or not.
  long total() const { return follower_.total(); }
  const StudyIdentity& identity() const { return follower_.identity(); }

  const correlation::PartedTarget& target() const { return target_; }

  /// Returns the best among the rows that count and whose point lies in the design space: the one
  /// with the least constraint violation, then the least target. Returns nullopt if none succeeded.
  std::optional<std::size_t> best(const correlation::PartedTarget::Weighting& weighting) const;
  /// Returns the best row with the study's own weights.
  std::optional<std::size_t> best() const { return best(own_weights_); }
  /// Returns the row of the initial point, if a trial was run there.
  std::optional<std::size_t> initial() const { return initial_; }

  /// Returns the channels of the best or of the initial row; nullptr for other rows, for which
  /// read_channels() is used.
  const Channels* kept_channels(std::size_t row) const;

 private:
  void take(const Trial& trial);
  /// True if the point can be a result: inside the design space, with the held variables at their
  /// values.
  bool is_inside(const DesignPoint& point) const;

  DesignSpace space_;
  correlation::Study study_;
  correlation::PartedTarget target_;
  correlation::PartedTarget::Weighting own_weights_;
  JournalFollower follower_;
  AskedTrials asked_{{}};
  correlation::TrialOwnership ownership_;
  std::vector<TableRow> rows_;
  std::vector<std::string> reasons_;
  std::map<std::string, int> reason_places_;
  long failed_ = 0;
  bool has_more_ = false;
  int edition_ = 0;
  /// The best row with the study's own weights and the initial row, with their channels.
  std::optional<std::size_t> kept_best_, initial_;
  Channels kept_best_channels_, initial_channels_;
};

/// Returns the channels of any successful row from the journal. This takes as long as reading all
/// earlier rows.
Result<Channels> read_channels(const std::filesystem::path& journal, std::size_t row);

/// Sort key that orders trials from better to worse.
struct Rank {
  double violation = std::numeric_limits<double>::infinity();
  double target = std::numeric_limits<double>::infinity();
  bool operator<(const Rank& other) const;
};

}  // namespace latsch::studio
