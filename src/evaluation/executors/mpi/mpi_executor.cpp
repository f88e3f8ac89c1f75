// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/mpi/mpi_executor.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include "base/error.h"
#include "evaluation/executors/frame.h"
#include "evaluation/trial/encoding.h"

namespace latsch {
namespace {

enum Tag { kPoint = 1, kOutcome, kAlive, kWithdraw, kEnd, kEnded, kLeave, kBegun };
// Text of the message kLeave if some rank is lost: the receiver must not wait for the other ranks.
constexpr const char* kAlone = "alone";
constexpr auto kPause = std::chrono::microseconds(500);  // pause between two checks for a message
// Time that a rank waits for its own worker, s.
constexpr double kLocalPatience = 0.01;

std::chrono::duration<double> in_seconds(double s) { return std::chrono::duration<double>(s); }

}  // namespace

MpiJob::MpiJob(std::unique_ptr<MessagePassing> ranks, const MpiPatience& patience)
    : patience_(patience), ranks_(std::move(ranks)) {
  if (rank() == 0 && size() > 1) heart_ = std::thread([this] { beat(); });
}

namespace {

/// Limits the time for which this process waits for other ranks, since one may have just been lost.
class LongestWait {
 public:
  explicit LongestWait(double patience) : before_(::alarm(0)) {
    const auto ours = static_cast<unsigned>(std::ceil(patience));
    ::alarm(before_ > 0 ? std::min(before_, ours) : ours);
  }
  ~LongestWait() { ::alarm(before_); }
  LongestWait(const LongestWait&) = delete;
  LongestWait& operator=(const LongestWait&) = delete;

 private:
  unsigned before_;  // remaining time of an alarm set earlier, s
};

}  // namespace

MpiJob::~MpiJob() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  end_.notify_one();
  if (heart_.joinable()) heart_.join();
  // The end of MPI waits for every rank, including lost ones.
  if (ends_alone_) return;
  const LongestWait wait(patience_.master_silence);
  ranks_->finish();
}

bool MpiJob::agrees(std::uint64_t value) {
  const std::lock_guard lock(mutex_);
  const LongestWait wait(patience_.master_silence);
  const std::array<std::uint64_t, 2> least = ranks_->least_of_all({value, ~value});
  return least[0] == ~least[1];  // all values are equal if the least equals the greatest
}

void MpiJob::beat() {
  std::unique_lock lock(mutex_);
  while (!end_.wait_for(lock, in_seconds(patience_.heartbeat), [&] { return ending_; })) {
    for (int rank = 1; rank < size(); ++rank) say(rank, kAlive, {});
  }
}

void MpiJob::send(int rank, int tag, std::string bytes) {
  const std::lock_guard lock(mutex_);
  say(rank, tag, std::move(bytes));
}

void MpiJob::lose(int rank) {
  const std::lock_guard lock(mutex_);
  lost_.insert(rank);
}

void MpiJob::say(int rank, int tag, std::string bytes) {
  if (!lost_.contains(rank)) ranks_->send(rank, tag, std::move(bytes));
}

std::optional<MpiMessage> MpiJob::poll() {
  const std::lock_guard lock(mutex_);
  return ranks_->poll();
}

namespace {

/// Reports to rank 0 that this rank has ended its work, and waits until rank 0 reports whether all
/// other ranks have.
void leave(MpiJob& job) {
  job.send(0, kEnded, {});
  const auto until = std::chrono::steady_clock::now() + in_seconds(job.patience().master_silence);
  while (std::chrono::steady_clock::now() < until) {
    while (const auto message = job.poll()) {
      if (message->tag != kLeave) continue;
      if (message->bytes == kAlone) job.ends_alone();
      return;
    }
    std::this_thread::sleep_for(kPause);
  }
  job.ends_alone();
}

void serve(MpiJob& job, ProcessOptions options) {
  options.workers = 1;
  ProcessExecutor worker(std::move(options));
  std::uint64_t trial = 0;
  bool begun = false;  // true once rank 0 knows that the trial began
  double said = worker.now(), heard = worker.now();
  while (true) {
    if (worker.now() - heard > job.patience().master_silence) return job.ends_alone();
    while (const auto message = job.poll()) {
      heard = worker.now();
      if (message->tag == kEnd) {
        worker.abandon();
        return leave(job);
      }
      if (message->tag == kWithdraw) worker.abandon();
      const auto asked = message->tag == kPoint ? take_number(message->bytes) : std::nullopt;
      const auto point = asked ? decode_point(asked->rest) : std::nullopt;
      if (!point) continue;
      trial = asked->number;
      begun = false;
      worker.start(*point);
    }
    if (worker.idle() > 0) std::this_thread::sleep_for(kPause);
    if (!begun && worker.begun() > 0) {
      begun = true;
      job.send(0, kBegun, numbered(trial, {}));
    }
    for (const Trial& done : worker.wait(worker.idle() > 0 ? 0.0 : kLocalPatience)) {
      job.send(0, kOutcome, numbered(trial, encode(done.outcome)));
    }
    if (worker.now() - said < job.patience().heartbeat) continue;
    said = worker.now();
    job.send(0, kAlive, {});
  }
}

}  // namespace

void serve_rank(MpiJob& job, ProcessOptions options) {
  try {
    serve(job, std::move(options));
  } catch (...) {
    job.ends_alone();  // the other ranks continue, and the end of MPI would wait for them
    throw;
  }
}

MpiExecutor::MpiExecutor(MpiJob& job) : job_(job), ranks_(job.size() - 1) {
  assert(job.rank() == 0 && job.size() > 1);
  listened_ = now();
  for (Rank& rank : ranks_) rank.heard = listened_;
}

// If a rank was lost unnoticed, all other ranks would wait for it at the end of MPI. Therefore
// every rank first reports that it has ended its work.
MpiExecutor::~MpiExecutor() {
  tell_all(kEnd, {});
  for (Rank& rank : ranks_) rank.heard = now();  // rank 0 may not have listened for a long time
  const auto awaited = [](const Rank& rank) { return !rank.lost && !rank.ended; };
  while (std::any_of(ranks_.begin(), ranks_.end(), awaited)) {
    while (const auto message = job_.poll()) {
      Rank& rank = ranks_[message->rank - 1];
      rank.heard = now();
      rank.ended = rank.ended || message->tag == kEnded;
    }
    for (std::size_t i = 0; i < ranks_.size(); ++i) {
      if (awaited(ranks_[i]) && now() - ranks_[i].heard > job_.patience().silence) lose(i);
    }
    std::this_thread::sleep_for(kPause);
  }
  tell_all(kLeave, job_.is_alone() ? kAlone : "");
}

void MpiExecutor::tell_all(int tag, const std::string& bytes) {
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    if (!ranks_[i].lost) job_.send(static_cast<int>(i + 1), tag, bytes);
  }
}

int MpiExecutor::idle() const {
  return static_cast<int>(std::count_if(
      ranks_.begin(), ranks_.end(), [](const Rank& rank) { return !rank.point && !rank.lost; }));
}

void MpiExecutor::start(const DesignPoint& point) {
  const auto rank =
      std::find_if(ranks_.begin(), ranks_.end(), [](const Rank& r) { return !r.point && !r.lost; });
  assert(rank != ranks_.end());
  rank->point = point;
  rank->trial = ++trials_;
  rank->begun = false;
  job_.send(
      static_cast<int>(rank - ranks_.begin()) + 1, kPoint, numbered(rank->trial, encode(point)));
}

std::vector<Trial> MpiExecutor::wait(double patience) {
  const double until = now() + patience;
  const double away = now() - listened_;
  for (Rank& rank : ranks_) rank.heard += away;
  std::vector<Trial> finished;
  while (true) {
    while (auto trial = receive()) finished.push_back(std::move(*trial));
    if (auto trial = lose_silent()) finished.push_back(std::move(*trial));
    if (!finished.empty() || now() >= until) break;
    std::this_thread::sleep_for(kPause);
  }
  listened_ = now();
  return finished;
}

void MpiExecutor::lose(std::size_t worker) {
  ranks_[worker].lost = true;
  job_.lose(static_cast<int>(worker) + 1);
  job_.ends_alone();
}

/// Returns the next outcome that has arrived; nullopt if there is none.
std::optional<Trial> MpiExecutor::receive() {
  while (const auto message = job_.poll()) {
    Rank& rank = ranks_[message->rank - 1];
    rank.heard = now();
    if ((message->tag != kOutcome && message->tag != kBegun) || rank.lost) continue;
    const auto answer = take_number(message->bytes);
    // An answer for another trial than the present one belongs to a trial that was withdrawn.
    if (!answer || !rank.point || answer->number != rank.trial) continue;
    rank.begun = true;
    if (message->tag == kBegun) continue;
    auto outcome = decode_outcome(answer->rest);
    if (!outcome) outcome = Outcome{.result = Failure{"answer not readable", Cause::bad_output}};
    outcome->worker = message->rank;
    return Trial{*std::exchange(rank.point, std::nullopt), std::move(*outcome)};
  }
  return std::nullopt;
}

/// Marks a rank that has been silent for too long as lost and returns its trial as failed; nullopt
/// if there is no such rank.
std::optional<Trial> MpiExecutor::lose_silent() {
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    Rank& rank = ranks_[i];
    if (rank.lost || now() - rank.heard < job_.patience().silence) continue;
    lose(i);
    const bool any =
        std::any_of(ranks_.begin(), ranks_.end(), [](const Rank& r) { return !r.lost; });
    if (!any) throw InputError("every rank of the MPI job is lost; resume with the same command");
    if (!rank.point) continue;
    const Cause cause = rank.begun ? Cause::transient : Cause::not_begun;
    return Trial{*std::exchange(rank.point, std::nullopt),
                 {.result = Failure{"its MPI rank is out of reach", cause}}};
  }
  return std::nullopt;
}

void MpiExecutor::forget(std::size_t worker) {
  job_.send(static_cast<int>(worker) + 1, kWithdraw, {});
  ranks_[worker].point.reset();
}

void MpiExecutor::withdraw(const DesignPoint& point) {
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    if (ranks_[i].point == point) forget(i);
  }
}

void MpiExecutor::abandon() {
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    if (ranks_[i].point) forget(i);
  }
}

}  // namespace latsch
