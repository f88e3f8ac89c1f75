// SPDX-License-Identifier: Apache-2.0
#include "base/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"

namespace latsch {

namespace {

constexpr std::size_t kInMemory = 64u << 20;  // bytes

bool is_same(const struct stat& a, const struct stat& b) {
  return a.st_ino == b.st_ino && a.st_size == b.st_size &&
         a.st_mtim.tv_sec == b.st_mtim.tv_sec && a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

}  // namespace

std::string read_settled_file(const std::filesystem::path& file, std::size_t limit) {
  struct stat before {}, after {};
  const bool is_regular = ::stat(file.c_str(), &before) == 0 && S_ISREG(before.st_mode);
  std::string text = read_text_file(file, limit);
  if (!is_regular) return text;
  const bool is_there = ::stat(file.c_str(), &after) == 0;
  // Files of the system (/proc) report size 0.
  const bool is_whole = before.st_size == 0 || static_cast<off_t>(text.size()) == before.st_size;
  if (!is_there || !is_same(before, after) || !is_whole)
    throw InputError({file.string(), 0},
                     "changed while it was read: try again when whoever writes it is done");
  return text;
}

MappedFile::MappedFile(std::string text) : text_(std::move(text)), view_(text_) {}

MappedFile::MappedFile(const std::filesystem::path& file, std::size_t limit) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat about {};
  const bool regular =
      descriptor >= 0 && ::fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
  const auto size = static_cast<std::size_t>(regular ? about.st_size : 0);
  if (size > kInMemory && size <= limit) {
    void* mapping = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (mapping != MAP_FAILED) {
      mapping_ = mapping;
      view_ = {static_cast<const char*>(mapping), size};
      ::madvise(mapping, size, MADV_SEQUENTIAL);
    }
  }
  if (descriptor >= 0) ::close(descriptor);
  if (size > limit)
    throw InputError({file.string(), 0}, fmt::format("is larger than {} bytes", limit));
  if (mapping_) return;
  text_ = read_settled_file(file, limit);  // or throws the reason
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
