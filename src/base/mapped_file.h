// SPDX-License-Identifier: Apache-2.0
// A text file of any size as one text. A file of up to 64 MB is read into memory. A larger one is
// copied into a nameless file of the temporary folder, which is mapped: its pages come from there
// when they are read and can be let go afterwards. Nobody can cut that copy, so that a reader never
// meets the end of a file that somebody else shortened (SIGBUS). A file that changes before it is
// copied is refused. What is no regular file, or finds no room there, is read into memory.
//
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace latsch {

/// The whole file. Throws InputError as read_text_file does, and where the file changes while it is
/// read: half of it would be of the old one.
std::string read_settled_file(const std::filesystem::path& file, std::size_t limit);

class MappedFile {
 public:
  /// Throws InputError naming the path and the reason: missing, a folder, no permission, over the
  /// limit, changed while it was read.
  MappedFile(const std::filesystem::path& file, std::size_t limit);
  /// A text that is in memory already.
  explicit MappedFile(std::string text);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view text() const { return view_; }
  /// What lies before `end` is not needed for now; it comes back where it is read again.
  void let_go(std::size_t end) const;

 private:
  std::string text_;
  void* mapping_ = nullptr;
  std::string_view view_;
};

}  // namespace latsch
