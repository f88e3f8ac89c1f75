// SPDX-License-Identifier: Apache-2.0
#include "evaluation/schedule/dispatcher.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace latsch {
namespace {

// Time between two checks of the stop request and the progress bar, s.
constexpr double kPatience = 0.1;
// Time, s, below which a trial never counts as a straggler: the operating system sometimes delays
// short trials.
constexpr double kLeastStraggling = 0.05;
// Smallest number of durations from which a median is computed.
constexpr std::size_t kTimesForMedian = 5;
// Number of latest trials in the median. It is limited because a model may become slower during a
// run.
constexpr std::size_t kRecentTimes = 101;

/// Returns the target function of an outcome; a target that is not a number counts as none.
Result<Score> score(const Objective& objective, const DesignPoint& point, const Outcome& outcome) {
  if (!outcome.result) return outcome.result.failure();
  if (!objective) return Score{};
  Result<Score> result = objective(point, *outcome.result);
  if (result && !std::isfinite(result->value)) {
    return Failure{"the target function is not finite", Cause::bad_output};
  }
  return result;
}

}  // namespace

void KnownScores::add(const Trial& trial) {
  scores_.insert_or_assign(trial.point.bits(), score(objective_, trial.point, trial.outcome));
}

void KnownScores::add_kept(const Trial& trial) {
  auto known = score(objective_, trial.point, trial.outcome);
  if (known && objective_.needs_slopes() && known->jacobian.empty()) return;
  scores_.insert_or_assign(trial.point.bits(), std::move(known));
}

const Result<Score>* KnownScores::find(const DesignPoint& point) const {
  const auto found = scores_.find(point.bits());
  return found == scores_.end() ? nullptr : &found->second;
}

Dispatcher::Dispatcher(const Objective& objective,
                       Executor& executor,
                       TrialStore* store,
                       const RunOptions& options,
                       long planned)
    : executor_(executor),
      store_(store),
      options_(options),
      commits_(store, options.commit_in_background),
      known_(objective),
      start_(executor.now()) {
  if (store) {
    store->for_each([&](const Trial& trial) { known_.add_kept(trial); });
    store->begin_asking();
  }
  progress_.planned = planned;
}

const Result<Score>* Dispatcher::first_of(std::span<const DesignPoint> wanted) {
  take_finished();
  while (true) {
    take_committed();
    if (stop_requested()) {
      give_running_a_moment();
      return nullptr;
    }
    if (const Result<Score>* outcome = known_.find(wanted.front())) {
      asked_.insert(wanted.front().bits());
      return outcome;
    }
    start_idle_workers(wanted);
    if (committing_.contains(wanted.front().bits())) {
      commits_.wait();
    } else {
      receive(executor_.wait(kPatience));
    }
    report();
  }
}

bool Dispatcher::all_of(
    std::span<const DesignPoint> wanted,
    const std::function<bool(const DesignPoint&, const Result<Score>&)>& known) {
  while (true) {
    take_committed();
    while (!wanted.empty()) {
      const Result<Score>* outcome = known_.find(wanted.front());
      if (!outcome) break;
      asked_.insert(wanted.front().bits());
      if (!known(wanted.front(), *outcome)) return false;
      wanted = wanted.subspan(1);
    }
    if (wanted.empty()) return true;
    if (stop_requested()) {
      give_running_a_moment();
      return false;
    }
    start_idle_workers(wanted);
    if (running_.empty()) {
      commits_.wait();
    } else {
      receive(executor_.wait(kPatience));
    }
    report();
  }
}

void Dispatcher::finish() {
  executor_.abandon();
  running_.clear();
  while (!committing_.empty()) {
    commits_.wait();
    take_committed();
  }
  if (store_) store_->keep_asked(asked_);
}

void Dispatcher::count(const DesignPoint& point, const Result<Score>& outcome, bool is_score) {
  ++progress_.known;
  if (!is_score || !outcome) return;
  if (best_ && !is_better(*outcome, *best_)) return;
  best_ = *outcome;
  progress_.best = outcome->value;
  progress_.best_point = point;
}

void Dispatcher::report() {
  if (!options_.on_progress) return;
  progress_.running = static_cast<int>(running_.size());
  progress_.elapsed = executor_.now() - start_;
  count_stragglers();
  options_.on_progress(progress_);
}

void Dispatcher::count_stragglers() {
  progress_.straggling = 0;
  progress_.slowest = 0.0;
  const auto limit = straggling_since();
  for (const auto& [bits, running] : running_) {
    if (running.copies == 0) continue;
    progress_.slowest = std::max(progress_.slowest, executor_.now() - running.since);
    progress_.straggling += limit && running.since <= *limit;
  }
}

bool Dispatcher::stop_requested() const {
  return options_.stop_requested && options_.stop_requested();
}

bool Dispatcher::is_under_way(const DesignPoint& point) const {
  const std::string bits = point.bits();
  return running_.contains(bits) || committing_.contains(bits) || known_.find(point);
}

void Dispatcher::start_idle_workers(std::span<const DesignPoint> wanted) {
  stop_unwanted_stragglers(wanted);
  for (auto& [bits, running] : running_) {
    if (executor_.idle() == 0) return;
    if (running.copies > 0) continue;
    ++progress_.repeated;
    start(running);
  }
  for (const DesignPoint& point : wanted) {
    if (executor_.idle() == 0) return;
    if (is_under_way(point)) continue;
    Running& running = running_.emplace(point.bits(), Running{point}).first->second;
    if (const auto before = stopped_.extract(point.bits())) running.attempts = before.mapped();
    start(running);
  }
  start_stragglers_again();
}

void Dispatcher::start(Running& running) {
  assert(running.attempts.starts < most_starts());
  ++running.attempts.starts;
  if (running.copies++ == 0) running.since = executor_.now();
  executor_.start(running.point);
}

void Dispatcher::stop_unwanted_stragglers(std::span<const DesignPoint> wanted) {
  if (running_.empty() || !options_.stop_unwanted || !executor_.can_stop()) return;
  const auto limit = straggling_since();
  if (!limit) return;
  const auto straggles = [&](const auto& entry) {
    // A trial whose point has used up its starts is not stopped, because the point may be wanted
    // again and could not be restarted.
    return entry.second.copies > 0 && entry.second.since <= *limit &&
           entry.second.attempts.starts < most_starts();
  };
  if (std::none_of(running_.begin(), running_.end(), straggles)) return;
  std::set<std::string> named;
  long waiting = 0;
  for (const DesignPoint& point : wanted) {
    named.insert(point.bits());
    waiting += !is_under_way(point);
  }
  for (auto entry = running_.begin(); entry != running_.end() && waiting > executor_.idle();) {
    if (!straggles(*entry) || named.contains(entry->first)) {
      ++entry;
      continue;
    }
    executor_.withdraw(entry->second.point);
    stopped_.emplace(entry->first, std::move(entry->second.attempts));
    ++progress_.stopped;
    entry = running_.erase(entry);
  }
}

void Dispatcher::start_stragglers_again() {
  if (executor_.idle() == 0) return;
  const auto limit = straggling_since();
  if (!limit) return;
  for (auto& [bits, running] : running_) {
    if (executor_.idle() == 0) return;
    Attempts& attempts = running.attempts;
    if (running.copies != 1 || running.since > *limit || attempts.copied) continue;
    if (attempts.failures > 0 || attempts.starts >= most_starts()) continue;
    attempts.copied = true;
    ++progress_.copied;
    start(running);
  }
}

/// Returns a time: a running trial that started before it is a straggler. Returns nullopt if there
/// are too few durations to decide, or if no trial may count as a straggler.
std::optional<double> Dispatcher::straggling_since() const {
  if (options_.straggler_factor <= 0.0 || recent_times_.size() < kTimesForMedian) {
    return std::nullopt;
  }
  return executor_.now() - std::max(kLeastStraggling, options_.straggler_factor * median_time());
}

double Dispatcher::median_time() const {
  std::vector<double> times = recent_times_;
  const auto middle = times.begin() + std::ssize(times) / 2;
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

void Dispatcher::receive(std::vector<Trial> trials) {
  std::vector<Trial> finished;
  for (Trial& trial : trials) {
    const std::string bits = trial.point.bits();
    const auto entry = running_.find(bits);
    // If a point is not running, the outcome is its second one, or the point is no longer wanted.
    if (entry == running_.end()) continue;
    Running& running = entry->second;
    // The failure was reported twice, or belongs to a withdrawn attempt. The point already waits
    // for another worker.
    if (running.copies == 0 && !trial.outcome.result) continue;
    running.copies = std::max(running.copies - 1, 0);
    if (is_repeated(running, trial)) {
      // The trial will be repeated when the run is resumed.
      if (stopping_ && running.copies == 0) running_.erase(entry);
      continue;
    }
    if (running.copies > 0) executor_.withdraw(trial.point);
    finished.push_back(final_of(running, std::move(trial)));
    count_trial(finished.back());
    running_.erase(entry);
    committing_.insert(bits);
  }
  commits_.add(std::move(finished));
}

int Dispatcher::most_starts() const { return options_.on_failure.retries + 2; }

/// True if this failure does not count, because another copy of the trial still runs or the trial
/// is started again.
bool Dispatcher::is_repeated(Running& running, const Trial& trial) {
  if (trial.outcome.result) return false;
  Attempts& attempts = running.attempts;
  const Cause cause = trial.outcome.result.failure().cause;
  if (cause == Cause::not_begun) {
    --attempts.starts;
    return true;
  }
  if (cause != Cause::transient) {
    ++attempts.failures;
    attempts.failure = trial;
  }
  // A lost worker or a timeout may be due to one slow worker, so the other copy may succeed. Any
  // other failure is a property of the point.
  const bool is_told = cause != Cause::transient && cause != Cause::timeout;
  if (running.copies > 0) return !is_told || attempts.failures <= options_.on_failure.retries;
  return attempts.failures <= options_.on_failure.retries && attempts.starts < most_starts();
}

/// Returns the outcome of a point as it is stored. If attempts failed in different ways, this is
/// the last failure that says something about the point.
Trial Dispatcher::final_of(const Running& running, Trial trial) const {
  const Attempts& attempts = running.attempts;
  if (trial.outcome.result || attempts.starts == 1) return trial;
  if (attempts.failure) trial = *attempts.failure;
  Failure failure = trial.outcome.result.failure();
  failure.reason += fmt::format(" (attempt {0} of {0})", attempts.starts);
  trial.outcome.result = std::move(failure);
  return trial;
}

void Dispatcher::count_trial(const Trial& trial) {
  ++progress_.evaluated;
  wall_time_ += trial.outcome.wall_time;
  progress_.trial_wall_time = wall_time_ / static_cast<double>(progress_.evaluated);
  if (!trial.outcome.result) {
    ++progress_.failed;
    return;
  }
  const std::size_t place = static_cast<std::size_t>(progress_.evaluated) % kRecentTimes;
  if (recent_times_.size() < kRecentTimes) {
    recent_times_.push_back(trial.outcome.wall_time);
  } else {
    recent_times_[place] = trial.outcome.wall_time;
  }
}

/// Takes trials that ended while the optimizer was computing. They waited to be noticed and are no
/// stragglers.
void Dispatcher::take_finished() {
  while (!running_.empty()) {
    std::vector<Trial> finished = executor_.wait(0.0);
    if (finished.empty()) return;
    receive(std::move(finished));
  }
}

void Dispatcher::take_committed() {
  for (const Trial& trial : commits_.take()) {
    known_.add(trial);
    const auto* outcome = known_.find(trial.point);
    // Counts a trial that succeeded but from which the target function cannot be computed.
    if (trial.outcome.result && outcome && !*outcome) ++progress_.failed;
    committing_.erase(trial.point.bits());
  }
}

/// Waits a moment for running trials to end. Trials that have not ended then are evaluated again
/// when the run is resumed.
void Dispatcher::give_running_a_moment() {
  stopping_ = true;
  std::erase_if(running_, [](const auto& entry) { return entry.second.copies == 0; });
  const double until = executor_.now() + options_.stop_patience;
  while (!running_.empty() && executor_.now() < until) receive(executor_.wait(kPatience));
  finish();
}

}  // namespace latsch
