// SPDX-License-Identifier: Apache-2.0
// Messages between the ranks of an MPI job. The program itself does not need MPI: a small library
// of its own, lib/latsch/latsch_mpi.so beside the program, calls MPI (open_mpi.cpp) and is loaded
// only if several tasks were started as one job.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/result.h"

namespace latsch {

/// A message that was received from another rank.
struct MpiMessage {
  int rank;
  int tag;
  std::string bytes;
};

/// The calls of MPI that a job needs. At most one call may be under way at any time, from any
/// thread.
class MessagePassing {
 public:
  virtual ~MessagePassing() = default;
  /// Number of this rank, from 0.
  virtual int rank() const = 0;
  /// Number of ranks.
  virtual int size() const = 0;
  /// Returns the least first and the least second number of all ranks. Every rank must call this
  /// function.
  virtual std::array<std::uint64_t, 2> least_of_all(std::array<std::uint64_t, 2> mine) = 0;
  /// Sends a message without waiting until it is received.
  virtual void send(int rank, int tag, std::string bytes) = 0;
  /// Returns nullopt if no message has arrived.
  virtual std::optional<MpiMessage> poll() = 0;
  /// Waits until all messages have been received and every rank has called this function.
  virtual void finish() = 0;
};

/// Returns true if the library that calls MPI is there.
bool has_message_passing();
/// Loads the library that calls MPI and starts MPI, which is possible once in a process. The
/// library stays loaded.
Result<std::unique_ptr<MessagePassing>> start_message_passing();

}  // namespace latsch
