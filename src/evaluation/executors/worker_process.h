// SPDX-License-Identifier: Apache-2.0
// A worker process as its master sees it: starts it, sends a point, receives its messages, kills
// it.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "evaluation/executors/frame.h"
#include "evaluation/executors/process_tree.h"

namespace latsch {

/// File descriptor that closes itself.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();

  int get() const { return fd_; }
  int release();

 private:
  int fd_ = -1;
};

class WorkerProcess {
 public:
  /// Starts the program, without core dumps and with at most `memory_limit` bytes of address space
  /// (0: unlimited). Throws InputError if that is not possible.
  WorkerProcess(const std::vector<std::string>& arguments, double memory_limit);
  /// Kills the worker's whole process group.
  ~WorkerProcess();
  WorkerProcess(WorkerProcess&&) = delete;

  /// Returns false if the worker no longer listens.
  bool send(const std::string& frame);

  /// Reads the bytes that have arrived, without waiting.
  void receive();
  FrameReader& frames() { return frames_; }
  bool ended() const;
  /// Returns the use of the machine by the worker and its descendants.
  ProcessUse use() const { return use_of_tree(pid_); }

  /// Kills the rest of the process group. Returns a text that says how the worker ended, such as
  /// "was killed by signal 11 (Segmentation fault)", with the last line that it printed.
  std::string end();

  /// Returns true if the process was killed by somebody else (a person, the system for lack of
  /// memory, a shutdown), not by a fault of the worker. Valid after end().
  bool was_stopped_from_outside() const;

  /// Returns descriptors for poll(2): readable when data has arrived or the worker has ended.
  std::vector<int> descriptors() const;

 private:
  void take_printed();

  pid_t pid_ = -1;
  int status_ = 0;  // exit status from waitpid(2)
  Descriptor socket_;
  Descriptor printed_;  // the worker's stdout and stderr
  Descriptor process_;  // readable once the worker has ended
  FrameReader frames_;
  std::string last_printed_;
};

}  // namespace latsch
