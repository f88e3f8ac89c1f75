// SPDX-License-Identifier: Apache-2.0
// The studio's server: HTTP/1.1 and server-sent events for one person on this machine. It knows no
// studies: what is asked below /api goes to a handler, the page comes from memory, no file is read.
//
//   Server server({.port = 8421, .assets = page_assets()},
//                 [&](const Request& request) { return views.answer(request); });
//   fmt::print("{}\n", server.address());
//   server.publish("tires/a.toml", "trials", R"({"total": 12})");
//
// One thread has all sockets and answers itself what takes no time: refusals, the page, /events,
// and /api/ping. Handlers run in `threads` threads of their own, so a slow one delays no ping and
// no event, only further requests once all of them are busy.
//
// Who may ask is docs/studio.md, "Safety" (admission.h). What is refused is refused by its head:
// its body is not read. A browser has six connections to a host, one of them for each page's
// events.
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

/// A file of the page, in memory as long as the server. "/" is answered by the asset "/" or
/// "/index.html".
struct Asset {
  std::string path;  // "/index.html"
  std::string type;  // "text/html; charset=utf-8"
  std::string_view body;
  bool is_gzipped = false;
  std::string etag;  // with its quotes: "\"3f2a\""
};

/// What one client may take. Times are generous for a person's browser and short for what never
/// ends a request.
struct ServerLimits {
  std::size_t body = 1 << 20;     // bytes of a request's body
  std::size_t head = 16 << 10;    // bytes of its first line and fields
  std::size_t connections = 384;  // beyond: the slowest makes room for the newest
  std::size_t event_clients = 256;
  std::size_t waiting = 128;                 // requests that wait for a handler's thread
  std::size_t unread_events = 256 << 10;     // bytes a client of events may lag behind
  std::chrono::milliseconds request{8000};   // for head and body together, from the connection on
  std::chrono::milliseconds idle{60000};     // between two requests of a connection
  std::chrono::milliseconds stalled{15000};  // an answer of which nothing more is taken
  std::chrono::milliseconds alive{2000};     // between two `alive` events
};

struct ServerOptions {
  std::string listen = "127.0.0.1";  // an address of this machine; 0.0.0.0 or ::, all of them
  std::uint16_t port = 0;            // 0: a free one
  std::string token;                 // empty: 128 random bits; else 16 or more of A-Z a-z 0-9 - _
  int threads = 2;                   // of handlers
  std::vector<Asset> assets;         // empty: GET / says that there is no page
  std::vector<std::string> names;    // names of this machine that requests may name as well
  /// Told what a handler threw that is no InputError; the client is not. From any thread.
  std::function<void(std::string_view)> report;
  ServerLimits limits;
};

class Server {
 public:
  using Handler = std::function<Response(const Request&)>;

  /// Listens when it returns. The handler is called by several threads at once. An InputError it
  /// throws is answered with 400 and its text, anything else with 500 and no details.
  /// Throws InputError where it cannot listen there, and for a token that is none.
  Server(ServerOptions options, Handler handler);
  /// Ends all connections at once; waits for handlers that are under way, whose Request::stop it
  /// sets.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// "http://127.0.0.1:8421/?token=...", to be opened by a browser of this machine.
  std::string address() const;
  std::uint16_t port() const;
  const std::string& token() const;

  /// To the clients of /events?study=TOPIC; the topic "" is for all of them. From any thread, never
  /// blocks. A client that lags too far behind is disconnected: its page connects again and then
  /// asks for all that it shows.
  void publish(std::string_view topic, std::string_view event, std::string_view json);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::studio
