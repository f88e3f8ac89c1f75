// SPDX-License-Identifier: Apache-2.0
// Reading of files by the C++ library alone, for systems without POSIX: a unit reads a few small
// files and writes none. A path is opened by its wide characters.
#include <fmt/format.h>

#include <fstream>

#include "base/error.h"
#include "base/file.h"
#include "base/mapped_file.h"

namespace latsch {

std::string read_text_file(const std::filesystem::path& file, std::size_t limit) {
  const auto place = [&] {
    const std::u8string name = file.u8string();
    return Place{std::string(name.begin(), name.end()), 0};
  };
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(place(), "cannot be opened");
  std::string text;
  std::string block(1 << 16, '\0');
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block, 0, static_cast<std::size_t>(in.gcount()));
    if (text.size() > limit)
      throw InputError(place(), fmt::format("is larger than {} bytes", limit));
  }
  if (in.bad()) throw InputError(place(), "cannot be read");
  return text;
}

MappedFile::MappedFile(const std::filesystem::path& file, std::size_t limit)
    : text_(read_text_file(file, limit)), view_(text_) {}
MappedFile::MappedFile(std::string text) : text_(std::move(text)), view_(text_) {}
MappedFile::~MappedFile() = default;
void MappedFile::let_go(std::size_t) const {}

}  // namespace latsch
