// SPDX-License-Identifier: Apache-2.0
// Starts points on workers and stores their outcomes in the journal, even if workers fail.
//
// - A point that was evaluated, is being evaluated or is being stored is not started again.
// - A point is started at most `retries` + 2 times, including all copies: once, once more for a
//   loss that is not its own fault, and as often as the failure policy demands. A start whose
//   worker was lost before it began (Cause::not_begun) does not count.
// - A trial whose worker was lost (Cause::transient) says nothing about its point and is repeated
//   until its starts are used up: if a point needs too much memory, the system kills every worker
//   that tries it. Other failures are repeated if the failure policy says so.
// - A trial is a straggler if it runs much longer than the median while a worker is idle. A second
//   copy of it is started, once. Evaluators are pure, so whichever copy ends first with channels
//   gives the same bits. If one copy is lost or exceeds its time limit, this counts as an attempt,
//   and the other copy continues. A point that has failed or exceeded its time limit gets no new
//   copy, because it would do so again.
// - An outcome counts once it is on the disk.
//
// - If a wanted point is no longer requested, it is withdrawn if it has not started. A running
//   trial may still be needed, and its worker has begun it; only a straggler is stopped,
//   and only if a wanted point waits for a worker.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "evaluation/executors/executor.h"
#include "evaluation/schedule/group_commit.h"
#include "evaluation/schedule/run_options.h"

namespace latsch {

/// Scores of all outcomes so far, keyed by the bits of the point. Channels are large and stay on
/// disk.
class KnownScores {
 public:
  explicit KnownScores(const Objective& objective) : objective_(objective) {}

  void add(const Trial& trial);
  /// Adds a trial that was stored earlier. If slopes are needed and the trial has none, it is not
  /// added, so that its point is evaluated again.
  void add_kept(const Trial& trial);
  const Result<Score>* find(const DesignPoint& point) const;

 private:
  const Objective& objective_;
  std::unordered_map<std::string, Result<Score>> scores_;
};

class Dispatcher {
 public:
  /// `planned` is the number of points that can become wanted, for the progress bar.
  Dispatcher(const Objective& objective,
             Executor& executor,
             TrialStore* store,
             const RunOptions& options,
             long planned);

  /// Returns the outcome of the first of these points. Meanwhile idle workers evaluate the points
  /// after it, most urgent first. Returns nullptr if a stop was requested before the outcome was
  /// known.
  const Result<Score>* first_of(std::span<const DesignPoint> wanted);

  /// Evaluates all of these points and calls `known` with each point and its outcome in their
  /// order. Returns false if `known` returned false or a stop was requested, either of which ends
  /// the work early.
  bool all_of(std::span<const DesignPoint> wanted,
              const std::function<bool(const DesignPoint&, const Result<Score>&)>& known);

  /// Withdraws running trials. Returns when every finished trial and the record of the requested
  /// points (asked_trials.h) are on the disk.
  void finish();

  /// Adds an outcome that the optimizer, or the sampling plan, has received to the progress report.
  void count(const DesignPoint& point, const Result<Score>& outcome, bool is_score);
  void report();

  bool knows(const DesignPoint& point) const { return known_.find(point) != nullptr; }
  /// Returns the mean time of the trials so far, s; 0 if there is none.
  double trial_time() const { return progress_.trial_wall_time; }

 private:
  /// The attempts at a point so far.
  struct Attempts {
    int starts = 0;
    int failures = 0;                   // number of failures so far, without lost workers
    bool copied = false;                // true if a copy was started because the point straggled
    std::optional<Trial> failure = {};  // last failure that describes the point
  };
  struct Running {
    DesignPoint point;
    Attempts attempts = {};
    int copies = 0;      // number of running copies; 0: the trial waits to be repeated
    double since = 0.0;  // start of the first running copy, s
  };

  bool stop_requested() const;
  bool is_under_way(const DesignPoint& point) const;
  void take_finished();
  void start_idle_workers(std::span<const DesignPoint> wanted);
  void start(Running& running);
  void stop_unwanted_stragglers(std::span<const DesignPoint> wanted);
  void start_stragglers_again();
  std::optional<double> straggling_since() const;
  double median_time() const;
  void count_stragglers();
  void receive(std::vector<Trial> trials);
  int most_starts() const;
  bool is_repeated(Running& running, const Trial& trial);
  Trial final_of(const Running& running, Trial trial) const;
  void count_trial(const Trial& trial);
  void take_committed();
  void give_running_a_moment();

  Executor& executor_;
  TrialStore* store_;
  const RunOptions& options_;
  GroupCommit commits_;
  KnownScores known_;
  std::map<std::string, Running> running_;  // keyed by the bits of the point
  /// Attempts at points that were withdrawn while they ran.
  std::map<std::string, Attempts> stopped_;
  /// Points that have finished but are not yet on the disk.
  std::set<std::string> committing_;
  std::set<std::string> asked_;       // points whose outcome was passed to the optimizer
  std::vector<double> recent_times_;  // durations of the last trials that succeeded, s
  bool stopping_ = false;
  RunProgress progress_;
  std::optional<Score> best_;
  double wall_time_ = 0.0;
  double start_;
};

}  // namespace latsch
