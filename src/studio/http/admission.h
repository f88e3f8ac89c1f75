// SPDX-License-Identifier: Apache-2.0
// Who may ask the studio's server, judged by the head of a request and in this order:
//
//   1 Host names this machine    a page whose own name was turned to 127.0.0.1 (DNS rebinding)
//                                still sends its name; another port is a tunnel's and all right
//   2 Origin, where named, is    other pages of this machine are of the same site, so SameSite
//     the same host and port     keeps nothing from them
//   3 Sec-Fetch-Site             the same for what sends no Origin (scripts, pictures); to open
//                                "/" from elsewhere is all right
//   4 GET, HEAD, POST            no CORS: a preflight (OPTIONS) is answered without permission
//   5 the token                  Bearer for scripts; for the page a cookie, HttpOnly and
//                                SameSite=Strict, named by port since cookies know no ports
//   6 JSON for POST              no form can send it without a preflight
//
// [Fetch Metadata, https://www.w3.org/TR/fetch-metadata/]. Tokens are compared in a time that does
// not depend on where they differ.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::studio {

/// Fields of a request that decide; empty where there are none.
struct Head {
  std::string method, target;
  int hosts = 0;  // fields called Host
  std::string host, origin, fetch_site, fetch_mode;
  std::string authorization, cookie;
  std::string content_type, accept, if_none_match;
};

struct Refusal {
  int status;
  std::string error, hint;
};

/// 128 bits of the system's random numbers in hexadecimal.
std::string random_token();

class Admission {
 public:
  /// `listen`: a numerical address; `names`: others by which requests may call this machine.
  /// Throws InputError where the token has fewer than 16 characters or others than A-Z a-z 0-9 - _.
  Admission(const std::string& listen,
            std::uint16_t port,
            std::string token,
            std::vector<std::string> names);

  /// Steps 1 to 4.
  std::optional<Refusal> refuse_stranger(const Head& head) const;
  /// Steps 5 and 6.
  std::optional<Refusal> refuse_untrusted(const Head& head) const;

  const std::string& token() const { return token_; }
  bool is_token(std::string_view text) const;
  /// What the page keeps in place of the token: the value of Set-Cookie.
  std::string cookie() const;

 private:
  bool is_host(std::string_view host) const;
  bool shows_token(const Head& head) const;

  std::string token_;
  std::string cookie_name_;
  std::vector<std::string> hosts_;  // in lower case, addresses of IPv6 in brackets
  bool is_any_address_ = false;
};

}  // namespace latsch::studio
