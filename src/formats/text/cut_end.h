// SPDX-License-Identifier: Apache-2.0
// The end of a text of rows: whether the file was cut off within its last row. A whole file may end
// without a line end, so that alone says nothing; too few fields do, and fewer decimals than those
// of the rows above suggest it.
#pragma once

#include <algorithm>
#include <cstddef>
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
    before_ = above_;
    above_ = last_;
    last_ = decimals(cell);
  }
  /// True if the last cell has fewer decimals than those of the two rows above it, which have
  /// equally many.
  bool is_shortened() const { return last_ < above_ && above_ == before_; }

 private:
  /// Returns the number of digits behind a point or comma.
  static int decimals(std::string_view cell) {
    const std::size_t mark = cell.find_first_of(".,");
    if (mark == cell.npos) return 0;
    const std::size_t end = cell.find_first_not_of("0123456789", mark + 1);
    return static_cast<int>(std::min(end, cell.size()) - mark - 1);
  }

  int last_ = 0, above_ = 0, before_ = 0;
};

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
