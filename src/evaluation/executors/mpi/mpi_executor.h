// SPDX-License-Identifier: Apache-2.0
// Workers on the ranks of an MPI job (Open MPI 4.1):
//
//   mpirun -n 4 --enable-recovery latsch run study.toml        rank 0 searches, three work
//   srun -n 4 --mpi=pmix latsch run study.toml                 the same, started by Slurm
//
// Every working rank runs its trials in a worker process of its own, as ProcessExecutor does, so
// that a crash or a timeout costs the trial and not the rank. Every rank says each second that it
// lives, rank 0 in a thread of its own: reading a journal, proposing a step, writing a page may
// take it minutes. One that is silent for too long is lost with the trial it had, which is then
// repeated on another, and counts as tried if the rank had said that its worker is at it; only the
// time in which rank 0 listened counts. Without --enable-recovery mpirun ends the whole job where a
// rank dies; the journal is then resumed by the same command.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "evaluation/executors/executor.h"
#include "evaluation/executors/process_executor.h"

namespace latsch {

/// Who waits how long for whom, in s.
struct MpiPatience {
  double heartbeat = 1.0;
  double silence = 10.0;         // of a working rank, after which it is lost
  double master_silence = 20.0;  // of rank 0, after which a rank ends by itself
};

/// A message that has arrived.
struct MpiMessage {
  int rank;
  int tag;
  std::string bytes;
};

/// The MPI job of this process; ends with it.
class MpiJob {
 public:
  explicit MpiJob(const MpiPatience& patience = {});
  /// Ends MPI; does not wait for ranks that are lost.
  ~MpiJob();
  MpiJob(const MpiJob&) = delete;
  MpiJob& operator=(const MpiJob&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  const MpiPatience& patience() const { return patience_; }
  /// Whether every rank has the same value; each has to ask.
  bool agrees(std::uint64_t value);
  /// A rank has been lost: the end must not wait for it.
  void ends_alone() { ends_alone_ = true; }
  bool is_alone() const { return ends_alone_; }

  /// Does not wait until it is received: a rank that is lost never receives.
  void send(int rank, int tag, std::string bytes);
  /// nullopt where none has arrived.
  std::optional<MpiMessage> poll();
  /// Nothing is said to that rank any more.
  void lose(int rank);

 private:
  void beat();  // until the end, in a thread of rank 0
  void say(int rank, int tag, std::string bytes);

  MpiPatience patience_;
  int rank_ = 0;
  int size_ = 1;
  bool ends_alone_ = false;
  std::mutex mutex_;  // of every call of MPI and what follows
  struct Outbox;
  std::unique_ptr<Outbox> outbox_;
  std::set<int> lost_;
  bool ending_ = false;
  std::condition_variable end_;
  std::thread heart_;
};

/// What a working rank does until rank 0 ends the job: trials in one worker process.
void serve_rank(MpiJob& job, ProcessOptions options);

class MpiExecutor : public Executor {
 public:
  /// On rank 0 of a job of at least two ranks.
  explicit MpiExecutor(MpiJob& job);
  /// Tells the ranks to end and waits until they have, for one that is lost no longer than their
  /// silence may last.
  ~MpiExecutor() override;

  int workers() const override { return static_cast<int>(ranks_.size()); }
  int idle() const override;
  void start(const DesignPoint& point) override;
  /// Throws InputError where every rank is lost.
  std::vector<Trial> wait(double patience) override;
  void withdraw(const DesignPoint& point) override;
  void abandon() override;

 private:
  struct Rank {
    std::optional<DesignPoint> point;
    std::uint64_t trial = 0;
    bool begun = false;  // its worker is at the point
    double heard = 0.0;  // s, when it last said something
    bool lost = false;
    bool ended = false;  // does no trials any more, waits to leave the job
  };
  void tell_all(int tag, const std::string& bytes);
  void lose(std::size_t worker);
  std::optional<Trial> receive();
  std::optional<Trial> lose_silent();
  void forget(std::size_t worker);

  MpiJob& job_;
  std::vector<Rank> ranks_;  // rank 1 is the first
  std::uint64_t trials_ = 0;
  double listened_ = 0.0;  // s, until when
};

}  // namespace latsch
