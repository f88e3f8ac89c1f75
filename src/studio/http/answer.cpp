// SPDX-License-Identifier: Apache-2.0
#include "studio/http/answer.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <ctime>
#include <utility>

#include "base/text.h"

namespace latsch::studio {
namespace {

constexpr std::string_view kSafety =
    "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; "
    "connect-src 'self'; img-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Cross-Origin-Opener-Policy: same-origin\r\n";

std::string_view words(int status) {
  constexpr std::array<std::pair<int, std::string_view>, 22> kWords = {{
      {200, "OK"},
      {201, "Created"},
      {202, "Accepted"},
      {204, "No Content"},
      {303, "See Other"},
      {304, "Not Modified"},
      {400, "Bad Request"},
      {401, "Unauthorized"},
      {403, "Forbidden"},
      {404, "Not Found"},
      {405, "Method Not Allowed"},
      {408, "Request Timeout"},
      {409, "Conflict"},
      {413, "Content Too Large"},
      {415, "Unsupported Media Type"},
      {421, "Misdirected Request"},
      {422, "Unprocessable Content"},
      {429, "Too Many Requests"},
      {431, "Request Header Fields Too Large"},
      {500, "Internal Server Error"},
      {501, "Not Implemented"},
      {503, "Service Unavailable"},
  }};
  for (const auto& [code, text] : kWords)
    if (code == status) return text;
  return "Other";
}

/// Returns the time as "Sun, 06 Nov 1994 08:49:37 GMT" [RFC 9110, 5.6.7], in English for any
/// locale.
std::string date(std::time_t now) {
  constexpr const char* kDays[] = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  constexpr const char* kMonths[] = {
      "Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  std::tm t{};
  ::gmtime_r(&now, &t);
  return fmt::format("{}, {:02} {} {} {:02}:{:02}:{:02} GMT",
                     kDays[t.tm_wday],
                     t.tm_mday,
                     kMonths[t.tm_mon],
                     t.tm_year + 1900,
                     t.tm_hour,
                     t.tm_min,
                     t.tm_sec);
}

/// True if the list of entity tags, with or without "W/", contains this one or is "*".
bool has_tag(std::string_view list, std::string_view etag) {
  if (trimmed(list) == "*") return true;
  while (!list.empty()) {
    std::string_view tag = list.substr(0, list.find(','));
    list.remove_prefix(std::min(tag.size() + 1, list.size()));
    tag = trimmed(tag);
    if (tag.starts_with("W/")) tag.remove_prefix(2);
    if (tag == etag) return true;
  }
  return false;
}

[[maybe_unused]] bool is_one_line(std::string_view text) {
  return text.find_first_of("\r\n") == text.npos;
}

}  // namespace

Answer answer_of(Response response) {
  Answer answer;
  answer.status = response.status;
  answer.type = std::move(response.type);
  answer.body = std::move(response.body);
  answer.fields = "Cache-Control: no-store\r\n";
  return answer;
}

Answer answer_of(const Asset& asset, std::string_view if_none_match) {
  assert(is_one_line(asset.etag));
  Answer answer;
  answer.type = asset.type;
  answer.asset = asset.body;
  answer.fields = "Cache-Control: no-cache\r\n";
  if (asset.is_gzipped) answer.fields += "Content-Encoding: gzip\r\n";
  if (asset.etag.empty()) return answer;
  answer.fields += "ETag: " + asset.etag + "\r\n";
  if (has_tag(if_none_match, asset.etag)) {
    answer.status = 304;
    answer.has_body = false;
  }
  return answer;
}

std::string head_text(const Answer& answer, bool keep_alive) {
  assert(is_one_line(answer.type));
  std::string head = fmt::format("HTTP/1.1 {} {}\r\nDate: {}\r\n",
                                 answer.status,
                                 words(answer.status),
                                 date(std::time(nullptr)));
  head += kSafety;
  head += answer.fields;
  if (!answer.type.empty()) head += "Content-Type: " + answer.type + "\r\n";
  if (answer.has_length) head += fmt::format("Content-Length: {}\r\n", answer.text().size());
  head += keep_alive ? "Connection: keep-alive\r\n\r\n" : "Connection: close\r\n\r\n";
  return head;
}

}  // namespace latsch::studio
