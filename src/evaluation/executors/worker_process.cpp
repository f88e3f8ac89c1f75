// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/worker_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "base/error.h"
#include "evaluation/executors/process_end.h"
#include "evaluation/executors/worker.h"

extern char** environ;

namespace latsch {
namespace {

constexpr std::size_t kKeptOutput = 4096;  // bytes of the worker's printed output that are kept
constexpr int kFreeDescriptors = 10;       // number of low descriptors that are left to the worker

[[noreturn]] void cannot_start(const std::string& program, int error) {
  throw InputError(
      fmt::format("cannot start the worker program \"{}\": {}", program, std::strerror(error)));
}

/// Duplicates the file to a descriptor above the numbers that dup2(2) uses in the worker.
Descriptor moved_up(int fd, const std::string& program) {
  const Descriptor low(fd);
  Descriptor high(::fcntl(fd, F_DUPFD_CLOEXEC, kFreeDescriptors));
  if (high.get() < 0) cannot_start(program, errno);
  return high;
}

struct Pair {
  Descriptor ours;
  Descriptor theirs;
};

Pair make_socket(const std::string& program) {
  std::array<int, 2> fds;
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, fds.data()) != 0) {
    cannot_start(program, errno);
  }
  return {moved_up(fds[0], program), moved_up(fds[1], program)};
}

Pair make_pipe(const std::string& program) {
  std::array<int, 2> fds;
  if (::pipe2(fds.data(), O_CLOEXEC) != 0) cannot_start(program, errno);
  Pair pair{moved_up(fds[0], program), moved_up(fds[1], program)};
  ::fcntl(pair.ours.get(), F_SETFL, O_NONBLOCK);
  return pair;
}

pid_t spawn(const std::vector<std::string>& arguments, int socket, int printed) {
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, printed, 1);
  ::posix_spawn_file_actions_adddup2(&files, printed, 2);
  ::posix_spawn_file_actions_adddup2(&files, socket, kWorkerInput);
  ::posix_spawn_file_actions_adddup2(&files, socket, kWorkerOutput);

  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigset_t none, defaults;
  ::sigemptyset(&none);
  ::sigfillset(&defaults);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &defaults);
  // Puts the worker into a process group of its own, to be killed as a whole.
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(
      &attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t pid = -1;
  const int error = ::posix_spawnp(&pid, argv[0], &files, &attributes, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  ::posix_spawnattr_destroy(&attributes);
  if (error != 0) cannot_start(arguments.front(), error);
  return pid;
}

void limit(pid_t pid, double memory_limit) {
  const rlimit no_core{0, 0};
  ::prlimit(pid, RLIMIT_CORE, &no_core, nullptr);
  if (memory_limit > 0.0) {
    const auto bytes = static_cast<rlim_t>(memory_limit);
    const rlimit memory{bytes, bytes};
    ::prlimit(pid, RLIMIT_AS, &memory, nullptr);
  }
}

bool readable(int fd, int milliseconds) {
  pollfd entry{fd, POLLIN, 0};
  return ::poll(&entry, 1, milliseconds) > 0;
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) {
    if (fd_ >= 0) ::close(fd_);
    fd_ = other.release();
  }
  return *this;
}

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}

int Descriptor::release() { return std::exchange(fd_, -1); }

WorkerProcess::WorkerProcess(const std::vector<std::string>& arguments, double memory_limit) {
  assert(!arguments.empty());
  Pair socket = make_socket(arguments.front());
  Pair printed = make_pipe(arguments.front());
  pid_ = spawn(arguments, socket.theirs.get(), printed.theirs.get());
  limit(pid_, memory_limit);
  process_ = Descriptor(static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)));
  socket_ = std::move(socket.ours);
  printed_ = std::move(printed.ours);
}

WorkerProcess::~WorkerProcess() {
  if (pid_ > 0) end();
}

bool WorkerProcess::send(const std::string& frame) {
  std::string_view rest = frame;
  while (!rest.empty()) {
    const ssize_t count = ::send(socket_.get(), rest.data(), rest.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    rest.remove_prefix(count);
  }
  return true;
}

void WorkerProcess::receive() {
  std::array<char, 65536> chunk;
  ssize_t count = 0;
  while ((count = ::recv(socket_.get(), chunk.data(), chunk.size(), MSG_DONTWAIT)) > 0) {
    frames_.add({chunk.data(), static_cast<std::size_t>(count)});
  }
  take_printed();
}

void WorkerProcess::take_printed() {
  std::array<char, 65536> chunk;
  ssize_t count = 0;
  while ((count = ::read(printed_.get(), chunk.data(), chunk.size())) > 0) {
    last_printed_.append(chunk.data(), count);
    if (last_printed_.size() > kKeptOutput) {
      last_printed_.erase(0, last_printed_.size() - kKeptOutput);
    }
  }
}

bool WorkerProcess::ended() const { return readable(process_.get(), 0); }

std::string WorkerProcess::end() {
  // A child that left the group is found as a descendant. A child whose parent has ended, or that
  // starts only now, is found as a member of the group. Both are killed before waiting for the
  // leader, so that the system does not reuse the leader's number.
  if (!ended()) kill_descendants(pid_);
  ::kill(-pid_, SIGKILL);
  while (::waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  take_printed();
  return how_it_ended(status_, last_printed_);
}

bool WorkerProcess::was_stopped_from_outside() const {
  if (!WIFSIGNALED(status_)) return false;
  const int signal = WTERMSIG(status_);
  return signal == SIGTERM || signal == SIGKILL || signal == SIGINT || signal == SIGHUP;
}

std::vector<int> WorkerProcess::descriptors() const {
  return {socket_.get(), printed_.get(), process_.get()};
}

}  // namespace latsch
