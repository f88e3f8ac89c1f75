// SPDX-License-Identifier: Apache-2.0
// Selects the part of a tire test that is not fitted but predicted: whole recordings, or samples
// that fulfill a condition. `latsch new --hold-out run_12.dat`, `--hold-out "p = 90 kPa .. 104
// kPa"`.
//
// Only the fitted samples decide if a coefficient is freed: a third pressure that is held out
// gives the fit no information on a quadratic term.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace latsch::cli {

/// Windows by channel, in the form of the key `select` of a measurement. Empty: every sample.
using Select = std::map<std::string, std::vector<std::string>>;

struct HeldOut {
  std::vector<std::filesystem::path> files;
  std::string channel;               // empty: whole recordings are held out
  std::vector<std::string> windows;  // windows of the channel, as the user wrote them

  bool is_empty() const { return files.empty() && channel.empty(); }
};

/// Throws InputError if recordings and conditions are mixed, or if conditions are on two channels.
HeldOut held_out_of(const std::vector<std::string>& given);

/// Returns windows that contain exactly the values outside of all given windows; both in `unit`.
/// Throws InputError if a window cannot be read.
std::vector<std::string> windows_outside(const std::vector<std::string>& windows,
                                         const std::string& unit);

/// Returns ", select = {p = [".. 9e4 Pa"]}", or "".
std::string select_text(const Select& select);

}  // namespace latsch::cli
