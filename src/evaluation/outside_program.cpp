// SPDX-License-Identifier: Apache-2.0
#include "evaluation/outside_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include "base/text.h"

extern char** environ;

namespace latsch {
namespace {

constexpr long kTail = 4096;  // bytes of what it printed in which the last line is looked for

std::string last_line(const std::filesystem::path& printed) {
  std::ifstream file(printed, std::ios::binary | std::ios::ate);
  const long size = std::max<long>(file.tellg(), 0);
  file.seekg(std::max(size - kTail, 0L));
  std::string line, last;
  while (std::getline(file, line)) {
    if (!trimmed(line).empty()) last = line;
  }
  return std::string(trimmed(last));
}

Failure ended(const std::string& program, int status, const std::filesystem::path& printed) {
  const std::string how =
      WIFSIGNALED(status)
          ? fmt::format(
                "was killed by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)))
          : fmt::format("exited with code {}", WEXITSTATUS(status));
  const std::string line = last_line(printed);
  return {in_quotes(program) + " " + how +
          (line.empty() ? "" : "; it last printed " + in_quotes(line))};
}

}  // namespace

std::optional<Failure> run_program(const std::vector<std::string>& arguments,
                                   const std::filesystem::path& folder,
                                   const std::filesystem::path& printed) {
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
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
  return ended(arguments.front(), status, printed);
}

}  // namespace latsch
