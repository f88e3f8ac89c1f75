// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace latsch {
namespace {

/// An open file that is closed on every way out.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  bool close() {
    const int number = number_;
    number_ = -1;
    return ::close(number) == 0;
  }

 private:
  int number_;
};

[[noreturn]] void fail(const std::filesystem::path& file, const char* what, int error) {
  throw InputError({file.string(), 0}, fmt::format("{}: {}", what, std::strerror(error)));
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(written);
  }
  return true;
}

/// The new name must survive a power loss as well as the data. A file system that cannot flush a
/// folder is none of the caller's concern: the file is complete either way.
void flush_folder(const std::filesystem::path& folder) {
  const Descriptor open(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC));
  if (open.number() >= 0) (void)::fsync(open.number());
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file, std::size_t limit) {
  const Descriptor open(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (open.number() < 0) fail(file, "cannot be opened", errno);
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

void write_text_file(const std::filesystem::path& file, std::string_view text) {
  const std::string temporary = file.string() + fmt::format(".{}.tmp", ::getpid());
  const auto give_up = [&](int error) {
    ::unlink(temporary.c_str());
    fail(file, "cannot be written", error);
  };
  Descriptor open(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (open.number() < 0) fail(file, "cannot be written", errno);
  if (!write_all(open.number(), text) || ::fsync(open.number()) != 0) give_up(errno);
  if (!open.close()) give_up(errno);
  if (::rename(temporary.c_str(), file.c_str()) != 0) give_up(errno);
  flush_folder(file.parent_path());
}

}  // namespace latsch
