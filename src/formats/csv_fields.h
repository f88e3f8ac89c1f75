// SPDX-License-Identifier: Apache-2.0
// The characters of a separated-value file as rows of fields [RFC 4180, with comments].
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::formats {

class CsvFields {
 public:
  struct Row {
    int line = 0;
    std::vector<std::string_view> cells;  // without quotes; blanks around unquoted fields removed
  };
  /// What the fields point into.
  struct Source {
    std::string text;
    std::deque<std::string> unquoted;  // fields that held doubled quotes
  };

  /// Throws InputError over the limit and for a zero byte.
  CsvFields(std::string text, std::string file, std::size_t limit);

  /// ';', tab or ',': the first of them that stands outside of quotes in the first row.
  char separator() const { return separator_; }
  /// The next row that is neither empty nor a comment; false at the end. Throws InputError for a
  /// quote that is not closed or followed by more text and for more than 10,000 fields.
  bool next(Row& row);
  std::shared_ptr<const Source> source() const { return source_; }

 private:
  void skip_line();
  bool skip_to_row();
  char find_separator() const;
  std::string_view quoted_field();
  std::string_view plain_field();

  std::string file_;
  std::shared_ptr<Source> source_;
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  char separator_ = ',';
};

}  // namespace latsch::formats
