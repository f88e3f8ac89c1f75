// SPDX-License-Identifier: Apache-2.0
// Decides which requests the studio's server accepts. The head of a request is checked in this
// order:
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

/// Fields of a request used by the decision; empty if absent.
struct Head {
  std::string method, target;
  int hosts = 0;  // number of fields called Host
  std::string host, origin, fetch_site, fetch_mode;
  std::string authorization, cookie;
  std::string content_type, accept, if_none_match;
};

struct Refusal {
  int status;
  std::string error, hint;
};

/// Returns 128 bits of the system's random numbers in hexadecimal.
std::string random_token();

class Admission {
 public:
  /// `listen` is a numerical address; `names` are further names of this machine in requests. Throws
  /// InputError if the token has fewer than 16 characters or others than A-Z a-z 0-9 - _.
  Admission(const std::string& listen,
            std::uint16_t port,
            std::string token,
            std::vector<std::string> names);

  /// Checks steps 1 to 4.
  std::optional<Refusal> refuse_stranger(const Head& head) const;
  /// Checks steps 5 and 6.
  std::optional<Refusal> refuse_untrusted(const Head& head) const;

  const std::string& token() const { return token_; }
  bool is_token(std::string_view text) const;
  /// Returns the value of Set-Cookie that the page keeps in place of the token.
  std::string cookie() const;

 private:
  bool is_host(std::string_view host) const;
  bool shows_token(const Head& head) const;

  std::string token_;
  std::string cookie_name_;
  std::vector<std::string> hosts_;  // in lower case, IPv6 addresses in brackets
  bool is_any_address_ = false;
};

}  // namespace latsch::studio
