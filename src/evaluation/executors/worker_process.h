// SPDX-License-Identifier: Apache-2.0
// One worker process as its master sees it: started, told a point, listened to, killed.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "evaluation/executors/frame.h"

namespace latsch {

/// A file descriptor that closes itself.
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
  /// (0: any). Throws InputError where that is not possible.
  WorkerProcess(const std::vector<std::string>& arguments, double memory_limit);
  /// Kills its whole process group.
  ~WorkerProcess();
  WorkerProcess(WorkerProcess&&) = delete;

  /// False where the worker does not listen any more.
  bool send(const std::string& frame);

  /// Takes over what has arrived, without waiting.
  void receive();
  FrameReader& frames() { return frames_; }
  bool ended() const;

  /// Kills what is left of the process group and tells how the worker ended: "was killed by signal
  /// 11 (Segmentation fault)", with the last line it printed.
  std::string end();

  /// After end(): a signal sent by somebody else (a person, the system short of memory, a shutdown)
  /// rather than by a fault of its own.
  bool was_stopped_from_outside() const;

  /// To poll(2) on: readable when there is something to receive or the worker ended.
  std::vector<int> descriptors() const;

 private:
  void take_printed();

  pid_t pid_ = -1;
  int status_ = 0;  // of waitpid(2)
  Descriptor socket_;
  Descriptor printed_;  // its stdout and stderr
  Descriptor process_;  // readable once it has ended
  FrameReader frames_;
  std::string last_printed_;
};

}  // namespace latsch
