// SPDX-License-Identifier: Apache-2.0
// Finds the columns of a file that may be a channel that is needed but that no column names. A
// message lists all of them, because a missing slip angle or longitudinal slip is assumed to be 0.
//
//   missing   columns that may be it
//   any       a column of an unknown name whose unit has the dimension of the channel; a column
//             whose name contains that of the channel ("tan alpha", "|SA|"); a column with the
//             channel's name that was stated to be another channel; the channel of one wheel
//             (alpha_FL)
//   alpha     also a plain number of an unknown name whose values are like those of a slip, such
//             as tan alpha or Vy / Vx
//   alpha     also toe and steer, which are the slip angle on a rig that turns the wheel; and Vy
//             with Vx, from which it can be computed
//   kappa     also SL, the slip of the loaded radius; and omega with Vx, from which it can be
//             computed
//
// A name that contains another channel's ("tan alpha") is not offered for a third one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace latsch {

/// A column of the file in which a channel is missing.
struct OtherColumn {
  std::string name;       // in the file
  std::string unit = {};  // SI unit of the values; empty: unknown
  bool has_unit = false;  // false if the file and its reader know no unit
  std::string taken_as = {};
  bool is_used = false;
  /// true for numbers without a unit that have both signs and magnitudes below 1.5, so that the
  /// channel may be a tangent
  bool is_slip_like = false;
};

/// A column that may be a missing channel.
struct MayBe {
  std::string column;  // in the file
  std::string words;   // words that follow the name: "a steer angle"; empty: nothing more is known
  bool is_as_it_stands = true;  // false if the channel has to be computed from the column
  bool has_its_name = false;    // true if the column's name contains that of the channel
};

/// Returns the columns that may be the missing channel `channel`, whose SI unit is `unit`: first
/// those whose name contains that of the channel, last those from which the channel has to be
/// computed, each in the order of the file.
std::vector<MayBe> columns_that_may_be(std::string_view channel,
                                       std::string_view unit,
                                       const std::vector<OtherColumn>& columns);

/// Returns "`steer` (a steer angle), `channel 7`", at most `most` of them and the number of others.
std::string list_in_words(const std::vector<MayBe>& columns, std::size_t most);

}  // namespace latsch
