// SPDX-License-Identifier: Apache-2.0
// Selects samples of a recording by ranges of values and by the direction of a sweep.
//
//   "900 N .. 1200 N"      from, to; either may be missing: "30 s .."
//   "0 deg +- 0.3 deg"     about a value; "0 +- 0.3 deg": one unit for both
//   "rising", "falling"    between the turning points of a channel; a turning point is where it
//                          goes back by more than 5 % of its range, so neither noise nor the
//                          sampling rate matters
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace latsch::correlation {

struct Window {
  double from, to;  // SI
};

/// Parses a range in the SI unit `unit`. If the text is no range, the first member is empty and the
/// second says why.
std::pair<std::optional<Window>, std::string> parse_window(const std::string& text,
                                                           const std::string& unit);

/// The successive samples first .. end - 1.
struct Stretch {
  std::size_t first, end;
};
/// Returns the stretches without a jump of time: each step differs from the usual one by at most
/// half. Without times, all samples are one stretch.
std::vector<Stretch> stretches_of(const std::vector<double>& time, std::size_t samples);

/// Returns +1 if a channel rises, -1 if it falls, 0 if it does neither or has a gap, for each
/// sample.
std::vector<int> directions_of(const std::vector<double>& values,
                               const std::vector<Stretch>& stretches);

}  // namespace latsch::correlation
