// SPDX-License-Identifier: Apache-2.0
// An answer as bytes: status line, the safety fields of every answer, body.
//
//   Content-Security-Policy        scripts, styles, pictures, data from this server only, no frame
//                                  around it. What scripts set by element.style is allowed, as
//                                  Svelte and uPlot do, style attributes in text are not
//   X-Content-Type-Options         a type is what it is said to be
//   Referrer-Policy                the first address has the token: it is told to nobody
//   Cross-Origin-Resource-Policy   other pages may not embed what is answered
//   Cache-Control                  what was computed is not kept; the page's files are asked for
//                                  again by their ETag
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "studio/http/message.h"
#include "studio/http/server.h"

namespace latsch::studio {

struct Answer {
  int status = 200;
  std::string type;
  std::string body;        // body from a handler, unless `asset` is set
  std::string_view asset;  // kept in memory as long as the server
  std::string fields;      // further fields: "Location: /\r\n"
  bool has_length = true;  // false: the body ends with the connection
  bool has_body = true;    // false for HEAD and 304

  std::string_view text() const { return asset.empty() ? std::string_view(body) : asset; }
};

Answer answer_of(Response response);
/// Returns 304 if `if_none_match` [RFC 9110, 13.1.2] contains the asset's etag.
Answer answer_of(const Asset& asset, std::string_view if_none_match);

/// Returns status line and fields, with the empty line after them.
std::string head_text(const Answer& answer, bool keep_alive);

}  // namespace latsch::studio
