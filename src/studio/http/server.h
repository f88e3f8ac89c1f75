// SPDX-License-Identifier: Apache-2.0
// The studio's HTTP server: HTTP/1.1 and server-sent events for one person on this machine. It
// knows nothing about studies: requests below /api go to a handler, the page is in memory, no file
// is read.
//
//   Server server({.port = 8421, .assets = page_assets()},
//                 [&](const Request& request) { return views.answer(request); });
//   fmt::print("{}\n", server.address());
//   server.publish("tires/a.toml", "trials", R"({"total": 12})");
//
// One thread owns all sockets and itself answers requests that take no time: refusals, the page,
// /events, and /api/ping. Handlers run in `threads` other threads, so a slow handler delays no ping
// and no event, and delays further requests only if all these threads are busy.
//
// docs/studio.md, "Safety", says who may send requests (admission.h). A refused request is refused
// after its head, and its body is not read. A browser opens six connections to a host; each page
// uses one of them for its events.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "studio/http/message.h"

namespace latsch::studio {

/// A file of the page, in memory as long as the server. The file "/" or "/index.html" answers
/// requests for "/".
struct Asset {
  std::string path;  // "/index.html"
  std::string type;  // "text/html; charset=utf-8"
  std::string_view body;
  bool is_gzipped = false;
  std::string etag;  // with quotes: "\"3f2a\""
};

/// Limits for one client. The times are generous for a person's browser and short for a client that
/// never ends a request.
struct ServerLimits {
  std::size_t body = 1 << 20;   // bytes; body of a request
  std::size_t head = 16 << 10;  // bytes; first line and header fields of a request
  /// number of connections; beyond it the slowest is closed for a new one
  std::size_t connections = 384;
  std::size_t event_clients = 256;
  std::size_t waiting = 128;              // number of requests that wait for a handler's thread
  std::size_t unread_events = 256 << 10;  // bytes of events by which a client may lag behind
  /// Time for head and body together, from the start of the connection or of the request.
  std::chrono::milliseconds request{8000};
  std::chrono::milliseconds idle{60000};     // time between two requests on one connection
  std::chrono::milliseconds stalled{15000};  // time without progress in sending an answer
  std::chrono::milliseconds alive{2000};     // interval of the event `alive`
};

struct ServerOptions {
  /// an address of this machine; "0.0.0.0" or "::" means all of its addresses
  std::string listen = "127.0.0.1";
  std::uint16_t port = 0;  // 0: any free port
  /// access token: at least 16 characters of A-Z a-z 0-9 - _; empty: 128 random bits are used
  std::string token;
  int threads = 2;                 // number of handler threads
  std::vector<Asset> assets;       // files of the page; empty: GET / answers that there is no page
  std::vector<std::string> names;  // further names of this machine that requests may use as Host
  /// Called with the text of an exception of a handler, except InputError, from any thread; the
  /// client gets no details.
  std::function<void(std::string_view)> report;
  ServerLimits limits;
};

class Server {
 public:
  using Handler = std::function<Response(const Request&)>;

  /// Starts the server, which listens when the constructor returns. Several threads call the
  /// handler at once. An InputError of the handler is answered with status 400 and its text, any
  /// other exception with 500 and no details. Throws InputError if it cannot listen at the address,
  /// and for an invalid token.
  Server(ServerOptions options, Handler handler);
  /// Closes all connections at once, sets Request::stop of running handlers, and waits for them.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Returns the URL with its token, "http://127.0.0.1:8421/?token=...", to be opened by a browser
  /// on this machine.
  std::string address() const;
  std::uint16_t port() const;
  const std::string& token() const;

  /// Sends an event to the clients of /events?study=TOPIC; the topic "" reaches all clients. May be
  /// called by any thread and never blocks. A client that lags too far behind is disconnected: its
  /// page connects again and requests everything that it shows.
  void publish(std::string_view topic, std::string_view event, std::string_view json);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::studio
