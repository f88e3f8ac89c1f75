// SPDX-License-Identifier: Apache-2.0
// Holds a text file of any size as one text. A file of up to 64 MB is read into memory. A larger
// one is copied into a nameless file of the temporary folder, and the copy is mapped into memory:
// the system loads its pages on access and can release them afterwards. Nobody else can shorten the
// copy, so a reader never gets SIGBUS from a file that ends earlier than expected. A file that
// changes while it is copied is refused. If the file is not a regular one, or the copy does not fit
// into the temporary folder, the text is read into memory.
//
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace latsch {

/// Returns the whole file. Throws InputError as read_text_file does, and if the file changes while
/// it is read, because half of the text would be old.
std::string read_settled_file(const std::filesystem::path& file, std::size_t limit);

class MappedFile {
 public:
  /// Throws InputError naming the path and the reason: the file is missing, is a folder or a pipe,
  /// may not be read, is larger than the limit, or changed while it was read.
  MappedFile(const std::filesystem::path& file, std::size_t limit);
  /// Holds a text that is in memory already.
  explicit MappedFile(std::string text);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view text() const { return view_; }
  /// Releases the pages before `end`, which are not needed for now; they are read again on access.
  void let_go(std::size_t end) const;

 private:
  std::string text_;
  void* mapping_ = nullptr;
  std::string_view view_;
};

}  // namespace latsch
