// SPDX-License-Identifier: Apache-2.0
// The studio's server: HTTP/1.1 and server-sent events for one person on this machine. It knows no
// studies: requests below /api go to a handler, the page comes from memory, no file is read.
//
//   Server server({.port = 8421, .assets = page_assets()},
//                 [&](const Request& request) { return views.answer(request); });
//   fmt::print("{}\n", server.address());
//   server.publish("tires/a.toml", "trials", R"({"total": 12})");
//
// One thread owns all sockets and itself answers requests that take no time: refusals, the page,
// /events, and /api/ping. Handlers run in `threads` threads of their own, so a slow handler delays
// no ping and no event, and delays further requests only once all threads are busy.
//
// docs/studio.md, "Safety", says who may send requests (admission.h). A request is refused by its
// head, and its body is not read. A browser has six connections to a host, one of them for each
// page's events.
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

/// A file of the page, in memory as long as the server. The asset "/" or "/index.html" answers "/".
struct Asset {
  std::string path;  // "/index.html"
  std::string type;  // "text/html; charset=utf-8"
  std::string_view body;
  bool is_gzipped = false;
  std::string etag;  // with quotes: "\"3f2a\""
};

/// Limits for one client. Times are generous for a person's browser and short for a client that
/// never ends a request.
struct ServerLimits {
  std::size_t body = 1 << 20;     // bytes of a request's body
  std::size_t head = 16 << 10;    // bytes of a request's first line and fields
  std::size_t connections = 384;  // with more, the slowest makes room for the newest
  std::size_t event_clients = 256;
  std::size_t waiting = 128;              // requests waiting for a handler's thread
  std::size_t unread_events = 256 << 10;  // bytes by which a client of events may lag behind
  /// for head and body together, from the start of the connection
  std::chrono::milliseconds request{8000};
  std::chrono::milliseconds idle{60000};     // between two requests of a connection
  std::chrono::milliseconds stalled{15000};  // time in which an answer makes no progress
  std::chrono::milliseconds alive{2000};     // between two `alive` events
};

struct ServerOptions {
  std::string listen = "127.0.0.1";  // an address of this machine; 0.0.0.0 or ::, all addresses
  std::uint16_t port = 0;            // 0: any free port
  /// empty: 128 random bits; otherwise 16 or more of A-Z a-z 0-9 - _
  std::string token;
  int threads = 2;                 // number of handler threads
  std::vector<Asset> assets;       // empty: GET / reports that there is no page
  std::vector<std::string> names;  // further names of this machine accepted in requests
  /// Receives exceptions of a handler other than InputError; the client receives no details. Called
  /// by any thread.
  std::function<void(std::string_view)> report;
  ServerLimits limits;
};

class Server {
 public:
  using Handler = std::function<Response(const Request&)>;

  /// Listens when it returns. Several threads call the handler at once. An InputError of the
  /// handler is answered with 400 and its text, anything else with 500 and no details. Throws
  /// InputError if it cannot listen there, and for an invalid token.
  Server(ServerOptions options, Handler handler);
  /// Ends all connections at once, sets Request::stop of running handlers, and waits for these.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Returns "http://127.0.0.1:8421/?token=...", to be opened by a browser of this machine.
  std::string address() const;
  std::uint16_t port() const;
  const std::string& token() const;

  /// Sends an event to the clients of /events?study=TOPIC; the topic "" reaches all clients. May be
  /// called by any thread and never blocks. A client that lags too far behind is disconnected: its
  /// page connects again and requests everything it shows.
  void publish(std::string_view topic, std::string_view event, std::string_view json);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::studio
