// SPDX-License-Identifier: Apache-2.0
// The trials of a study as a page shows them: every row of its journal with the parts of its
// target, read as they come, so that another set of weights or another stretch of fifty thousand
// trials is a pass over numbers in memory. Channels stay in the journal, but for those of the best
// and of the initial point.
//
// Trials are numbered from 1, as the journal has them. One that nobody asked for
// (asked_trials.h) keeps its number and does not count.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "correlation/target/target_parts.h"
#include "evaluation/journal/asked_trials.h"
#include "evaluation/journal/journal_follower.h"

namespace latsch::studio {

struct TableRow {
  DesignPoint point;
  std::optional<correlation::TargetParts> parts;  // nullopt: it failed
  int reason = -1;                                // of its failure: TrialTable::reasons
  Cause cause = Cause::point;
  float seconds = 0.0F;  // it took
};

class TrialTable {
 public:
  explicit TrialTable(const correlation::Study& study);

  /// Reads what has come, at most so many; whether anything changed. Throws as JournalFollower.
  bool follow(long most);
  bool has_more() const { return has_more_; }
  /// Where the journal was replaced the table began anew; counts up then, and where marks came.
  int edition() const { return edition_; }

  const std::vector<TableRow>& rows() const { return rows_; }
  /// Sentences of failures.
  const std::vector<std::string>& reasons() const { return reasons_; }
  bool counts(std::size_t row) const;
  long failed() const { return failed_; }
  /// Of trials in the journal, read or not.
  long total() const { return follower_.total(); }
  const StudyIdentity& identity() const { return follower_.identity(); }

  const correlation::PartedTarget& target() const { return target_; }

  /// The best row: the least violation, then the least target, of those that count and lie in the
  /// space; nullopt where none succeeded.
  std::optional<std::size_t> best(const correlation::PartedTarget::Weighting& weighting) const;
  /// With the study's own weights.
  std::optional<std::size_t> best() const { return best(own_weights_); }
  /// Where the initial point was tried.
  std::optional<std::size_t> initial() const { return initial_; }

  /// Of the best and of the initial row; nullptr: read_channels() has them.
  const Channels* kept_channels(std::size_t row) const;

 private:
  void take(const Trial& trial);
  /// Whether it can be a result: inside the space, and with the variables that are held in place.
  bool can_be_best(const DesignPoint& point) const;

  DesignSpace space_;
  correlation::Study study_;
  correlation::PartedTarget target_;
  correlation::PartedTarget::Weighting own_weights_;
  JournalFollower follower_;
  AskedTrials asked_{{}};
  std::vector<TableRow> rows_;
  std::vector<std::string> reasons_;
  std::map<std::string, int> reason_places_;
  long failed_ = 0;
  bool has_more_ = false;
  int edition_ = 0;
  /// With the study's own weights, and the initial point, with their channels.
  std::optional<std::size_t> kept_best_, initial_;
  Channels kept_best_channels_, initial_channels_;
};

/// Of any row that succeeded, from its journal: as long as it takes to read all rows before it.
Result<Channels> read_channels(const std::filesystem::path& journal, std::size_t row);

/// Whether a trial is better than another one.
struct Rank {
  double violation = std::numeric_limits<double>::infinity();
  double target = std::numeric_limits<double>::infinity();
  bool operator<(const Rank& other) const;
};

}  // namespace latsch::studio
