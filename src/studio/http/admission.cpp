// SPDX-License-Identifier: Apache-2.0
#include "studio/http/admission.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/text.h"

namespace latsch::studio {
namespace {

constexpr std::size_t kShortestToken = 16;

constexpr std::string_view kTokenHint =
    "open the address that latsch printed when it started; scripts send \"Authorization: Bearer "
    "TOKEN\"";

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// Returns the host without its port: "127.0.0.1" for "127.0.0.1:8421", "[::1]" for "[::1]:8421";
/// nothing if the port is invalid.
std::string_view without_port(std::string_view host) {
  const std::size_t bracket = host.starts_with('[') ? host.find(']') : 0;
  if (bracket == host.npos) return {};
  const std::size_t colon = std::min(host.find(':', bracket), host.size());
  const std::string_view port = host.substr(std::min(colon + 1, host.size()));
  const bool is_number = port.find_first_not_of("0123456789") == port.npos && port.size() <= 5;
  return is_number ? host.substr(0, colon) : std::string_view{};
}

bool is_address(std::string_view host) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  if (host.starts_with('[') && host.ends_with(']'))
    return ::inet_pton(
               AF_INET6, std::string(host.substr(1, host.size() - 2)).c_str(), bytes.data()) == 1;
  return ::inet_pton(AF_INET, std::string(host).c_str(), bytes.data()) == 1;
}

/// Returns the values of all cookies with this name: another program on this machine may have set
/// one with the same name.
std::vector<std::string_view> cookies(std::string_view text, std::string_view name) {
  std::vector<std::string_view> values;
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find(';'));
    text.remove_prefix(std::min(pair.size() + 1, text.size()));
    const std::size_t equals = pair.find('=');
    if (equals != pair.npos && trimmed(pair.substr(0, equals)) == name)
      values.push_back(trimmed(pair.substr(equals + 1)));
  }
  return values;
}

bool is_opening_the_page(const Head& head) {
  return head.method == "GET" && head.fetch_mode == "navigate" &&
         (head.target == "/" || head.target.starts_with("/?"));
}

void check_token(std::string_view token) {
  constexpr std::string_view kCharacters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  if (token.size() < kShortestToken || token.find_first_not_of(kCharacters) != token.npos)
    throw InputError(
        fmt::format("the token has {} characters, expected {} or more of A-Z a-z 0-9 - _",
                    token.size(),
                    kShortestToken));
}

}  // namespace

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  while (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    if (errno != EINTR) throw InputError(std::string("no random numbers: ") + std::strerror(errno));
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

Admission::Admission(const std::string& listen,
                     std::uint16_t port,
                     std::string token,
                     const std::vector<std::string>& names)
    : token_(std::move(token)), cookie_name_(fmt::format("latsch_{}", port)) {
  check_token(token_);
  const std::string host = listen.find(':') == listen.npos ? listen : "[" + listen + "]";
  assert(is_address(host));
  hosts_ = {host, "localhost"};
  is_any_address_ = host == "0.0.0.0" || host == "[::]";
  if (host.starts_with("127.") || host == "[::1]") {
    hosts_.push_back("127.0.0.1");
    hosts_.push_back("[::1]");
  }
  for (const std::string& name : names) hosts_.push_back(lower_case(name));
}

std::optional<Refusal> Admission::refuse_stranger(const Head& head) const {
  if (head.hosts != 1 || !is_host(head.host))
    return Refusal{
        421,
        "the request is for the host " + in_quotes(head.host) + ", which is not this one",
        "open the address that latsch printed, or http://localhost behind a tunnel"};
  if (!head.origin.empty() && lower_case(head.origin) != "http://" + lower_case(head.host))
    return Refusal{
        403,
        "the request comes from a page of " + in_quotes(head.origin) + ", which is not this one",
        "only the studio's own page may send requests"};
  if ((head.fetch_site == "cross-site" || head.fetch_site == "same-site") &&
      !is_opening_the_page(head))
    return Refusal{
        403, "the request comes from another page", "only the studio's own page may send requests"};
  if (head.method != "GET" && head.method != "HEAD" && head.method != "POST")
    return Refusal{
        405, "the method " + in_quotes(head.method) + " is not known", "GET, HEAD or POST"};
  return {};
}

std::optional<Refusal> Admission::refuse_untrusted(const Head& head) const {
  if (!shows_token(head))
    return Refusal{401, "the request shows no token of this server", std::string(kTokenHint)};
  const std::string type =
      lower_case(trimmed(head.content_type.substr(0, head.content_type.find(';'))));
  if (head.method == "POST" && type != "application/json")
    return Refusal{415,
                   "the content is of type " + in_quotes(head.content_type),
                   "send JSON with \"Content-Type: application/json\""};
  return {};
}

bool Admission::is_host(std::string_view host) const {
  const std::string name = lower_case(without_port(host));
  if (std::find(hosts_.begin(), hosts_.end(), name) != hosts_.end()) return true;
  // A page whose DNS name was redirected to this machine sends this name as Host, not an address.
  return is_any_address_ && is_address(name);
}

bool Admission::shows_token(const Head& head) const {
  constexpr std::string_view kScheme = "bearer ";
  if (lower_case(head.authorization.substr(0, kScheme.size())) == kScheme)
    return is_token(trimmed(std::string_view(head.authorization).substr(kScheme.size())));
  const auto values = cookies(head.cookie, cookie_name_);
  return std::any_of(values.begin(), values.end(), [&](auto value) { return is_token(value); });
}

bool Admission::is_token(std::string_view text) const {
  if (text.size() != token_.size()) return false;
  volatile unsigned char difference = 0;
  for (std::size_t i = 0; i < token_.size(); ++i)
    difference = difference | static_cast<unsigned char>(text[i] ^ token_[i]);
  return difference == 0;
}

std::string Admission::cookie() const {
  return fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict", cookie_name_, token_);
}

}  // namespace latsch::studio
