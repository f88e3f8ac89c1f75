// SPDX-License-Identifier: Apache-2.0
#include "formats/recorders/mdf_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "formats/recorders/recorded_numbers.h"

namespace latsch::formats {
namespace {

constexpr unsigned kByte = 8;  // bits

/// Returns the bits of the field in a record as an unsigned integer.
std::uint64_t bits_of(const char* record, const MdfField& field) {
  const std::size_t bytes = field.bytes();
  const auto* at = reinterpret_cast<const unsigned char*>(record + field.byte);
  std::uint64_t low = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(bytes, kByte); ++i)
    low |= static_cast<std::uint64_t>(field.is_big_endian ? at[bytes - 1 - i] : at[i])
           << (kByte * i);
  low >>= field.bit;
  if (bytes > sizeof(low)) {  // 64 bits that begin within a byte end in the ninth
    const std::uint64_t last = field.is_big_endian ? at[0] : at[kByte];
    low |= last << (64 - field.bit);
  }
  return field.bits == 64 ? low : low & ((std::uint64_t{1} << field.bits) - 1);
}

double value_of(std::uint64_t bits, const MdfField& field) {
  if (field.is_real) {
    if (field.bits == 64) return std::bit_cast<double>(bits);
    if (field.bits == 32)
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    return half_precision(bits);
  }
  if (!field.is_signed) return static_cast<double>(bits);
  const unsigned unused = 64 - field.bits;
  return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
}

/// Returns the value of the table at x: between two keys by interpolation, or that of the nearest
/// key, the lower one of two equally near.
double table_value(const std::vector<double>& table, double x, bool interpolates) {
  const std::size_t rows = table.size() / 2;
  if (std::isnan(x)) return x;
  std::size_t low = 0, high = rows;  // the first row whose key is above x
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (table[2 * middle] > x) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  if (low == 0) return table[1];
  if (low == rows) return table[2 * rows - 1];
  const double x0 = table[2 * low - 2], y0 = table[2 * low - 1];
  const double x1 = table[2 * low], y1 = table[2 * low + 1];
  if (!interpolates) return x - x0 <= x1 - x ? y0 : y1;
  return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
}

/// Returns the value of the range that contains x; whole numbers belong to a range up to its upper
/// end, others below it.
double range_value(const std::vector<double>& ranges, double x, bool is_integer) {
  for (std::size_t i = 0; i + 2 < ranges.size(); i += 3)
    if (x >= ranges[i] && (x < ranges[i + 1] || (is_integer && x == ranges[i + 1])))
      return ranges[i + 2];
  return ranges.back();
}

}  // namespace

std::vector<double> mdf_numbers(std::string_view records,
                                std::size_t record,
                                std::size_t count,
                                const MdfField& field) {
  std::vector<double> values;
  values.reserve(count);
  if (field.bit == 0 && field.bits % kByte == 0) {
    append_recorded(records.data() + field.byte,
                    record,
                    count,
                    {field.bits / kByte, field.is_real, field.is_signed, field.is_big_endian},
                    values);
    return values;
  }
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(value_of(bits_of(records.data() + i * record, field), field));
  return values;
}

MdfRule mdf_rule(const MdfBlocks& blocks, std::uint64_t position) {
  MdfRule rule;
  if (position == 0) return rule;
  const MdfBlock block = blocks.at(position, "CC");
  constexpr std::size_t kHead = 24;
  rule.type = block.number<std::uint8_t>(0);
  if (rule.type == 0) return rule;
  if (rule.type == 3 || rule.type > 6) {
    rule.fault = rule.type == 3 ? "is converted by a formula"
                 : rule.type > 6 && rule.type <= 11
                     ? "is converted to texts"
                     : fmt::format("is converted by rule {}, which is unknown", rule.type);
    return rule;
  }
  const std::size_t count = block.number<std::uint16_t>(6);
  if (block.data().size() < kHead || count > (block.data().size() - kHead) / sizeof(double))
    block.fail(fmt::format("states {} parameters in {} bytes", count, block.data().size()));
  for (std::size_t i = 0; i < count; ++i)
    rule.values.push_back(block.number<double>(kHead + i * sizeof(double)));
  const std::size_t least = rule.type == 2 ? 6 : rule.type == 6 ? 1 : 2;
  if (count < least)
    block.fail(fmt::format("has {} parameters, expected {} or more", count, least));
  if (rule.type == 4 || rule.type == 5)
    for (std::size_t i = 2; i + 1 < count; i += 2)
      if (!(rule.values[i] > rule.values[i - 2])) block.fail("has a table whose keys do not rise");
  return rule;
}

void convert_mdf(const MdfRule& rule, bool is_integer, std::vector<double>& values) {
  const std::vector<double>& p = rule.values;
  for (double& x : values) {
    switch (rule.type) {
      case 1:
        x = p[1] * x + p[0];
        break;
      case 2: {
        const double below = (p[3] * x + p[4]) * x + p[5];
        x = below == 0.0 ? std::nan("") : ((p[0] * x + p[1]) * x + p[2]) / below;
        break;
      }
      case 4:
      case 5:
        x = table_value(p, x, rule.type == 4);
        break;
      case 6:
        x = range_value(p, x, is_integer);
        break;
      default:
        return;
    }
  }
}

}  // namespace latsch::formats
