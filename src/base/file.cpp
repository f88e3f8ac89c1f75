// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <mutex>
#include <optional>
#include <ostream>
#include <set>
#include <streambuf>
#include <utility>

#include "base/error.h"

namespace latsch {
namespace {

/// An open file that its destructor closes.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  int number() const { return number_; }
  bool close() {
    const int number = number_;
    number_ = -1;
    return ::close(number) == 0;
  }

 private:
  int number_;
};

/// The files that this process has read, by device and number of the file system, without those
/// that it has written itself.
class ReadFiles {
 public:
  void protect() {
    const std::lock_guard lock(mutex_);
    is_on_ = true;
  }
  void note_read(const struct stat& file) {
    const std::lock_guard lock(mutex_);
    if (S_ISREG(file.st_mode) && !written_.contains(key(file))) read_.insert(key(file));
  }
  void note_written(const struct stat& file) {
    const std::lock_guard lock(mutex_);
    written_.insert(key(file));
    read_.erase(key(file));
  }
  bool refuses(const struct stat& file) {
    const std::lock_guard lock(mutex_);
    return is_on_ && read_.contains(key(file));
  }

 private:
  using Key = std::pair<dev_t, ino_t>;
  static Key key(const struct stat& file) { return {file.st_dev, file.st_ino}; }

  std::mutex mutex_;
  bool is_on_ = false;
  std::set<Key> read_, written_;
};

ReadFiles& read_files() {
  static ReadFiles files;
  return files;
}

[[noreturn]] void fail(const std::filesystem::path& file, const char* what, int error) {
  throw InputError({file.string(), 0}, fmt::format("{}: {}", what, std::strerror(error)));
}

/// While an object of this class lives, a write(2) into a pipe without a reader returns an error
/// instead of ending the program.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    ::sigemptyset(&pipe_);
    ::sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    ::sigpending(&pending);
    was_pending_ = ::sigismember(&pending, SIGPIPE) == 1;
    ::pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    const timespec no_time{};
    const int error = errno;
    if (!was_pending_) ::sigtimedwait(&pipe_, nullptr, &no_time);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = error;
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  sigset_t pipe_, before_;
  bool was_pending_ = false;
};

/// Returns 0, or the errno of the error.
int write_all(int descriptor, std::string_view text) {
  const NoPipeSignal quiet;
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(written);
      // Another program may have made this process's output non-blocking.
    } else if (errno == EAGAIN) {
      pollfd room{descriptor, POLLOUT, 0};
      ::poll(&room, 1, -1);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

/// Stream buffer that writes into an open file. It remembers the first error.
class FileBuffer : public std::streambuf {
 public:
  explicit FileBuffer(int descriptor) : descriptor_(descriptor) { start_again(); }

  /// Returns 0, or the errno of the first error.
  int finish() {
    sync();
    return error_;
  }

 protected:
  int sync() override {
    if (error_ == 0) {
      error_ = write_all(descriptor_, {pbase(), static_cast<std::size_t>(pptr() - pbase())});
    }
    start_again();
    return error_ == 0 ? 0 : -1;
  }
  int_type overflow(int_type character) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(character, traits_type::eof())) {
      sputc(traits_type::to_char_type(character));
    }
    return traits_type::not_eof(character);
  }

 private:
  void start_again() { setp(block_.data(), block_.data() + block_.size()); }

  int descriptor_;
  int error_ = 0;
  std::array<char, 1 << 16> block_;
};

using Write = std::function<void(std::ostream&)>;

/// Returns 0, or the errno of the error. Throws what `write` throws.
int write_into(int descriptor, const Write& write) {
  FileBuffer buffer(descriptor);
  std::ostream out(&buffer);
  write(out);
  return buffer.finish();
}

/// The new name must survive a power loss as well as the data. It is no error if a file system
/// cannot flush a folder: the file is complete either way.
void flush_folder(const std::filesystem::path& folder) {
  const Descriptor open(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC));
  if (open.number() >= 0) (void)::fsync(open.number());
}

constexpr const char* kNotWritten = "cannot be written";
constexpr int kMostLinks = 40;  // largest number of links followed; that of the system

/// Follows a chain of symbolic links and returns the file at its end, which need not exist. Returns
/// nullopt if the chain leads through /proc to an open file, because the name of such a link
/// identifies no file.
std::optional<std::filesystem::path> followed(std::filesystem::path file) {
  const std::filesystem::path asked = file;
  for (int links = 0; links <= kMostLinks; ++links) {
    std::error_code none;
    const std::filesystem::path next = std::filesystem::read_symlink(file, none);
    if (none) return file;
    const auto folder = std::filesystem::canonical(
        file.has_parent_path() ? file.parent_path() : std::filesystem::path("."), none);
    if (folder.string().starts_with("/proc/")) return std::nullopt;
    file = file.parent_path() / next;
  }
  fail(asked, kNotWritten, ELOOP);
}

bool is_open_as(int descriptor, const struct stat& file) {
  struct stat open {};
  return ::fstat(descriptor, &open) == 0 && open.st_dev == file.st_dev &&
         open.st_ino == file.st_ino && (::fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY;
}

/// Writes into something that cannot be replaced: a device, a pipe, an open file.
void write_through(const std::filesystem::path& file, Descriptor open, const Write& write) {
  if (open.number() < 0) fail(file, kNotWritten, errno);
  if (const int error = write_into(open.number(), write)) fail(file, kNotWritten, error);
  // A device that cannot be flushed reports EINVAL, EROFS or ENOTSUP.
  if (::fsync(open.number()) != 0 && errno != EINVAL && errno != EROFS && errno != ENOTSUP) {
    fail(file, kNotWritten, errno);
  }
  if (!open.close()) fail(file, kNotWritten, errno);
}

/// Creates a new file beside `file` under a name that is not in use.
Descriptor open_beside(const std::filesystem::path& file, std::string& name) {
  for (int i = 0;; ++i) {
    name = fmt::format("{}.{}.{}.tmp", file.string(), ::getpid(), i);
    const int open = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (open >= 0 || errno != EEXIST) return Descriptor(open);
  }
}

void write_in_place(const std::filesystem::path& file, const Write& write) {
  write_through(file, Descriptor(::open(file.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC)), write);
}

/// `target` is the file itself, even if `file` is a link; `before` is its earlier state, nullptr if
/// it did not exist.
void replace(const std::filesystem::path& file,
             const std::filesystem::path& target,
             const struct stat* before,
             const Write& write) {
  // A write-protected file is not replaced, even if its folder allows it.
  if (before && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) {
    fail(file, kNotWritten, errno);
  }
  std::string temporary;
  Descriptor open = open_beside(target, temporary);
  if (open.number() < 0) {
    if (before && (errno == EACCES || errno == EPERM)) return write_in_place(target, write);
    fail(file, kNotWritten, errno);
  }
  const auto give_up = [&](int error) {
    ::unlink(temporary.c_str());
    fail(file, kNotWritten, error);
  };
  try {
    if (const int error = write_into(open.number(), write)) give_up(error);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  if (before) {
    // Only root can set another owner of a file; for other users the new file belongs to
    // themselves.
    if (::fchown(open.number(), before->st_uid, before->st_gid) != 0) errno = 0;
    if (::fchmod(open.number(), before->st_mode & 07777) != 0) give_up(errno);
  }
  if (::fsync(open.number()) != 0 || !open.close()) give_up(errno);
  if (::rename(temporary.c_str(), target.c_str()) != 0) {
    const int error = errno;
    // A file that is a mount point itself, as in containers, cannot be replaced.
    if (error != EBUSY || !before) give_up(error);
    ::unlink(temporary.c_str());
    return write_in_place(target, write);
  }
  flush_folder(target.parent_path());
}

/// True for a database of SQLite, by its first bytes.
bool is_database(const std::filesystem::path& file) {
  constexpr std::string_view kFirst = "SQLite format 3";
  std::array<char, kFirst.size()> first{};
  std::ifstream there(file, std::ios::binary);
  there.read(first.data(), std::ssize(first));
  return std::string_view(first.data(), first.size()) == kFirst;
}

void write_to_path(const std::filesystem::path& file, const Write& write) {
  struct stat there {};
  if (::stat(file.c_str(), &there) != 0) {
    if (errno != ENOENT) fail(file, kNotWritten, errno);
    const auto target = followed(file);
    if (!target) fail(file, kNotWritten, ENOENT);
    return replace(file, *target, nullptr, write);
  }
  if (S_ISDIR(there.st_mode)) {
    throw InputError({file.string(), 0}, "is a folder, expected a file to write");
  }
  if (S_ISBLK(there.st_mode)) {
    throw InputError({file.string(), 0}, "is a disk (a block device), expected a file to write");
  }
  if (read_files().refuses(there))
    throw InputError({file.string(), 0},
                     "is read by this command, which would replace it by its output: expected "
                     "another name for the output");
  if (S_ISREG(there.st_mode) && is_database(file))
    throw InputError(
        {file.string(), 0},
        "is a database, such as a journal of trials, which no output replaces: expected "
        "another name for the output");
  std::fflush(stdout);  // earlier output must precede the text of the file
  for (const int printed : {STDOUT_FILENO, STDERR_FILENO}) {
    if (is_open_as(printed, there)) return write_through(file, Descriptor(::dup(printed)), write);
  }
  const auto target = followed(file);
  if (target && S_ISREG(there.st_mode)) return replace(file, *target, &there, write);
  write_through(file, Descriptor(::open(file.c_str(), O_WRONLY | O_CLOEXEC)), write);
}

}  // namespace

void expect_file(const std::filesystem::path& file) {
  struct stat there {};
  if (::stat(file.c_str(), &there) != 0) fail(file, "cannot be opened", errno);
  if (S_ISDIR(there.st_mode))
    throw InputError({file.string(), 0}, "is a folder, expected a file in it");
  expect_no_pipe(file);
}

void expect_no_pipe(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  if (!std::filesystem::is_fifo(status) && !std::filesystem::is_socket(status)) return;
  throw InputError({file.string(), 0},
                   "is a pipe, which can be read only once; expected a file: write what comes "
                   "through the pipe into one");
}

std::string read_text_file(const std::filesystem::path& file, std::size_t limit) {
  expect_no_pipe(file);
  const Descriptor open(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (open.number() < 0) fail(file, "cannot be opened", errno);
  note_read(open.number());
  std::string text;
  for (;;) {
    char block[1 << 16];
    const ssize_t read = ::read(open.number(), block, sizeof(block));
    if (read < 0 && errno == EINTR) continue;
    if (read < 0 && errno == EISDIR) {
      throw InputError({file.string(), 0}, "is a folder, expected a file in it");
    }
    if (read < 0) fail(file, "cannot be read", errno);
    if (read == 0) return text;
    text.append(block, read);
    if (text.size() > limit)
      throw InputError({file.string(), 0}, fmt::format("is larger than {} bytes", limit));
  }
}

void protect_read_files() { read_files().protect(); }

void note_read(int descriptor) {
  struct stat about {};
  if (::fstat(descriptor, &about) == 0) read_files().note_read(about);
}

void allow_to_replace(const std::filesystem::path& file) {
  struct stat about {};
  if (::stat(file.c_str(), &about) == 0) read_files().note_written(about);
}

void write_file(const std::filesystem::path& file, const Write& write) {
  write_to_path(file, write);
  allow_to_replace(file);
}

void write_text_file(const std::filesystem::path& file, std::string_view text) {
  write_file(file, [&](std::ostream& out) { out.write(text.data(), std::ssize(text)); });
}

void move_file(const std::filesystem::path& file, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::rename(file, to, error);
  if (error) {
    throw InputError({file.string(), 0},
                     "cannot be renamed to " + to.string() + ": " + error.message());
  }
}

}  // namespace latsch
