// SPDX-License-Identifier: Apache-2.0
#include "base/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <vector>

#include "base/error.h"
#include "base/file.h"

namespace latsch {

namespace {

constexpr std::size_t kInMemory = 64u << 20;  // bytes
constexpr std::size_t kBlock = 1u << 20;      // number of bytes copied at once

bool is_same(const struct stat& a, const struct stat& b) {
  return a.st_ino == b.st_ino && a.st_size == b.st_size && a.st_mtim.tv_sec == b.st_mtim.tv_sec &&
         a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

struct Closing {
  int descriptor;
  ~Closing() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

[[noreturn]] void fail_changed(const std::filesystem::path& file) {
  throw InputError({file.string(), 0},
                   "changed while it was read: try again when the other program has finished "
                   "writing");
}

/// Opens a file without a name in the temporary folder; it vanishes when it is closed. Returns its
/// descriptor, or -1 if no such file can be made.
int nameless_file() {
  std::error_code none;
  const auto folder = std::filesystem::temp_directory_path(none);
  if (none) return -1;
  const int direct = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (direct >= 0) return direct;
  std::string name = (folder / "latsch.XXXXXX").string();
  const int named = ::mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

bool write_all(int to, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(to, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return true;
}

/// Copies a file into another. Returns the count of bytes; -1 if reading or writing failed.
off_t copy_all(int from, int to) {
  std::vector<char> block(kBlock);
  off_t copied = 0;
  for (;;) {
    const ssize_t read = ::read(from, block.data(), block.size());
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) return -1;
    if (read == 0) return copied;
    if (!write_all(to, block.data(), static_cast<std::size_t>(read))) return -1;
    copied += read;
  }
}

/// Copies the file to the temporary folder and maps the copy into memory. Returns nullptr if there
/// is no room for the copy. Throws if the file changes meanwhile.
void* map_copy(const std::filesystem::path& file, int descriptor, const struct stat& before) {
  const int copy = nameless_file();
  if (copy < 0) return nullptr;
  const off_t copied = copy_all(descriptor, copy);
  struct stat after {};
  const bool is_there = ::stat(file.c_str(), &after) == 0;
  const bool is_whole = is_there && is_same(before, after) && copied == before.st_size;
  void* mapping = MAP_FAILED;
  if (copied >= 0 && is_whole)
    mapping = ::mmap(nullptr, static_cast<std::size_t>(copied), PROT_READ, MAP_PRIVATE, copy, 0);
  ::close(copy);
  if (copied >= 0 && !is_whole) fail_changed(file);
  return mapping == MAP_FAILED ? nullptr : mapping;
}

}  // namespace

std::string read_settled_file(const std::filesystem::path& file, std::size_t limit) {
  struct stat before {
  }, after{};
  const bool is_regular = ::stat(file.c_str(), &before) == 0 && S_ISREG(before.st_mode);
  std::string text = read_text_file(file, limit);
  if (!is_regular) return text;
  const bool is_there = ::stat(file.c_str(), &after) == 0;
  // Files of the system, such as those in /proc, report size 0 although they have contents.
  const bool is_whole = before.st_size == 0 || static_cast<off_t>(text.size()) == before.st_size;
  if (!is_there || !is_same(before, after) || !is_whole) fail_changed(file);
  return text;
}

MappedFile::MappedFile(std::string text) : text_(std::move(text)), view_(text_) {}

MappedFile::MappedFile(const std::filesystem::path& file, std::size_t limit) {
  expect_no_pipe(file);
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const Closing closing{descriptor};
  struct stat about {};
  const bool regular =
      descriptor >= 0 && ::fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
  const auto size = static_cast<std::size_t>(regular ? about.st_size : 0);
  if (size > limit)
    throw InputError({file.string(), 0}, fmt::format("is larger than {} bytes", limit));
  if (size > kInMemory) mapping_ = map_copy(file, descriptor, about);
  if (mapping_) {
    note_read(descriptor);
    view_ = {static_cast<const char*>(mapping_), size};
    ::madvise(mapping_, size, MADV_SEQUENTIAL);
    return;
  }
  text_ = read_settled_file(file, limit);  // throws an InputError if the file cannot be read
  view_ = text_;
}

MappedFile::~MappedFile() {
  if (mapping_) ::munmap(mapping_, view_.size());
}

void MappedFile::let_go(std::size_t end) const {
  constexpr std::size_t kPages = 1u << 16;  // bytes; a multiple of every page size in use
  if (mapping_ && end >= kPages) ::madvise(mapping_, end / kPages * kPages, MADV_DONTNEED);
}

}  // namespace latsch
