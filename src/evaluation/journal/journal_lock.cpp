// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/journal_lock.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include "base/error.h"

namespace latsch {
namespace {

std::string read_all(int fd) {
  std::array<char, 256> buffer{};
  const ssize_t count = ::pread(fd, buffer.data(), buffer.size(), 0);
  std::string text(buffer.data(), count > 0 ? count : 0);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::string host_name() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return host.data();
}

std::string holder_text() {
  return fmt::format("process {} on {} since {:%Y-%m-%d %H:%M:%S} UTC\n",
                     ::getpid(),
                     host_name(),
                     fmt::gmtime(std::time(nullptr)));
}

/// True if `fd` is still the file at the given path. A holder removes its lock file when it ends.
bool is_current(int fd, const std::filesystem::path& file) {
  struct stat opened {};
  struct stat present {};
  return ::fstat(fd, &opened) == 0 && ::stat(file.c_str(), &present) == 0 &&
         opened.st_ino == present.st_ino && opened.st_dev == present.st_dev;
}

[[noreturn]] void refuse(const std::filesystem::path& journal, const std::string& what) {
  throw InputError({journal.string(), 0}, what);
}

/// `error` is that of flock(2); only EWOULDBLOCK means that somebody holds the lock.
std::string complaint(int error, const std::string& holder) {
  if (error == EWOULDBLOCK) {
    return fmt::format(
        "is in use by {}; wait until it ends or stop it. Reading it, as a report does, is possible "
        "meanwhile",
        holder.empty() ? "another process" : holder);
  }
  return fmt::format(
      "cannot be locked ({}): its file system gives no locks, and two runs at once would spoil it. "
      "Nobody holds it; name a journal on a local disk, journal = \"...\" in [run]",
      std::strerror(error));
}

/// Process named in a lock file.
struct Named {
  int process = 0;
  std::string host;
};

std::optional<Named> named_in(const std::string& holder) {
  Named named;
  std::array<char, 256> host{};
  if (std::sscanf(holder.c_str(), "process %d on %255s", &named.process, host.data()) != 2)
    return std::nullopt;  // the lock was just taken, or its holder's disk is full
  named.host = host.data();
  return named;
}

/// True if the process that took the lock is gone: a child holds the lock until it executes another
/// program.
bool is_inherited(const std::string& holder) {
  const auto named = named_in(holder);
  return named && named->host == host_name() && ::kill(named->process, 0) != 0 && errno == ESRCH;
}

/// Returns the lock beside the file itself, so that all links to a journal have one lock.
std::filesystem::path lock_of(const std::filesystem::path& journal) {
  std::error_code none;
  std::filesystem::path file = std::filesystem::weakly_canonical(journal, none);
  if (none) file = journal;
  file += ".lock";
  return file;
}

}  // namespace

JournalLock::JournalLock(const std::filesystem::path& journal) : file_(lock_of(journal)) {
  using namespace std::chrono_literals;
  constexpr auto kMostPatience = 5s;  // for short waits on a busy machine
  const auto until = std::chrono::steady_clock::now() + kMostPatience;
  while (true) {
    fd_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (fd_ < 0) refuse(journal, fmt::format("cannot write beside it: {}", std::strerror(errno)));
    int locked = 0;
    while ((locked = ::flock(fd_, LOCK_EX | LOCK_NB)) != 0 && errno == EINTR) {
    }
    if (locked != 0) {
      const int error = errno;
      const std::string holder = read_all(fd_);
      ::close(fd_);
      if (error == EWOULDBLOCK && is_inherited(holder) &&
          std::chrono::steady_clock::now() < until) {
        std::this_thread::sleep_for(10ms);
        continue;
      }
      refuse(journal, complaint(error, holder));
    }
    if (is_current(fd_, file_)) break;
    ::close(fd_);
  }
  // If the holder's name cannot be written, for example on a full disk, the lock still holds.
  const std::string holder = holder_text();
  if (::ftruncate(fd_, 0) == 0 && ::pwrite(fd_, holder.data(), holder.size(), 0) < 0) errno = 0;
}

JournalLock::~JournalLock() {
  ::unlink(file_.c_str());
  ::close(fd_);
}

namespace {

/// True if that process of this machine holds an flock(2) on the file. The device is not compared,
/// because overlays and file systems of several volumes show another one there. [proc(5),
/// /proc/locks]
bool holds(int process, ino_t inode) {
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, manner, access, file;
    int holder = 0;
    if (words >> number >> kind >> manner >> access >> holder >> file && kind == "FLOCK" &&
        holder == process && file.ends_with(fmt::format(":{}", inode)))
      return true;
  }
  return false;
}

}  // namespace

std::optional<JournalHolder> journal_holder(const std::filesystem::path& journal) {
  const int fd = ::open(lock_of(journal).c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return std::nullopt;
  const std::string words = read_all(fd);
  struct stat file {};
  ::fstat(fd, &file);
  ::close(fd);
  const auto named = named_in(words);
  if (!named) return std::nullopt;
  if (named->host != host_name()) return JournalHolder{words, std::nullopt};
  if (!holds(named->process, file.st_ino))
    return std::nullopt;  // the name was left behind by a
                          // killed process
  return JournalHolder{words, named->process};
}

}  // namespace latsch
