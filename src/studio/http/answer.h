// SPDX-License-Identifier: Apache-2.0
// An HTTP answer as bytes: status line, the safety fields that every answer has, body.
//
//   Content-Security-Policy        scripts, styles, pictures and data may come from this server
//                                  only, and no other page may frame this one. Scripts may set
//                                  element.style, as Svelte and uPlot do; style attributes in the
//                                  HTML text are not allowed
//   X-Content-Type-Options         browsers must not guess another content type
//   Referrer-Policy                no address is passed on, because the first one has the token
//   Cross-Origin-Resource-Policy   other pages may not embed the answer
//   Cache-Control                  computed answers are not cached; the files of the page are
//                                  requested again with their ETag
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
  std::string body;        // body that a handler computed, unless `asset` is set
  std::string_view asset;  // points to a file of the page that is in memory as long as the server
  std::string fields;      // further header fields: "Location: /\r\n"
  bool has_length = true;  // false: the end of the connection marks the end of the body
  bool has_body = true;    // false for HEAD and for status 304

  std::string_view text() const { return asset.empty() ? std::string_view(body) : asset; }
};

Answer answer_of(Response response);
/// Returns the answer with a file of the page; status 304 if `if_none_match` [RFC 9110, 13.1.2]
/// contains its ETag.
Answer answer_of(const Asset& asset, std::string_view if_none_match);

/// Returns status line and header fields, with the empty line after them.
std::string head_text(const Answer& answer, bool keep_alive);

}  // namespace latsch::studio
