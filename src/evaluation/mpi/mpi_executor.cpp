// SPDX-License-Identifier: Apache-2.0
#include "evaluation/mpi/mpi_executor.h"

#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdlib>
#include <list>
#include <string>
#include <thread>
#include <utility>

#include "base/error.h"
#include "evaluation/encoding.h"
#include "evaluation/frame.h"

namespace latsch {
namespace {

enum Tag { kPoint = 1, kOutcome = 2, kAlive = 3, kWithdraw = 4, kEnd = 5, kEnded = 6, kLeave = 7 };
constexpr const char* kAlone = "alone";  // with kLeave: another rank is lost, wait for none
constexpr double kHeartbeat = 1.0;       // s
constexpr auto kPause = std::chrono::microseconds(500);  // between two looks for a message
constexpr double kLocalPatience = 0.01;                  // s, of a rank for its own worker

struct Message {
  int rank;
  int tag;
  std::string bytes;
};

/// A message that has arrived; nullopt where there is none.
std::optional<Message> poll_message() {
  int there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (!there) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{status.MPI_SOURCE, status.MPI_TAG, std::string(size, '\0')};
  MPI_Recv(message.bytes.data(),
           size,
           MPI_BYTE,
           message.rank,
           message.tag,
           MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return message;
}

}  // namespace

bool MpiJob::is_rank_of_many() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  return size && std::atoi(size) > 1;
}

struct MpiJob::Outbox {
  struct Letter {
    std::string bytes;
    MPI_Request request;
  };
  std::list<Letter> letters;  // whose bytes MPI may still need
};

MpiJob::MpiJob() : outbox_(std::make_unique<Outbox>()) {
  MPI_Init(nullptr, nullptr);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

MpiJob::~MpiJob() {
  // MPI_Finalize waits for every rank, also for one that is lost.
  if (ends_alone_) return;
  ::alarm(static_cast<unsigned>(kMasterSilence));  // one may be lost at this very moment
  for (Outbox::Letter& letter : outbox_->letters) MPI_Wait(&letter.request, MPI_STATUS_IGNORE);
  MPI_Finalize();
  ::alarm(0);
}

void MpiJob::send(int rank, int tag, std::string bytes) {
  std::erase_if(outbox_->letters, [](Outbox::Letter& letter) {
    int done = 0;
    MPI_Test(&letter.request, &done, MPI_STATUS_IGNORE);
    return done != 0;
  });
  Outbox::Letter& letter = outbox_->letters.emplace_back(std::move(bytes), MPI_Request{});
  MPI_Isend(letter.bytes.data(),
            static_cast<int>(letter.bytes.size()),
            MPI_BYTE,
            rank,
            tag,
            MPI_COMM_WORLD,
            &letter.request);
}

namespace {

/// Says that this rank has come to its end and waits to be told whether the others have, too.
void leave(MpiJob& job) {
  job.send(0, kEnded, {});
  const auto until =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(kMasterSilence);
  while (std::chrono::steady_clock::now() < until) {
    while (const auto message = poll_message()) {
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
  double said = worker.now(), heard = worker.now();
  while (true) {
    if (worker.now() - heard > kMasterSilence) return job.ends_alone();
    while (const auto message = poll_message()) {
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
      worker.start(*point);
    }
    if (worker.idle() > 0) std::this_thread::sleep_for(kPause);
    for (const Trial& done : worker.wait(worker.idle() > 0 ? 0.0 : kLocalPatience)) {
      job.send(0, kOutcome, numbered(trial, encode(done.outcome)));
    }
    if (worker.now() - said < kHeartbeat) continue;
    said = worker.now();
    job.send(0, kAlive, {});
  }
}

}  // namespace

void serve_rank(MpiJob& job, ProcessOptions options) {
  try {
    serve(job, std::move(options));
  } catch (...) {
    job.ends_alone();  // the others go on: the end of MPI would wait for them
    throw;
  }
}

MpiExecutor::MpiExecutor(MpiJob& job) : job_(job), ranks_(job.size() - 1) {
  assert(job.rank() == 0 && job.size() > 1);
  for (Rank& rank : ranks_) rank.heard = now();
}

// A rank that was lost unnoticed would keep all others waiting in the end of MPI: so they are asked
// first whether they have come to theirs.
MpiExecutor::~MpiExecutor() {
  tell_all(kEnd, {});
  const auto awaited = [](const Rank& rank) { return !rank.lost && !rank.ended; };
  while (std::any_of(ranks_.begin(), ranks_.end(), awaited)) {
    while (const auto message = poll_message()) {
      Rank& rank = ranks_[message->rank - 1];
      rank.heard = now();
      rank.ended = rank.ended || message->tag == kEnded;
    }
    for (Rank& rank : ranks_) {
      if (!awaited(rank) || now() - rank.heard < kSilence) continue;
      rank.lost = true;
      job_.ends_alone();
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
  job_.send(
      static_cast<int>(rank - ranks_.begin()) + 1, kPoint, numbered(rank->trial, encode(point)));
}

std::vector<Trial> MpiExecutor::wait(double patience) {
  const double until = now() + patience;
  std::vector<Trial> finished;
  while (finished.empty() && now() < until) {
    say_alive();
    while (auto trial = receive()) finished.push_back(std::move(*trial));
    if (auto trial = lose_silent()) finished.push_back(std::move(*trial));
    if (finished.empty()) std::this_thread::sleep_for(kPause);
  }
  return finished;
}

void MpiExecutor::say_alive() {
  if (now() - said_ < kHeartbeat) return;
  said_ = now();
  tell_all(kAlive, {});
}

/// The next outcome that has arrived.
std::optional<Trial> MpiExecutor::receive() {
  while (const auto message = poll_message()) {
    Rank& rank = ranks_[message->rank - 1];
    rank.heard = now();
    if (message->tag != kOutcome || rank.lost) continue;
    const auto answer = take_number(message->bytes);
    if (!answer || !rank.point || answer->number != rank.trial) continue;  // was withdrawn
    auto outcome = decode_outcome(answer->rest);
    if (!outcome) outcome = Outcome{.result = Failure{"answer not readable", Cause::bad_output}};
    outcome->worker = message->rank;
    return Trial{*std::exchange(rank.point, std::nullopt), std::move(*outcome)};
  }
  return std::nullopt;
}

/// The trial of a rank that has not been heard for too long, which is not used any more.
std::optional<Trial> MpiExecutor::lose_silent() {
  for (Rank& rank : ranks_) {
    if (rank.lost || now() - rank.heard < kSilence) continue;
    rank.lost = true;
    job_.ends_alone();
    const bool any =
        std::any_of(ranks_.begin(), ranks_.end(), [](const Rank& r) { return !r.lost; });
    if (!any) throw InputError("every rank of the MPI job is lost; resume with the same command");
    if (!rank.point) continue;
    return Trial{*std::exchange(rank.point, std::nullopt),
                 {.result = Failure{"its MPI rank is out of reach", Cause::transient}}};
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
