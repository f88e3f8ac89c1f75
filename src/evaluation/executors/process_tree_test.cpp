// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/process_tree.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <string>

extern char** environ;

namespace latsch {
namespace {

/// A shell whose standard output is a pipe to the test.
struct Shell {
  explicit Shell(std::string script) {
    std::array<int, 2> ends;
    EXPECT_EQ(::pipe(ends.data()), 0);
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_adddup2(&files, ends[1], 1);
    ::posix_spawn_file_actions_addclose(&files, ends[0]);
    ::posix_spawn_file_actions_addclose(&files, ends[1]);
    std::string name = "sh", option = "-c";
    std::array<char*, 4> argv{name.data(), option.data(), script.data(), nullptr};
    EXPECT_EQ(::posix_spawnp(&pid, "sh", &files, nullptr, argv.data(), environ), 0);
    ::posix_spawn_file_actions_destroy(&files);
    ::close(ends[1]);
    output = ends[0];
  }
  ~Shell() { ::close(output); }

  /// Waits for the given number of bytes from the shell or its children.
  void await(int count) const {
    std::array<char, 1> byte;
    for (int i = 0; i < count; ++i) ASSERT_EQ(::read(output, byte.data(), 1), 1);
  }

  pid_t pid = -1;
  int output = -1;
};

TEST(ProcessTree, WhatDescendsFromAProcessIsKilledAndTheProcessItselfNotEvenStopped) {
  // The inner shell leaves the process group of the outer one, as job control does.
  const Shell shell("set -m; sh -c 'sleep 1000 & printf 12; wait'; exit 7");
  shell.await(2);
  kill_descendants(shell.pid);
  int status = 0;
  ASSERT_EQ(::waitpid(shell.pid, &status, 0), shell.pid);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 7);
  // The end of the pipe shows that all processes that could write to it have ended, including the
  // sleeping one.
  pollfd end{shell.output, POLLIN, 0};
  ASSERT_EQ(::poll(&end, 1, 10'000), 1);
  EXPECT_EQ(end.revents & POLLHUP, POLLHUP);
}

// A process may end while its files in /proc are read. The read then fails with ESRCH, for which
// stream iterators throw.
TEST(ProcessTree, ProcessesThatEndWhileItLooksDoNotDisturb) {
  const pid_t churn = ::fork();
  if (churn == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    while (true) {
      const pid_t child = ::fork();
      if (child == 0) ::_exit(0);
      ::waitpid(child, nullptr, 0);
    }
  }
  const pid_t idle = ::fork();
  if (idle == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    while (true) ::pause();
  }
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(1500)) {
    EXPECT_NO_THROW(kill_descendants(idle));
  }
  for (const pid_t pid : {churn, idle}) {
    ::kill(pid, SIGKILL);
    EXPECT_EQ(::waitpid(pid, nullptr, 0), pid);
  }
}

}  // namespace
}  // namespace latsch
