// SPDX-License-Identifier: Apache-2.0
// Numbers of whole bytes in a file: integers and floating-point numbers in both byte orders.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace latsch::formats {

/// Kind of a number of 1 to 8 bytes.
struct RecordedKind {
  unsigned bytes = 8;  // floating-point numbers have 2, 4 or 8
  bool is_real = true, is_signed = true, is_big_endian = false;
};

/// Appends `count` numbers, of which the first is at `at` and each further one `stride` bytes
/// behind the one before. All must be inside the file. Integers above 2^53 are rounded.
void append_recorded(const char* at,
                     std::size_t stride,
                     std::size_t count,
                     const RecordedKind& kind,
                     std::vector<double>& numbers);

/// Returns the value of a half-precision number [IEEE 754-2008, binary16].
double half_precision(std::uint64_t bits);

/// Returns the unsigned integer at a position of at most 8 bytes, which must be inside the file.
std::uint64_t recorded_integer(const char* at, unsigned bytes, bool is_big_endian);

}  // namespace latsch::formats
