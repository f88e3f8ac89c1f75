// SPDX-License-Identifier: Apache-2.0
// A share in a file: an error, a noise. It is written "3 %" or 0.03.
#pragma once

#include <string>

#include "base/document.h"

namespace latsch::correlation {

/// Returns the share that `key` states. `unit` is "1", or the SI unit of the value if the key also
/// accepts an absolute value. Throws InputError for a number without a unit above 1: `largest_error
/// = 3` usually means 3 %, and `noise = 20` usually means 20 N.
double read_share(const Node& table,
                  const std::string& key,
                  Range range,
                  const std::string& unit = "1");

/// Throws InputError if the share of the key was written without a unit and is above 1.
void expect_stated_share(const Node& table,
                         const std::string& key,
                         const std::string& written,
                         double share,
                         const std::string& unit = "1");

/// True for a text such as "80 %".
bool is_percentage(const Node& table, const std::string& key);

}  // namespace latsch::correlation
