// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/journal_lock.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
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
#include <vector>

#include "base/error.h"
#include "evaluation/journal/local_file_system.h"
#include "evaluation/trial/host_name.h"

namespace latsch {
namespace {

std::string read_all(int fd) {
  std::array<char, 256> buffer{};
  const ssize_t count = ::pread(fd, buffer.data(), buffer.size(), 0);
  std::string text(buffer.data(), count > 0 ? count : 0);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::string holder_text() {
  return fmt::format("process {} on {} since {:%Y-%m-%d %H:%M:%S} UTC\n",
                     ::getpid(),
                     host_name(),
                     fmt::gmtime(std::time(nullptr)));
}

/// True if the path still leads to the file that is open as `fd`: the process that holds a lock
/// removes its lock file when it ends.
bool is_current(int fd, const std::filesystem::path& file) {
  struct stat opened {};
  struct stat present {};
  return ::fstat(fd, &opened) == 0 && ::stat(file.c_str(), &present) == 0 &&
         opened.st_ino == present.st_ino && opened.st_dev == present.st_dev;
}

[[noreturn]] void refuse(const std::filesystem::path& journal, const std::string& what) {
  throw InputError({journal.string(), 0}, what);
}

/// Returns the message for an `error` of flock(2). Only EWOULDBLOCK means that another process, the
/// `holder`, has the lock.
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

/// The process named in a lock file.
struct Named {
  int process = 0;
  std::string host;
};

std::optional<Named> named_in(const std::string& holder) {
  Named named;
  std::array<char, 256> host{};
  if (std::sscanf(holder.c_str(), "process %d on %255s", &named.process, host.data()) != 2)
    return std::nullopt;  // the lock was just taken, or the disk of its holder is full
  named.host = host.data();
  return named;
}

bool is_gone(int process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

/// True if the process that took the lock has ended, and the lock is held by a child that has not
/// executed another program yet.
bool is_inherited(const std::string& holder) {
  const auto named = named_in(holder);
  return named && named->host == host_name() && is_gone(named->process);
}

/// Returns the path of the lock file. It lies beside the journal itself, not beside a symbolic link
/// to it, so that all symbolic links to a journal share one lock.
std::filesystem::path lock_of(const std::filesystem::path& journal) {
  std::error_code none;
  std::filesystem::path file = std::filesystem::weakly_canonical(journal, none);
  if (none) file = journal;
  file += ".lock";
  return file;
}

}  // namespace

namespace {

/// Calls flock(2) without waiting; returns 0 or its error.
int lock(int fd) {
  while (::flock(fd, LOCK_EX | LOCK_NB) != 0)
    if (errno != EINTR) return errno;
  return 0;
}

/// Returns the processes of this machine that hold an flock(2) on a file with this inode number.
/// The device is not compared, because file systems with overlays or several volumes report another
/// device in /proc/locks. [proc(5), /proc/locks]
std::vector<int> flock_holders(ino_t inode) {
  std::vector<int> holders;
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, manner, access, file;
    int holder = 0;
    if (words >> number >> kind >> manner >> access >> holder >> file && kind == "FLOCK" &&
        file.ends_with(fmt::format(":{}", inode)))
      holders.push_back(holder);
  }
  return holders;
}

/// Limits the time for which a process waits for a lock that another one holds only briefly.
class Patience {
 public:
  /// Waits a moment. Returns false once the total time is used up.
  bool wait() const {
    using namespace std::chrono_literals;
    if (std::chrono::steady_clock::now() >= until_) return false;
    std::this_thread::sleep_for(10ms);
    return true;
  }

 private:
  std::chrono::steady_clock::time_point until_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(5);
};

}  // namespace

JournalLock::JournalLock(const std::filesystem::path& journal)
    : journal_(journal), file_(lock_of(journal)), is_local_(!shared_file_system(journal)) {
  const Patience patience;
  while (true) {
    fd_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (fd_ < 0)
      refuse(journal,
             fmt::format("cannot write beside it: {}{}",
                         std::strerror(errno),
                         errno == EACCES || errno == EROFS
                             ? "; in a copy of the study, [run] journal = \"FILE\" can name a "
                               "journal in a folder that can be written"
                             : ""));
    if (const int error = lock(fd_)) {
      const std::string holder = read_all(fd_);
      ::close(fd_);
      if (error == EWOULDBLOCK && is_inherited(holder) && patience.wait()) continue;
      refuse(journal, complaint(error, holder));
    }
    if (is_current(fd_, file_)) break;
    ::close(fd_);
  }
  lock_itself();
  // If the holder's name cannot be written, for example on a full disk, the lock still holds.
  const std::string holder = holder_text();
  if (::ftruncate(fd_, 0) == 0 && ::pwrite(fd_, holder.data(), holder.size(), 0) < 0) errno = 0;
}

/// Locks the journal itself, which finds a process that opened it by another hard link. A network
/// file system may turn this lock into one of the kind that SQLite uses, for which SQLite would
/// then wait.
void JournalLock::lock_itself() {
  const auto give_up = [this](const std::string& what) {
    ::unlink(file_.c_str());
    ::close(fd_);
    if (itself_ >= 0) ::close(itself_);
    refuse(journal_, what);
  };
  itself_ = ::open(journal_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (itself_ < 0) itself_ = ::open(journal_.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat about {};
  if (itself_ < 0 || !is_local_ || ::fstat(itself_, &about) != 0) return;
  const Patience patience;
  while (const int error = lock(itself_)) {
    // The file system does not support this lock; the lock file beside the journal suffices.
    if (error != EWOULDBLOCK) return;
    const std::vector<int> holders = flock_holders(about.st_ino);
    const bool are_gone = !holders.empty() && std::all_of(holders.begin(), holders.end(), is_gone);
    if (are_gone && patience.wait()) continue;
    give_up(fmt::format(
        "is in use by {}, under another name of the same file (a hard link); wait until it ends or "
        "stop it. Reading it, as a report does, is possible meanwhile",
        holders.size() == 1 ? fmt::format("process {}", holders.front()) : "another process"));
  }
}

JournalLock::~JournalLock() {
  ::unlink(file_.c_str());
  ::close(fd_);
  if (itself_ >= 0) ::close(itself_);
}

bool JournalLock::is_in_place() const {
  struct stat opened {};
  struct stat present {};
  if (itself_ < 0 || ::fstat(itself_, &opened) != 0) return true;
  if (::stat(journal_.c_str(), &present) != 0) return errno != ENOENT && errno != ENOTDIR;
  return !is_local_ || (opened.st_ino == present.st_ino && opened.st_dev == present.st_dev);
}

std::optional<std::filesystem::path> JournalLock::moved_to() const {
  struct stat opened {};
  if (itself_ < 0 || ::fstat(itself_, &opened) != 0 || opened.st_nlink == 0) return std::nullopt;
  std::error_code none;
  const auto name = std::filesystem::read_symlink(fmt::format("/proc/self/fd/{}", itself_), none);
  struct stat present {};
  const bool is_it = !none && ::stat(name.c_str(), &present) == 0 &&
                     opened.st_ino == present.st_ino && opened.st_dev == present.st_dev;
  return is_it ? std::optional(name) : std::nullopt;
}

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
  const std::vector<int> holders = flock_holders(file.st_ino);
  // If no process holds the lock, the lock file was left behind by a killed process.
  if (std::find(holders.begin(), holders.end(), named->process) == holders.end())
    return std::nullopt;
  return JournalHolder{words, named->process};
}

}  // namespace latsch
