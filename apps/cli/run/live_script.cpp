// SPDX-License-Identifier: Apache-2.0
#include "cli/run/live_script.h"

#include <zlib.h>

#include <cassert>
#include <string_view>

#include "web/web_assets.h"

namespace latsch::cli {
namespace {

/// Decompresses gzip data that the program contains [RFC 1952].
std::string unzipped(std::string_view bytes) {
  constexpr int kGzip = 15 + 16;
  z_stream stream{};
  if (inflateInit2(&stream, kGzip) != Z_OK) return "";
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string text;
  int state = Z_OK;
  while (state == Z_OK) {
    char part[65536];
    stream.next_out = reinterpret_cast<Bytef*>(part);
    stream.avail_out = sizeof part;
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(part, sizeof part - stream.avail_out);
  }
  assert(state == Z_STREAM_END);
  inflateEnd(&stream);
  return text;
}

}  // namespace

LiveScript live_script() {
  LiveScript live;
  for (const studio::Asset& asset : studio::web_assets()) {
    if (asset.path == "/report/report.js") live.script = unzipped(asset.body);
    if (asset.path == "/report/report.css") live.style = unzipped(asset.body);
  }
  return live;
}

}  // namespace latsch::cli
