// SPDX-License-Identifier: Apache-2.0
// Selects the part of a tire test that is predicted instead of fitted: whole recordings, or samples
// that fulfill a condition. `latsch new --hold-out run_12.dat`, `--hold-out "p = 90 kPa .. 104
// kPa"`.
//
// Only the fitted samples decide whether a coefficient is a variable: a third pressure that is held
// out gives the fit no information about a quadratic term.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace latsch::cli {

/// Ranges of values by channel, in the form of the key `select` of a measurement. Empty: every
/// sample is selected.
using Select = std::map<std::string, std::vector<std::string>>;

struct HeldOut {
  std::vector<std::filesystem::path> files;
  std::string channel;  // channel of the condition; empty: whole recordings are held out
  /// held-out ranges of a channel's values, as the user wrote them
  std::vector<std::string> windows;

  bool is_empty() const { return files.empty() && channel.empty(); }
};

/// Interprets the values of --hold-out. Throws InputError if they mix recordings and conditions or
/// have conditions on two channels.
HeldOut held_out_of(const std::vector<std::string>& given);

/// Returns ranges that together contain exactly the values outside of all given ranges; both in
/// `unit`. Throws InputError if a range cannot be read.
std::vector<std::string> windows_outside(const std::vector<std::string>& windows,
                                         const std::string& unit);

/// Returns the selection of samples as text for a study file, ", select = {p = [\".. 9e4 Pa\"]}",
/// or "" if it is empty.
std::string select_text(const Select& select);

}  // namespace latsch::cli
