// SPDX-License-Identifier: Apache-2.0
// Requests and answers as the studio sees them, independent of HTTP.
#pragma once

#include <map>
#include <stop_token>
#include <string>
#include <string_view>

namespace latsch::studio {

/// A request. All texts are decoded and valid UTF-8 without zero bytes; the path has no segment "."
/// or "..". The body of a POST is declared as JSON, but the handler has to check that it is.
struct Request {
  std::string method;  // GET or POST; a HEAD request is passed on as GET
  std::string path;
  std::map<std::string, std::string> query;
  std::string body;
  /// Set when the server ends: a long handler may then throw or return any answer.
  std::stop_token stop;
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
};

/// Returns the text as a JSON string with quotes [RFC 8259, 7]; bytes that are not valid UTF-8 are
/// replaced.
std::string json_string(std::string_view text);

/// Returns an answer with the status and the JSON object {"error": ..., "hint": ...}.
Response error_response(int status, std::string_view error, std::string_view hint);

}  // namespace latsch::studio
