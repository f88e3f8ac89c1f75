// SPDX-License-Identifier: Apache-2.0
// Workers on the ranks of an MPI job (Open MPI 4.1, also as Slurm starts it):
//
//   mpirun -n 4 --enable-recovery latsch run study.toml        rank 0 searches, three work
//
// Every working rank runs its trials in a worker process of its own, as ProcessExecutor does, so
// that a crash or a timeout costs the trial and not the rank. A rank says every second that it
// lives; one that is silent for kSilence is lost with the trial it had, which is then repeated on
// another. Without --enable-recovery mpirun ends the whole job where a rank dies; the journal is
// then resumed by the same command.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/executor.h"
#include "evaluation/process_executor.h"

namespace latsch {

inline constexpr double kSilence = 10.0;        // s
inline constexpr double kMasterSilence = 20.0;  // s, after which a rank ends by itself

/// The MPI job of this process; ends with it.
class MpiJob {
 public:
  /// Whether mpirun or a resource manager started this process as one rank of several.
  static bool is_rank_of_many();

  MpiJob();
  /// Ends MPI; does not wait for ranks that are lost.
  ~MpiJob();
  MpiJob(const MpiJob&) = delete;
  MpiJob& operator=(const MpiJob&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  /// A rank has been lost: the end must not wait for it.
  void ends_alone() { ends_alone_ = true; }
  bool is_alone() const { return ends_alone_; }

  /// Does not wait until it is received: a rank that is lost never receives.
  void send(int rank, int tag, std::string bytes);

 private:
  int rank_ = 0;
  int size_ = 1;
  bool ends_alone_ = false;
  struct Outbox;
  std::unique_ptr<Outbox> outbox_;
};

/// What a working rank does until rank 0 ends the job: trials in one worker process.
void serve_rank(MpiJob& job, ProcessOptions options);

class MpiExecutor : public Executor {
 public:
  /// On rank 0 of a job of at least two ranks.
  explicit MpiExecutor(MpiJob& job);
  /// Tells the ranks to end and waits until they have, for one that is lost no longer than
  /// kSilence.
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
    double heard = 0.0;  // s, when it last said something
    bool lost = false;
    bool ended = false;  // does no trials any more, waits to leave the job
  };
  void tell_all(int tag, const std::string& bytes);
  void say_alive();
  std::optional<Trial> receive();
  std::optional<Trial> lose_silent();
  void forget(std::size_t worker);

  MpiJob& job_;
  std::vector<Rank> ranks_;  // rank 1 is the first
  std::uint64_t trials_ = 0;
  double said_ = 0.0;  // s, when the ranks were last told that this process lives
};

}  // namespace latsch
