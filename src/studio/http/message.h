// SPDX-License-Identifier: Apache-2.0
// Requests and answers of the studio, without the bytes of HTTP around them.
#pragma once

#include <map>
#include <stop_token>
#include <string>
#include <string_view>

namespace latsch::studio {

/// All texts are decoded, valid UTF-8 without zeros; the path has no segment "." or "..". The body
/// of a POST is declared as JSON, which the handler has to check.
struct Request {
  std::string method;  // GET or POST; HEAD is passed as GET
  std::string path;
  std::map<std::string, std::string> query;
  std::string body;
  /// set when the server ends: a long handler may then throw or answer anything
  std::stop_token stop;
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
};

/// Returns the text in quotes, escaped [RFC 8259, 7]; bytes that are no UTF-8 are replaced.
std::string json_string(std::string_view text);

/// Returns {"error": ..., "hint": ...}.
Response error_response(int status, std::string_view error, std::string_view hint);

}  // namespace latsch::studio
