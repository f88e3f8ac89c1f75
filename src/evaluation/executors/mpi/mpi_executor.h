// SPDX-License-Identifier: Apache-2.0
// Executor whose workers are the ranks of an MPI job (Open MPI 4.1):
//
//   mpirun -n 4 --enable-recovery latsch run study.toml        rank 0 searches, three work
//   srun -n 4 --mpi=pmix latsch run study.toml                 the same, started by Slurm
//
// Every working rank runs its trials in a worker process of its own, as ProcessExecutor does, so
// that a crash or a timeout costs the trial and not the rank. Every rank reports each second that
// it is alive. Rank 0 does so in a separate thread, because reading a journal, proposing a step or
// writing a page may take minutes. If a rank is silent for too long, it counts as lost, and its
// trial is repeated on another rank. The lost trial counts as tried if the rank had reported that
// its worker began it. Only the time in which rank 0 listened counts as silence. Without
// --enable-recovery, mpirun ends the whole job if a rank dies; the same command then resumes from
// the journal.
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
#include "evaluation/executors/mpi/message_passing.h"
#include "evaluation/executors/process_executor.h"

namespace latsch {

/// Times after which a silent partner counts as lost, in s.
struct MpiPatience {
  double heartbeat = 1.0;
  double silence = 10.0;         // silence of a working rank after which the rank is lost
  double master_silence = 20.0;  // silence of rank 0 after which a rank ends by itself
};

/// The MPI job that this process belongs to. It lives until the process ends.
class MpiJob {
 public:
  explicit MpiJob(std::unique_ptr<MessagePassing> ranks, const MpiPatience& patience = {});
  /// Ends MPI without waiting for lost ranks.
  ~MpiJob();
  MpiJob(const MpiJob&) = delete;
  MpiJob& operator=(const MpiJob&) = delete;

  int rank() const { return ranks_->rank(); }
  int size() const { return ranks_->size(); }
  const MpiPatience& patience() const { return patience_; }
  /// Returns true if all ranks pass the same value. Every rank must call this function.
  bool agrees(std::uint64_t value);
  /// Declares that a rank has been lost, so that the destructor does not wait for it.
  void ends_alone() { ends_alone_ = true; }
  bool is_alone() const { return ends_alone_; }

  /// Sends a message without waiting until it is received, because a lost rank never receives it.
  void send(int rank, int tag, std::string bytes);
  /// Returns nullopt if no message has arrived.
  std::optional<MpiMessage> poll();
  /// Marks a rank as lost, to which no more messages are sent.
  void lose(int rank);

 private:
  void beat();  // sends signs of life until the end, in a thread of rank 0
  void say(int rank, int tag, std::string bytes);

  MpiPatience patience_;
  bool ends_alone_ = false;
  std::mutex mutex_;  // guards every call of MPI and the members below
  std::unique_ptr<MessagePassing> ranks_;
  std::set<int> lost_;
  bool ending_ = false;
  std::condition_variable end_;
  std::thread heart_;
};

/// Runs trials in one worker process until rank 0 ends the job: the work of a working rank.
void serve_rank(MpiJob& job, ProcessOptions options);

class MpiExecutor : public Executor {
 public:
  /// Takes a job of at least two ranks. Must be called on rank 0.
  explicit MpiExecutor(MpiJob& job);
  /// Tells the ranks to end and waits until they have ended. For a lost rank it waits no longer
  /// than the permitted silence.
  ~MpiExecutor() override;

  int workers() const override { return static_cast<int>(ranks_.size()); }
  int idle() const override;
  void start(const DesignPoint& point) override;
  /// Throws InputError if every rank is lost.
  std::vector<Trial> wait(double patience) override;
  void withdraw(const DesignPoint& point) override;
  void abandon() override;

 private:
  struct Rank {
    std::optional<DesignPoint> point;
    std::uint64_t trial = 0;
    bool begun = false;  // true once the rank's worker has begun the point
    double heard = 0.0;  // time of the rank's last message, s
    bool lost = false;
    bool ended = false;  // true once the rank runs no more trials and waits to leave the job
  };
  void tell_all(int tag, const std::string& bytes);
  void lose(std::size_t worker);
  std::optional<Trial> receive();
  std::optional<Trial> lose_silent();
  void forget(std::size_t worker);

  MpiJob& job_;
  std::vector<Rank> ranks_;  // all ranks from rank 1 on
  std::uint64_t trials_ = 0;
  double listened_ = 0.0;  // time until which rank 0 has listened, s
};

}  // namespace latsch
