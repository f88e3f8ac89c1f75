// SPDX-License-Identifier: Apache-2.0
// Which samples of a recording count: windows of values, and the direction of a sweep.
//
//   "900 N .. 1200 N"      from, to; either may be missing: "30 s .."
//   "0 deg +- 0.3 deg"     about a value; "0 +- 0.3 deg": one unit for both
//   "rising", "falling"    between the turning points of a channel: where it goes back by more than
//                          5 % of its range; so neither noise nor the rate of samples matters
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace latsch::correlation {

struct Window {
  double from, to;  // SI
};

/// In the SI unit `unit`. Nothing where the text is no window; its second: why not.
std::pair<std::optional<Window>, std::string> parse_window(const std::string& text,
                                                           const std::string& unit);

/// Samples first .. end - 1.
struct Stretch {
  std::size_t first, end;
};
/// Where a recording goes on without a jump: no step of time is other than the usual one by more
/// than half. Without times all of it.
std::vector<Stretch> stretches_of(const std::vector<double>& time, std::size_t samples);

/// +1 where a channel rises, -1 where it falls, 0 where it does neither or has a gap.
std::vector<int> directions_of(const std::vector<double>& values,
                               const std::vector<Stretch>& stretches);

}  // namespace latsch::correlation
