// SPDX-License-Identifier: Apache-2.0
// The library latsch_mpi.so: all calls of MPI, and nothing else of latsch.
#include <mpi.h>

#include <list>
#include <utility>

#include "evaluation/executors/mpi/message_passing.h"

namespace latsch {
namespace {

class OpenMpi : public MessagePassing {
 public:
  OpenMpi() {
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  std::array<std::uint64_t, 2> least_of_all(std::array<std::uint64_t, 2> mine) override {
    std::array<std::uint64_t, 2> least{};
    MPI_Allreduce(mine.data(), least.data(), 2, MPI_UINT64_T, MPI_MIN, MPI_COMM_WORLD);
    return least;
  }

  void send(int rank, int tag, std::string bytes) override {
    std::erase_if(letters_, [](Letter& letter) {
      int done = 0;
      MPI_Test(&letter.request, &done, MPI_STATUS_IGNORE);
      return done != 0;
    });
    Letter& letter = letters_.emplace_back(Letter{std::move(bytes), MPI_Request{}});
    MPI_Isend(letter.bytes.data(),
              static_cast<int>(letter.bytes.size()),
              MPI_BYTE,
              rank,
              tag,
              MPI_COMM_WORLD,
              &letter.request);
  }

  std::optional<MpiMessage> poll() override {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
    if (!there) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    MpiMessage message{status.MPI_SOURCE, status.MPI_TAG, std::string(size, '\0')};
    MPI_Recv(message.bytes.data(),
             size,
             MPI_BYTE,
             message.rank,
             message.tag,
             MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    return message;
  }

  void finish() override {
    for (Letter& letter : letters_) MPI_Wait(&letter.request, MPI_STATUS_IGNORE);
    MPI_Finalize();
  }

 private:
  struct Letter {
    std::string bytes;
    MPI_Request request;
  };
  int rank_ = 0;
  int size_ = 1;
  std::list<Letter> letters_;  // sent messages whose bytes MPI may still need
};

}  // namespace
}  // namespace latsch

/// Starts MPI. Returns null if it cannot be called from several threads, one call at a time.
extern "C" latsch::MessagePassing* latsch_start_message_passing() {
  int threads = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &threads);
  if (threads < MPI_THREAD_SERIALIZED) return nullptr;
  return new latsch::OpenMpi;
}
