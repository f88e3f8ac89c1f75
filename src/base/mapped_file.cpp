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

MappedFile::MappedFile(std::string text) : text_(std::move(text)), view_(text_) {}

MappedFile::MappedFile(const std::filesystem::path& file, std::size_t limit) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat about {};
  const bool regular =
      descriptor >= 0 && ::fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
  const auto size = static_cast<std::size_t>(regular ? about.st_size : 0);
  if (size > 0 && size <= limit) {
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
  text_ = read_text_file(file, limit);  // or it says why not
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
