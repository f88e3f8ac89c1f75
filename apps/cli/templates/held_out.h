// SPDX-License-Identifier: Apache-2.0
// The part of a tire test that is held out of the fit and predicted: whole recordings, or samples
// selected by a condition.
// `latsch new --hold-out run_12.dat`, `--hold-out "p = 90 kPa .. 104 kPa"`.
//
// Coefficients are freed by what the fitted samples vary, not by what the record holds: a third
// pressure that is held out tells the fit nothing of a quadratic term.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace latsch::cli {

/// Windows by channel, as the key `select` of a measurement takes them. Empty: every sample.
using Select = std::map<std::string, std::vector<std::string>>;

struct HeldOut {
  std::vector<std::filesystem::path> files;
  std::string channel;               // empty: whole recordings are held out
  std::vector<std::string> windows;  // windows of the channel, as the user wrote them

  bool is_empty() const { return files.empty() && channel.empty(); }
};

/// InputError if recordings and conditions are mixed, or conditions of two channels.
HeldOut held_out_of(const std::vector<std::string>& given);

/// The windows that hold every value that lies in none of the given ones; both in `unit`.
/// InputError if a window cannot be read.
std::vector<std::string> windows_outside(const std::vector<std::string>& windows,
                                         const std::string& unit);

/// ", select = {p = [".. 9e4 Pa"]}", or "".
std::string select_text(const Select& select);

}  // namespace latsch::cli
