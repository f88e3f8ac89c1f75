// SPDX-License-Identifier: Apache-2.0
// Finds numbers of a recording that are no measured values: fillers that loggers write for a
// missing value, limits of an analog-digital converter, and a value at which a sensor saturates.
//
//   filler           999, 9999, 99999 ... with decimals (999.9), 8888 ..., 7777 ..., both signs;
//                    32767, 32768, 65535, 8388607, 2147483647 ... (integer limits); 1e30 or more
//   certain          the filler is farther from all other values than these are from each other
//                    and from 0, or far from its neighbors in time while the others change little
//   possible         the filler lies outside of the other values, or occurs in several samples
//                    while no other value repeats
//   repeated end     any largest or smallest value except 0 that occurs in three samples or more,
//                    far from all others, which do not repeat
//   saturation       a largest or smallest value in five successive samples or more, while no other
//                    value occurs in three; only for forces and moments
//
// The numbers are examined in the unit of the file, because fillers are round numbers only there.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace latsch {

/// A suspect number and the samples that have it.
struct FillerNumber {
  double number = 0.0;               // the number in the file
  std::vector<std::size_t> samples;  // in ascending order; never empty
  std::string reason;  // words that follow the number: "a usual filler for a missing value"
  bool is_certain = false;
};

/// Returns the suspect numbers of a channel with the values as written in its file; gaps are NaN.
/// `may_saturate` is true for a force or a moment.
std::vector<FillerNumber> filler_numbers(const std::vector<double>& written, bool may_saturate);

/// Returns ascending numbers in words: "12, 40 to 49, 73 and 5 more".
std::string runs_in_words(const std::vector<long>& numbers);

}  // namespace latsch
