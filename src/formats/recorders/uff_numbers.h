// SPDX-License-Identifier: Apache-2.0
// The numbers of a universal file's data set 58: their layout in lines and in bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::formats {

/// Kind of numbers of a data set 58: what stands for each sample.
struct UffLayout {
  bool is_double = false, is_complex = false, is_even = true;
  /// Numbers for each sample: abscissa if uneven, value, imaginary part if complex.
  std::size_t per_sample() const {
    return std::size_t{1} + (is_complex ? 1 : 0) + (is_even ? 0 : 1);
  }
  /// Widths of the fields of a whole line, in characters.
  std::vector<std::size_t> widths() const;
};

/// Appends the numbers of a line, at most `most`. Fields are separated by blanks or have the widths
/// of the layout. Returns false if the line is neither.
bool take_uff_line(std::string_view line,
                   const std::vector<std::size_t>& widths,
                   std::size_t most,
                   std::vector<double>& numbers);

/// Returns the binary numbers of `samples` samples. If the abscissa of a double precision function
/// has 4 bytes, `has_short_abscissa` is true. `bytes` must be long enough.
std::vector<double> uff_binary(std::string_view bytes,
                               const UffLayout& layout,
                               std::size_t samples,
                               bool is_big_endian,
                               bool has_short_abscissa);
/// Returns the number of bytes of a sample.
std::size_t uff_sample_bytes(const UffLayout& layout, bool has_short_abscissa);

}  // namespace latsch::formats
