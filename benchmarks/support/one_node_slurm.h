// SPDX-License-Identifier: Apache-2.0
// A Slurm of one node, this machine, in a separate folder with separate keys, state and ports on
// the loopback interface. It exists as long as this object, or the process that created it.
//
// It runs slurmctld, slurmd and munged as root, and does not use cgroups (linuxproc is used
// instead) or binding to cores, so that it also starts in a container. [slurm.conf(5), munged(8);
// Debian 12: 22.05.8]
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace latsch::benchmarks {

class OneNodeSlurm {
 public:
  /// Returns what is missing on this machine; nullopt if Slurm can be started.
  static std::optional<std::string> missing();

  /// Waits until the node is idle. Throws std::runtime_error with the last output of the daemons if
  /// it does not become idle.
  OneNodeSlurm(const std::filesystem::path& folder, int cores);
  /// Cancels the jobs of this Slurm and ends its daemons.
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

/// Output of a command on both streams, and the exit code of the command.
struct Said {
  std::string text;
  int exit_code = 0;
};
Said said_by(const std::string& command);

}  // namespace latsch::benchmarks
