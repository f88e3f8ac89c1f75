// SPDX-License-Identifier: Apache-2.0
// The end of a text of rows: whether the file was cut off within its last row. A whole file may end
// without a line end, so that alone says nothing; too few fields do, and fewer decimals than those
// of the rows above suggest it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include "measurement/ledger.h"

namespace latsch::formats {

/// Watches the rows of a text of separated values, of which the last cells suffice.
class CutEnd {
 public:
  /// `at` is the position behind the last row that was read.
  static bool lacks_line_end(std::string_view text, std::size_t at) {
    return at >= text.size() && !text.empty() && text.back() != '\n';
  }
  /// Takes the last cell of the next row.
  void take(std::string_view cell) {
    if (rows_ > 0) least_ = std::min(least_, last_);
    ++rows_;
    before_ = above_;
    above_ = last_;
    last_ = decimals(cell);
  }
  /// True if the last cell has fewer decimals than those of the two rows above it, which have
  /// equally many, or by far fewer than any of the rows above it.
  bool is_shortened() const {
    constexpr int kFewestRows = 4, kFar = 3;
    return (last_ < above_ && above_ == before_) ||
           (rows_ >= kFewestRows && last_ + kFar <= least_);
  }

 private:
  /// Returns the number of digits behind a point or comma.
  static int decimals(std::string_view cell) {
    const std::size_t mark = cell.find_first_of(".,");
    if (mark == cell.npos) return 0;
    const std::size_t end = cell.find_first_not_of("0123456789", mark + 1);
    return static_cast<int>(std::min(end, cell.size()) - mark - 1);
  }

  int last_ = 0, above_ = 0, before_ = 0;
  int least_ = std::numeric_limits<int>::max();  // fewest decimals above the last cell
  int rows_ = 0;
};

/// True if a text has no line end behind its last number and that number seems to lack digits. The
/// last ten lines are looked at, of which the cells are behind a comma, semicolon or tab.
inline bool ends_within_number(std::string_view text) {
  if (text.empty() || text.back() == '\n') return false;
  constexpr int kLines = 10;
  std::size_t begin = text.size();
  for (int i = 0; i < kLines && begin != text.npos && begin > 0; ++i)
    begin = text.rfind('\n', begin - 1);
  std::string_view rest = begin == text.npos ? text : text.substr(begin + 1);
  CutEnd end;
  while (!rest.empty()) {
    const std::size_t line_end = rest.find('\n');
    std::string_view line = rest.substr(0, line_end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const std::size_t wide = line.find_last_of(";\t");  // a comma is then that of a decimal number
    const auto cell = line.substr((wide != line.npos ? wide : line.find_last_of(',')) + 1);
    const std::size_t first = cell.find_first_not_of(" +-.");
    const bool is_number = first != cell.npos && cell[first] >= '0' && cell[first] <= '9';
    if (is_number) end.take(cell);  // a header is none
    rest = line_end == rest.npos ? std::string_view() : rest.substr(line_end + 1);
  }
  return end.is_shortened();
}

inline constexpr const char* kCutWithin = "the file is cut off within this line: ";

/// A row that lacks fields at the end of a file without a line end was left out.
inline LedgerDoubt doubt_of_cut_row(Place place) {
  return {"", "the file is cut off within this line, which is left out", std::move(place)};
}
/// The last number of a file without a line end may lack digits.
inline LedgerDoubt doubt_of_cut_number(Place place) {
  return {"",
          "the file ends without a line end, and its last number has fewer decimals than those "
          "above it: if the file is cut off, delete this line",
          std::move(place)};
}

}  // namespace latsch::formats
