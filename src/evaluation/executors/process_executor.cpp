// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/process_executor.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <optional>
#include <utility>

#include "base/error.h"
#include "evaluation/executors/worker_process.h"
#include "evaluation/trial/encoding.h"

namespace latsch {
namespace {

using Steady = std::chrono::steady_clock;

// Number of processes in a row that end before they are ready, after which the program is taken to
// be no worker.
constexpr int kMostFailedStarts = 3;
// Number of processes in a row that are killed from outside while they start, after which the
// reason, such as a lack of memory, is taken to be permanent.
constexpr int kMostKilledStarts = 20;
// Longest time that a worker may need to start on a busy machine, as a multiple of
// ProcessOptions::start_timeout. A larger value lets a run wait longer for a disk that never
// answers.
constexpr double kLongestStart = 20.0;
// Lower bound of this longest time, s, for short values of start_timeout.
constexpr double kLeastLongestStart = 90.0;

Steady::duration seconds(double s) {
  return std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(s));
}

/// The slot of a worker. Its process may be replaced by another one.
struct Slot {
  std::unique_ptr<WorkerProcess> process;
  bool ready = false;  // true once the process has reported that it listens
  std::optional<DesignPoint> point;
  std::uint64_t trial = 0;   // number of the slot's trial, which messages contain
  Steady::time_point since;  // start of the process until it is ready, then start of the trial
  Steady::time_point seen;   // time at which the start of the process was last found to proceed
  // Processor time that the process had used at `seen`, s.
  double used = 0.0;
};

}  // namespace

struct ProcessExecutor::Impl {
  ProcessOptions options;
  std::vector<Slot> slots;
  int failed_starts = 0;     // consecutive processes, over all workers, that failed to start
  int killed_starts = 0;     // consecutive processes killed from outside while they started
  std::uint64_t trials = 0;  // number of trials started so far

  void start_process(Slot& slot) {
    slot.process = std::make_unique<WorkerProcess>(options.arguments, options.memory_limit);
    slot.ready = false;
    slot.since = slot.seen = Steady::now();
    slot.used = 0.0;
  }

  void send_point(Slot& slot) {
    if (!slot.process || slot.process->ended()) start_process(slot);
    slot.process->send(encode_frame(FrameKind::point, numbered(slot.trial, encode(*slot.point))));
    if (slot.ready) slot.since = Steady::now();
  }

  Trial finish(Slot& slot, Outcome outcome) {
    outcome.worker = static_cast<int>(&slot - slots.data());
    return {*std::exchange(slot.point, std::nullopt), std::move(outcome)};
  }

  /// Returns the trial of a lost worker as a failed trial.
  Trial finish_lost(Slot& slot, Failure failure) {
    const double wall_time = std::chrono::duration<double>(Steady::now() - slot.since).count();
    slot.process.reset();
    return finish(slot, {.result = std::move(failure), .wall_time = wall_time});
  }

  void forget(Slot& slot) {
    slot.process.reset();
    slot.point.reset();
  }

  /// Returns the ended trial of a worker; nullopt while it continues.
  std::optional<Trial> listen(Slot& slot) {
    // Must be read first, so that everything written before the end is received.
    const bool ended = slot.process->ended();
    slot.process->receive();
    while (const auto frame = slot.process->frames().next()) {
      if (frame->kind == FrameKind::ready) {
        slot.ready = true;
        slot.since = Steady::now();
        failed_starts = killed_starts = 0;
        continue;
      }
      const auto answer = take_number(frame->bytes);
      auto outcome = answer ? decode_outcome(answer->rest) : std::nullopt;
      if (frame->kind != FrameKind::outcome || !outcome) return nonsense(slot);
      if (!slot.point || answer->number != slot.trial) return nonsense(slot);
      if (outcome->result) outcome->result = finite(std::move(*outcome->result));
      return finish(slot, std::move(*outcome));
    }
    if (slot.process->frames().broken()) return nonsense(slot);
    return ended ? after_end(slot) : check_time(slot);
  }

  std::optional<Trial> nonsense(Slot& slot) {
    slot.process->end();
    slot.process.reset();
    if (!slot.point) return std::nullopt;
    return finish_lost(slot,
                       {"the worker's answer is not readable; it was killed", Cause::bad_output});
  }

  std::optional<Trial> after_end(Slot& slot) {
    const std::string how = slot.process->end();
    const bool stopped = slot.process->was_stopped_from_outside();
    if (!slot.ready) {
      restart_or_give_up(slot, how, stopped);
      return std::nullopt;
    }
    const Cause cause = stopped ? Cause::transient : Cause::point;
    slot.process.reset();
    if (!slot.point) return std::nullopt;
    return finish_lost(slot, {"the worker " + how, cause});
  }

  /// Starts another process in the slot, or throws InputError after too many failed starts.
  /// `killed` is true if the process was killed from outside.
  void restart_or_give_up(Slot& slot, const std::string& how, bool killed) {
    slot.process.reset();
    const int times = killed ? ++killed_starts : ++failed_starts;
    if (times >= (killed ? kMostKilledStarts : kMostFailedStarts)) {
      throw InputError(
          fmt::format("the worker program \"{}\" {} before it was ready, {} times in a "
                      "row{}",
                      options.arguments.front(),
                      how,
                      times,
                      killed ? "; is there too little memory for it?" : ""));
    }
    if (slot.point) send_point(slot);
  }

  std::optional<Trial> check_time(Slot& slot) {
    if (Steady::now() < deadline(slot)) return std::nullopt;
    if (!slot.ready) {
      check_start(slot);
      return std::nullopt;
    }
    slot.process->end();
    return finish_lost(
        slot,
        {fmt::format("took more than the {} s allowed and was killed", options.timeout),
         Cause::timeout});
  }

  /// Ends a worker whose start does not proceed. On a busy machine a start takes long without a
  /// fault of the worker.
  void check_start(Slot& slot) {
    const double limit = options.start_timeout;
    const double longest = std::max(kLongestStart * limit, kLeastLongestStart);
    const ProcessUse use = slot.process->use();
    const auto now = Steady::now();
    std::string fault;
    if (use.processor_time > limit)
      fault = fmt::format("used more than {} s of processor time", limit);
    else if (now - slot.since > seconds(longest))
      fault = fmt::format("took more than {} s", longest);
    else if (!use.is_held_up && use.processor_time <= slot.used)
      fault = fmt::format(
          "neither computed nor waited for a processor or a disk for more than {} s", limit);
    slot.seen = now;
    slot.used = use.processor_time;
    if (fault.empty()) return;
    slot.process->end();
    restart_or_give_up(slot, fault, false);
  }

  Steady::time_point deadline(const Slot& slot) const {
    if (!slot.ready) return slot.seen + seconds(options.start_timeout);
    return slot.point ? slot.since + seconds(options.timeout) : Steady::time_point::max();
  }

  /// Sleeps until a worker sends something, a deadline passes or the time `until` is reached.
  /// Returns false after a signal.
  bool sleep(Steady::time_point until) const {
    std::vector<pollfd> entries;
    for (const Slot& slot : slots) {
      if (!slot.process) continue;
      for (const int fd : slot.process->descriptors()) entries.push_back({fd, POLLIN, 0});
      until = std::min(until, deadline(slot));
    }
    const auto rest = std::chrono::ceil<std::chrono::milliseconds>(until - Steady::now());
    const int milliseconds = static_cast<int>(std::max<long>(rest.count(), 0));
    return ::poll(entries.data(), entries.size(), milliseconds) >= 0;
  }
};

ProcessExecutor::ProcessExecutor(ProcessOptions options) : impl_(std::make_unique<Impl>()) {
  if (options.arguments.empty() || options.workers < 1) {
    throw InputError("worker processes need a program and a number of at least 1");
  }
  if (!(options.timeout > 0.0) || !(options.start_timeout > 0.0)) {
    throw InputError(fmt::format("timeout of a trial is {} s, expected a positive time",
                                 std::min(options.timeout, options.start_timeout)));
  }
  // Limit of the timeout: a year, so that adding it to a point in time cannot overflow.
  constexpr double kLongest = 365.0 * 86400.0;
  options.timeout = std::min(options.timeout, kLongest);
  options.start_timeout = std::min(options.start_timeout, kLongest);
  impl_->slots.resize(options.workers);
  impl_->options = std::move(options);
}

ProcessExecutor::~ProcessExecutor() = default;

int ProcessExecutor::workers() const { return static_cast<int>(impl_->slots.size()); }

int ProcessExecutor::idle() const {
  return static_cast<int>(std::count_if(
      impl_->slots.begin(), impl_->slots.end(), [](const Slot& slot) { return !slot.point; }));
}

int ProcessExecutor::begun() const {
  return static_cast<int>(
      std::count_if(impl_->slots.begin(), impl_->slots.end(), [](const Slot& slot) {
        return slot.point && slot.process && slot.ready;
      }));
}

void ProcessExecutor::start(const DesignPoint& point) {
  const auto slot = std::find_if(
      impl_->slots.begin(), impl_->slots.end(), [](const Slot& s) { return !s.point; });
  assert(slot != impl_->slots.end());
  slot->point = point;
  slot->trial = ++impl_->trials;
  impl_->send_point(*slot);
}

std::vector<Trial> ProcessExecutor::wait(double patience) {
  const Steady::time_point until = Steady::now() + seconds(patience);
  std::vector<Trial> finished;
  while (true) {
    for (Slot& slot : impl_->slots) {
      if (!slot.process) continue;
      if (auto trial = impl_->listen(slot)) finished.push_back(std::move(*trial));
    }
    if (!finished.empty() || Steady::now() >= until) return finished;
    if (!impl_->sleep(until)) return finished;  // a signal arrived, and the caller may want to stop
  }
}

void ProcessExecutor::withdraw(const DesignPoint& point) {
  for (Slot& slot : impl_->slots) {
    if (slot.point == point) impl_->forget(slot);
  }
}

void ProcessExecutor::abandon() {
  for (Slot& slot : impl_->slots) {
    if (slot.point) impl_->forget(slot);
  }
}

}  // namespace latsch
