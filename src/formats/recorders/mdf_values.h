// SPDX-License-Identifier: Apache-2.0
// Numbers in the records of an MDF 4 file: where their bits are, and the rule that turns them into
// quantities.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/recorders/mdf_blocks.h"

namespace latsch::formats {

/// Bits of a number in each record.
struct MdfField {
  bool is_big_endian = false, is_signed = false, is_real = false;
  std::size_t byte = 0;  // in the record
  unsigned bit = 0;      // first bit in the lowest byte, 0 to 7
  unsigned bits = 0;     // 1 to 64; of a real number 16, 32 or 64
  /// Number of bytes that hold the bits.
  std::size_t bytes() const { return (bit + bits + 7) / 8; }
};

/// Returns the numbers of `count` records of `record` bytes. The field must be inside the record.
std::vector<double> mdf_numbers(std::string_view records,
                                std::size_t record,
                                std::size_t count,
                                const MdfField& field);

/// Rule of conversion of a channel, block CC.
struct MdfRule {
  int type = 0;                // 0 none, 1 linear, 2 rational, 4 and 5 tables, 6 ranges
  std::vector<double> values;  // parameters in the order of the block
  std::string fault;           // why the numbers cannot be converted, to follow the name
};

/// Reads a rule; none if the position is 0. Throws InputError for a rule with too few parameters.
MdfRule mdf_rule(const MdfBlocks& blocks, std::uint64_t position);
/// Converts numbers. A division by 0 gives NaN.
void convert_mdf(const MdfRule& rule, bool is_integer, std::vector<double>& values);

}  // namespace latsch::formats
