// SPDX-License-Identifier: Apache-2.0
// Decides which requests the studio's server accepts. The head of a request is checked in this
// order:
//
//   1 Host names this machine    DNS rebinding: a page whose own name was redirected to 127.0.0.1
//                                still sends its name. Another port is allowed: tunnels have one
//   2 Origin, if present, is     other pages of this machine count as the same site, so
//     the same host and port     SameSite cookies do not keep them out
//   3 Sec-Fetch-Site             protects requests without Origin (scripts, pictures) likewise;
//                                opening "/" from elsewhere is allowed
//   4 GET, HEAD, POST            no CORS: a preflight (OPTIONS) is answered without permission
//   5 the token                  Bearer for scripts; for the page a cookie, HttpOnly and
//                                SameSite=Strict, whose name contains the port because browsers
//                                send cookies to every port
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

/// The fields of a request that the decision uses; empty if absent.
struct Head {
  std::string method, target;
  int hosts = 0;  // number of header fields named Host
  std::string host, origin, fetch_site, fetch_mode;
  std::string authorization, cookie;
  std::string content_type, accept, if_none_match;
};

struct Refusal {
  int status;
  std::string error, hint;
};

/// Returns 128 random bits from the system as hexadecimal text.
std::string random_token();

class Admission {
 public:
  /// `listen` is a numerical address; `names` are further names of this machine that requests may
  /// use. Throws InputError if the token has fewer than 16 characters or others than A-Z a-z 0-9 -
  /// _.
  Admission(const std::string& listen,
            std::uint16_t port,
            std::string token,
            const std::vector<std::string>& names);

  /// Applies checks 1 to 4 of the list above. Returns the refusal; nullopt if the request passes.
  std::optional<Refusal> refuse_stranger(const Head& head) const;
  /// Applies checks 5 and 6 of the list above. Returns the refusal; nullopt if the request passes.
  std::optional<Refusal> refuse_untrusted(const Head& head) const;

  const std::string& token() const { return token_; }
  bool is_token(std::string_view text) const;
  /// Returns the value of the header Set-Cookie by which the page keeps its permission after the
  /// token is removed from its address.
  std::string cookie() const;

 private:
  bool is_host(std::string_view host) const;
  bool shows_token(const Head& head) const;

  std::string token_;
  std::string cookie_name_;
  std::vector<std::string> hosts_;  // lower case; IPv6 addresses in brackets
  bool is_any_address_ = false;
};

}  // namespace latsch::studio
