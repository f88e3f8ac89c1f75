// SPDX-License-Identifier: Apache-2.0
// Parses and decodes the target of a request [RFC 9112, 3.2.1]: path and query.
//
//   /api/study?study=tires%2Fa.toml&weights=force:2   ->   /api/study, study, weights
//
// The parser is stricter than the standard, so that a path has only one meaning: no segment "." or
// "..", no backslash, no control characters, not even percent-encoded, and each name of the query
// only once. In the query a plus is a blank, as forms and URLSearchParams write it.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace latsch::studio {

struct Target {
  std::string path;
  std::map<std::string, std::string> query;
};

/// Throws InputError that states the error in the target.
Target parse_target(std::string_view target);

}  // namespace latsch::studio
