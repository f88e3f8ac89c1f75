// SPDX-License-Identifier: Apache-2.0
// Splits the characters of a separated-value file into rows of fields [RFC 4180, with comments].
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/mapped_file.h"

namespace latsch::formats {

class CsvFields {
 public:
  struct Row {
    int line = 0;
    std::vector<std::string_view> cells;  // without quotes; blanks around unquoted fields removed
  };
  /// A position between two rows at which reading can continue.
  struct Mark {
    std::size_t at = 0;
    int line = 1;
  };

  /// Creates the reader without copying the text, which must be UTF-8 (text_encoding.h).
  CsvFields(std::shared_ptr<const MappedFile> source, std::string file);

  /// Returns ';', tab or ',': the first of them that is outside of quotes in the first row.
  char separator() const { return separator_; }
  /// Reads the next row that is neither empty nor a comment; returns false at the end of the text.
  /// Throws InputError for a quote that is not closed or has text after it, and for more than
  /// 10,000 fields. The cells are valid until the next call.
  bool next(Row& row);
  /// Returns the position of the next row; go_to() continues there.
  Mark mark() const { return {at_, line_}; }
  void go_to(const Mark& mark);

 private:
  void skip_line();
  bool skip_to_row();
  char find_separator() const;
  std::string_view quoted_field();
  std::string_view plain_field();

  std::string file_;
  std::shared_ptr<const MappedFile> source_;
  /// fields of this row that contained doubled quotes, with single ones
  std::deque<std::string> unquoted_;
  std::string_view text_;
  std::size_t let_go_ = 0;  // bytes at the beginning of the text that need not stay in memory
  std::size_t at_ = 0;
  int line_ = 1;
  char separator_ = ',';
};

}  // namespace latsch::formats
