// SPDX-License-Identifier: Apache-2.0
// A Slurm of one node, this machine, with its own keys, state and ports on the loopback interface,
// in a folder of its own; it lives as long as this object, or as the process that has it.
//
// Needs root, who runs slurmctld, slurmd and munged here; without cgroups (linuxproc) and without
// binding, so that it also starts in a container. [slurm.conf(5), munged(8); Debian 12: 22.05.8]
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace latsch::benchmarks {

class OneNodeSlurm {
 public:
  /// What is missing here; nullopt where it can be started.
  static std::optional<std::string> missing();

  /// Waits until the node is idle. Throws std::runtime_error, with what the daemons said last,
  /// where that does not come about.
  OneNodeSlurm(const std::filesystem::path& folder, int cores);
  /// Cancels its jobs and ends its daemons.
  ~OneNodeSlurm();
  OneNodeSlurm(const OneNodeSlurm&) = delete;
  OneNodeSlurm& operator=(const OneNodeSlurm&) = delete;

 private:
  void write_settings(int cores) const;
  void start_daemon(const std::vector<std::string>& arguments, const std::string& log);
  void wait_until_idle() const;
  void end() noexcept;

  std::filesystem::path folder_;
  std::vector<pid_t> daemons_;
};

/// What a command printed, on both streams, and its exit code.
struct Said {
  std::string text;
  int exit_code = 0;
};
Said said_by(const std::string& command);

}  // namespace latsch::benchmarks
