// SPDX-License-Identifier: Apache-2.0
#include "evaluation/outside_program/outside_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "base/text.h"
#include "evaluation/executors/process_end.h"
#include "evaluation/executors/process_tree.h"

extern char** environ;

namespace latsch {
namespace {

// Number of bytes at the end of the printed output in which the last line is searched.
constexpr long kTail = 4096;

std::string tail_of(const std::filesystem::path& printed) {
  std::ifstream file(printed, std::ios::binary | std::ios::ate);
  const long size = std::max<long>(file.tellg(), 0);
  std::string tail(static_cast<std::size_t>(std::min(size, kTail)), '\0');
  file.seekg(size - std::ssize(tail));
  file.read(tail.data(), std::ssize(tail));
  return tail;
}

/// Waits for the end of the process, but not longer than `timeout`.
bool ends_within(pid_t pid, double timeout) {
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::duration<double>(timeout);
  const int process = static_cast<int>(::syscall(SYS_pidfd_open, pid, 0));
  bool ended = false;
  for (double rest = timeout; !ended && rest > 0.0;) {
    pollfd entry{process, POLLIN, 0};
    ended = ::poll(&entry, 1, static_cast<int>(std::ceil(std::min(rest, 3600.0) * 1e3))) > 0;
    rest = std::chrono::duration<double>(until - Clock::now()).count();
  }
  ::close(process);
  return ended;
}

}  // namespace

Status run_program(const std::vector<std::string>& arguments,
                   const std::filesystem::path& folder,
                   const std::filesystem::path& printed,
                   double timeout) {
  assert(!arguments.empty());
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(
      &files, 1, std::filesystem::absolute(printed).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  ::posix_spawn_file_actions_adddup2(&files, 1, 2);
  ::posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t pid = -1;
  const int error = ::posix_spawnp(&pid, argv[0], &files, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  if (error != 0) {
    return Failure{fmt::format("cannot start {}: {}", in_quotes(argv[0]), std::strerror(error))};
  }
  const bool in_time = timeout <= 0.0 || ends_within(pid, timeout);
  if (!in_time) {
    // The stopped program starts no process while its descendants are searched.
    ::kill(pid, SIGSTOP);
    kill_descendants(pid);
    ::kill(pid, SIGKILL);
  }
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (!in_time) {
    return Failure{fmt::format("{} took more than the {:g} s allowed to it and was killed",
                               in_quotes(arguments.front()),
                               timeout),
                   Cause::timeout};
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return Failure{in_quotes(arguments.front()) + " " + how_it_ended(status, tail_of(printed))};
}

bool can_be_found(const std::string& program) {
  const bool is_relative = !program.starts_with('/') && program.find('/') != std::string::npos;
  return is_relative || file_of_program(program);
}

std::optional<std::filesystem::path> file_of_program(const std::string& program) {
  const auto runs = [](const std::filesystem::path& file) {
    std::error_code unknown;  // a folder of PATH that may not be entered, which a shell skips too
    return ::access(file.c_str(), X_OK) == 0 && !std::filesystem::is_directory(file, unknown);
  };
  if (program.find('/') != std::string::npos) {
    return program.starts_with('/') && runs(program) ? std::optional(std::filesystem::path(program))
                                                     : std::nullopt;
  }
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (runs(std::filesystem::path(folder) / program)) {
      return std::filesystem::path(folder) / program;
    }
  }
  return std::nullopt;
}

}  // namespace latsch
