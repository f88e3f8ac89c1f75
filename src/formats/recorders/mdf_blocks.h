// SPDX-License-Identifier: Apache-2.0
// The blocks of an MDF 4 file: an identifier, a length, links to other blocks, and data. Every
// position and length is compared with the file before it is used.
#pragma once

#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <string_view>

namespace latsch::formats {

class MdfBlocks;

/// A block inside the file.
class MdfBlock {
 public:
  std::string_view id() const { return id_; }  // "DG"
  std::uint64_t at() const { return at_; }
  std::size_t link_count() const { return links_.size() / sizeof(std::uint64_t); }
  /// Returns the position of a linked block; 0 if there is none.
  std::uint64_t link(std::size_t index) const;
  std::string_view data() const { return data_; }
  /// Returns a number of the data, in the byte order of the file. Throws InputError if the block is
  /// too short.
  template <class Number>
  Number number(std::size_t offset) const {
    Number value;
    std::memcpy(&value, bytes_at(offset, sizeof(Number)), sizeof(Number));
    return value;
  }
  /// Throws InputError that names the block.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  friend class MdfBlocks;
  const char* bytes_at(std::size_t offset, std::size_t size) const;

  const std::string* file_ = nullptr;
  std::string_view id_, links_, data_;
  std::uint64_t at_ = 0;
};

class MdfBlocks {
 public:
  MdfBlocks(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  /// Returns the block at a position. The block of data at the end of an unfinished file may state
  /// any length: `may_be_open` gives it the rest of the file.
  MdfBlock at(std::uint64_t position, bool may_be_open = false) const;
  /// Returns the block, which must have one of these identifiers of two letters, "DTDV".
  MdfBlock at(std::uint64_t position, std::string_view ids) const;
  /// Returns the text of a TX block, or of the element TX of an MD block; empty if the position is
  /// 0.
  std::string text(std::uint64_t position) const;
  std::string_view bytes() const { return bytes_; }
  const std::string& file() const { return file_; }

 private:
  std::string_view bytes_;
  const std::string& file_;
};

/// Notices a chain of blocks that returns to itself.
class MdfChain {
 public:
  /// Throws InputError if the chain was here before.
  void visit(const MdfBlock& block);

 private:
  std::set<std::uint64_t> seen_;
};

}  // namespace latsch::formats
