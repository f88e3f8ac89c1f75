// SPDX-License-Identifier: Apache-2.0
// What the studio is asked and answers, without the bytes of HTTP around it.
#pragma once

#include <map>
#include <stop_token>
#include <string>
#include <string_view>

namespace latsch::studio {

/// Decoded, valid UTF-8 without zeros; the path has no segment "." or "..". The body of a POST is
/// said to be JSON, which the handler has to check.
struct Request {
  std::string method;  // GET or POST; HEAD comes as GET
  std::string path;
  std::map<std::string, std::string> query;
  std::string body;
  std::stop_token stop;  // the server ends: a long handler may throw or answer anything
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
};

/// In quotes, escaped [RFC 8259, 7]; bytes that are no UTF-8 are replaced.
std::string json_string(std::string_view text);

/// {"error": ..., "hint": ...}
Response error_response(int status, std::string_view error, std::string_view hint);

}  // namespace latsch::studio
