// SPDX-License-Identifier: Apache-2.0
// The target of a request [RFC 9112, 3.2.1]: path and query, taken apart and decoded.
//
//   /api/study?study=tires%2Fa.toml&weights=force:2   ->   /api/study, study, weights
//
// Stricter than the standard, so that a path means one thing only: no segment "." or "..", no
// backslash, no control characters, also behind percent signs, and each name of the query once. In
// the query a plus is a blank, as forms and URLSearchParams write it.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace latsch::studio {

struct Target {
  std::string path;
  std::map<std::string, std::string> query;
};

/// Throws InputError that says what is wrong with it.
Target parse_target(std::string_view target);

}  // namespace latsch::studio
