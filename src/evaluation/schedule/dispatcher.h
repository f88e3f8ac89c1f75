// SPDX-License-Identifier: Apache-2.0
// Hands points to workers and takes their outcomes to the journal, whatever happens to the workers.
//
// - A point that was evaluated, is being evaluated or is on its way to the disk is not started
// again.
// - A point is started at most `retries` + 2 times, whatever becomes of its copies: once, once more
//   for what is not its own fault, and so often as the failure policy asks for. A start whose
//   worker was lost before it began (Cause::not_begun) is none.
// - A trial whose worker was lost (Cause::transient) says nothing about its point and is repeated
//   as far as its starts last: where a point needs too much memory, the system kills every worker
//   that tries it. Other failures are repeated as the failure policy says.
// - A straggler, running much longer than the median while a worker has nothing to do, is started a
//   second time, once. Evaluators are pure, so whichever copy ends first with channels gives the
//   same bits. A copy that is lost or expires counts, and the other one goes on; there is no new
//   one behind a point that has expired or failed: it does so again.
// - An outcome counts once it is on the disk.
//
// - What was wanted and is not any more is withdrawn by not being named again, if it has not
//   started. Where it runs it may come true yet, and its worker is warm; only a straggler is
//   stopped for a wanted point that waits. To stop every unnamed trial was tried: it saves 2 to 3 %
//   of the time with 2 to 4 workers, less than new worker processes cost, and nothing with 16.
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

/// Every outcome so far by the bits of its point, as scores: channels are large and stay on disk.
class KnownScores {
 public:
  explicit KnownScores(const Objective& objective) : objective_(objective) {}

  void add(const Trial& trial);
  /// One that was kept earlier, for whatever purpose: without slopes where they are needed it is
  /// evaluated again.
  void add_kept(const Trial& trial);
  const Result<Score>* find(const DesignPoint& point) const;

 private:
  const Objective& objective_;
  std::unordered_map<std::string, Result<Score>> scores_;
};

class Dispatcher {
 public:
  /// `planned`: how many points can become wanted, for the progress bar.
  Dispatcher(const Objective& objective,
             Executor& executor,
             TrialStore* store,
             const RunOptions& options,
             long planned);

  /// The outcome of the first of these points, keeping idle workers busy with those behind it, most
  /// wanted first; nullptr where a stop was requested before it was known.
  const Result<Score>* first_of(std::span<const DesignPoint> wanted);

  /// Evaluates all of these points. Calls `known` with each and its outcome in their order; false
  /// from it, or a stop request, ends the work early: then false.
  bool all_of(std::span<const DesignPoint> wanted,
              const std::function<bool(const DesignPoint&, const Result<Score>&)>& known);

  /// Withdraws what still runs; returns when everything that finished is on the disk, and what was
  /// asked for (asked_trials.h).
  void finish();

  /// Tells the progress bar what the optimizer, or the plan, has seen so far.
  void count(const DesignPoint& point, const Result<Score>& outcome, bool is_score);
  void report();

  bool knows(const DesignPoint& point) const { return known_.find(point) != nullptr; }
  /// s, the mean over the trials so far; 0 where there is none.
  double trial_time() const { return progress_.trial_wall_time; }

 private:
  /// What has become of the attempts at a point.
  struct Attempts {
    int starts = 0;
    int failures = 0;                   // that did not count
    bool copied = false;                // as a straggler
    std::optional<Trial> failure = {};  // the last that says something about the point
  };
  struct Running {
    DesignPoint point;
    Attempts attempts = {};
    int copies = 0;      // 0: waits for a worker, to be repeated
    double since = 0.0;  // of the first copy
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
  std::map<std::string, Running> running_;   // by the bits of the point
  std::map<std::string, Attempts> stopped_;  // of points that were withdrawn while they ran
  std::set<std::string> committing_;         // finished, not yet on the disk
  std::set<std::string> asked_;              // whose outcome was given
  std::vector<double> recent_times_;         // s, of the trials that succeeded last
  bool stopping_ = false;
  RunProgress progress_;
  std::optional<Score> best_;
  double wall_time_ = 0.0;
  double start_;
};

}  // namespace latsch
