// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/recorded_numbers.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace latsch::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers in memory are little-endian");

template <class Number>
void append_plain(const char* at,
                  std::size_t stride,
                  std::size_t count,
                  bool is_swapped,
                  std::vector<double>& numbers) {
  const std::size_t before = numbers.size();
  numbers.resize(before + count);
  double* to = numbers.data() + before;
  for (std::size_t i = 0; i < count; ++i) {
    char bytes[sizeof(Number)];
    std::memcpy(bytes, at + i * stride, sizeof(Number));
    if (is_swapped) std::reverse(bytes, bytes + sizeof(Number));
    Number number;
    std::memcpy(&number, bytes, sizeof(Number));
    to[i] = static_cast<double>(number);
  }
}

double integer_value(std::uint64_t bits, const RecordedKind& kind) {
  if (!kind.is_signed) return static_cast<double>(bits);
  const unsigned unused = 64 - 8 * kind.bytes;
  return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
}

}  // namespace

double half_precision(std::uint64_t bits) {
  const double sign = bits & 0x8000 ? -1.0 : 1.0;
  const int exponent = static_cast<int>(bits >> 10 & 0x1f);
  const double fraction = static_cast<double>(bits & 0x3ff);
  if (exponent == 0x1f) return fraction == 0.0 ? sign * INFINITY : std::nan("");
  if (exponent == 0) return sign * std::ldexp(fraction, -24);
  return sign * std::ldexp(1024.0 + fraction, exponent - 25);
}

std::uint64_t recorded_integer(const char* at, unsigned bytes, bool is_big_endian) {
  std::uint64_t value = 0;
  for (unsigned i = 0; i < bytes; ++i) {
    const unsigned place = is_big_endian ? bytes - 1 - i : i;
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(at[place])) << (8 * i);
  }
  return value;
}

void append_recorded(const char* at,
                     std::size_t stride,
                     std::size_t count,
                     const RecordedKind& kind,
                     std::vector<double>& numbers) {
  const bool swapped = kind.is_big_endian;
  const auto append = [&]<class Number>(Number) {
    append_plain<Number>(at, stride, count, swapped, numbers);
  };
  if (kind.is_real && kind.bytes == 8) return append(double());
  if (kind.is_real && kind.bytes == 4) return append(float());
  if (!kind.is_real && kind.bytes == 1)
    return kind.is_signed ? append(std::int8_t()) : append(std::uint8_t());
  if (!kind.is_real && kind.bytes == 2)
    return kind.is_signed ? append(std::int16_t()) : append(std::uint16_t());
  if (!kind.is_real && kind.bytes == 4)
    return kind.is_signed ? append(std::int32_t()) : append(std::uint32_t());
  if (!kind.is_real && kind.bytes == 8)
    return kind.is_signed ? append(std::int64_t()) : append(std::uint64_t());
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t bits = recorded_integer(at + i * stride, kind.bytes, swapped);
    numbers.push_back(kind.is_real ? half_precision(bits) : integer_value(bits, kind));
  }
}

}  // namespace latsch::formats
