// SPDX-License-Identifier: Apache-2.0
// Accepts connections, judges requests and passes them on; connection.h and event_client.h read and
// write.
#include "studio/http/server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstring>
#include <thread>

#include "base/error.h"
#include "base/text.h"
#include "base/utf8.h"
#include "studio/http/connection.h"
#include "studio/http/event_client.h"
#include "studio/http/handler_pool.h"

namespace latsch::studio {
namespace {

using net::ip::tcp;

// interval between two searches for overdue connections
constexpr std::chrono::milliseconds kSweep{200};
// Events within this time are sent to a client together.
constexpr std::chrono::milliseconds kGather{20};
// bytes; limit of events that wait for the thread of the sockets
constexpr std::size_t kMostPublished = 8 << 20;
// Largest number of connections accepted before other work has its turn.
constexpr int kAcceptedAtOnce = 32;
constexpr int kBacklog = 4096;

/// With these flags a socket is closed in every program that this process starts, even if another
/// thread starts it at this moment.
constexpr int kSocketFlags = SOCK_CLOEXEC | SOCK_NONBLOCK;

net::ip::address address_of(const std::string& listen) {
  error_code error;
  const auto address = net::ip::make_address(listen == "localhost" ? "127.0.0.1" : listen, error);
  if (error) {
    throw InputError("cannot listen to " + in_quotes(listen) +
                     ", expected an address of this machine such as 127.0.0.1");
  }
  return address;
}

[[noreturn]] void cannot_listen(const tcp::endpoint& endpoint, int error) {
  const std::string where =
      fmt::format("cannot listen to {}, port {}", endpoint.address().to_string(), endpoint.port());
  if (error == EADDRINUSE)
    throw InputError(where + ": another program does; choose another port, or 0 for a free one");
  if (error == EADDRNOTAVAIL)
    throw InputError(where + ": this machine has no such address; 127.0.0.1 is always there");
  throw InputError(where + ": " + std::strerror(error));
}

/// Returns a socket that listens at the endpoint.
int listening_socket(const tcp::endpoint& endpoint) {
  const int fd = ::socket(endpoint.protocol().family(), SOCK_STREAM | kSocketFlags, 0);
  if (fd < 0) cannot_listen(endpoint, errno);
  const int yes = 1;
  // The new server may use the port even though closed connections of the previous server still
  // exist.
  ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (::bind(fd, endpoint.data(), static_cast<socklen_t>(endpoint.size())) != 0 ||
      ::listen(fd, kBacklog) != 0) {
    const int error = errno;
    ::close(fd);
    cannot_listen(endpoint, error);
  }
  return fd;
}

std::string token_or_random(const std::string& token) {
  return token.empty() ? random_token() : token;
}

}  // namespace

class Server::Impl final : public ConnectionOwner {
 public:
  Impl(ServerOptions options, Handler handler);
  ~Impl();

  std::string address() const;
  std::uint16_t port() const { return port_; }
  const std::string& token() const { return admission_.token(); }
  void publish(std::string_view topic, EventText text);

 private:
  RequestVerdict judge(const Head& head) override;
  void handle(std::shared_ptr<Connection> connection, Request request) override;
  void follow(tcp::socket socket, const Target& target) override;
  Answer refusal(const Head& head, const Refusal& refusal) override;
  void forget(const Connection& connection) override;

  RequestVerdict opened_with_token(const Head& head, std::string_view token);
  const Asset* asset(const std::string& path) const;
  Response response_of(const Request& request) const;

  void run();
  void wait_for_clients();
  void accept_clients();
  void accept_client(int fd);
  bool make_room();
  void sweep();
  void send_alive();
  void send_published();
  void end_connections();

  ServerOptions options_;
  Handler handler_;
  net::ip::address listen_;
  net::io_context io_{1};
  tcp::acceptor acceptor_{io_};
  std::uint16_t port_;
  Admission admission_;
  net::steady_timer sweep_timer_{io_}, alive_timer_{io_}, accept_timer_{io_}, publish_timer_{io_};

  std::vector<std::shared_ptr<Connection>> connections_;  // in no particular order
  std::vector<std::shared_ptr<EventClient>> event_clients_;
  EventOutbox published_{kMostPublished};
  std::stop_source stop_;
  HandlerPool pool_;
  std::thread thread_;  // the thread that owns the sockets
};

Server::Impl::Impl(ServerOptions options, Handler handler)
    : options_(std::move(options)),
      handler_(std::move(handler)),
      listen_(address_of(options_.listen)),
      port_([this] {
        const tcp::endpoint endpoint(listen_, options_.port);
        acceptor_.assign(endpoint.protocol(), listening_socket(endpoint));
        return acceptor_.local_endpoint().port();
      }()),
      admission_(listen_.to_string(), port_, token_or_random(options_.token), options_.names),
      pool_(options_.threads, options_.limits.waiting) {
  wait_for_clients();
  sweep();
  send_alive();
  thread_ = std::thread([this] { run(); });
}

Server::Impl::~Impl() {
  stop_.request_stop();
  io_.stop();
  thread_.join();
  // Connections end at once; the pool then waits for its running handlers, whose answers are
  // dropped.
  end_connections();
}

void Server::Impl::run() {
  const auto guard = net::make_work_guard(io_);
  for (;;) {
    try {
      io_.run();
      return;
      // For example, memory may be exhausted; the next search for overdue connections closes those
      // that stay open.
    } catch (const std::exception& failure) {
      if (options_.report) options_.report(failure.what());
    }
  }
}

std::string Server::Impl::address() const {
  const auto loopback = listen_.is_v6() ? net::ip::address(net::ip::address_v6::loopback())
                                        : net::ip::address(net::ip::address_v4::loopback());
  const std::string host = (listen_.is_unspecified() ? loopback : listen_).to_string();
  return fmt::format(
      "http://{}:{}/?token={}", listen_.is_v6() ? "[" + host + "]" : host, port_, token());
}

// Requests ------------------------------------------------------------------------------------

RequestVerdict Server::Impl::judge(const Head& head) {
  const auto refuse = [&](const Refusal& why) {
    return RequestVerdict{RequestVerdict::Kind::refuse, refusal(head, why), {}};
  };
  const auto answer = [](Answer answer) {
    return RequestVerdict{RequestVerdict::Kind::answer, std::move(answer), {}};
  };
  if (const auto why = admission_.refuse_stranger(head)) return refuse(*why);
  Target target;
  try {
    target = parse_target(head.target);
  } catch (const InputError& error) {
    return refuse({400, error.what(), "send only requests that the studio's page sends"});
  }
  const bool is_read = head.method != "POST";
  if (const auto token = target.query.find("token");
      is_read && target.path == "/" && token != target.query.end())
    return opened_with_token(head, token->second);
  if (const auto why = admission_.refuse_untrusted(head)) return refuse(*why);
  if (is_read) {
    if (const Asset* found = asset(target.path))
      return answer(answer_of(*found, head.if_none_match));
    if (target.path == "/") {
      return answer(answer_of({200,
                               "text/plain; charset=utf-8",
                               "This latsch was built without Node and has no page: install "
                               "nodejs and npm, and build it again.\n"}));
    }
    if (target.path == "/api/ping") return answer(answer_of({200, "application/json", "{}"}));
    if (target.path == "/events" && head.method == "GET") {
      std::erase_if(event_clients_, [](const auto& each) { return !each->is_open(); });
      if (event_clients_.size() >= options_.limits.event_clients)
        return refuse({503, "too many pages are open", "close some of them"});
      return {RequestVerdict::Kind::follow, {}, std::move(target)};
    }
  }
  return {RequestVerdict::Kind::handle, {}, std::move(target)};
}

// Redirects to / and sets the cookie that replaces the token, so that the address in the browser
// can be shown and stored. A browser that comes from a page of another site would follow the
// redirection without the cookie; such a request is answered by a page of our own that opens /
// itself [RFC 6265bis, 5.2].
RequestVerdict Server::Impl::opened_with_token(const Head& head, std::string_view token) {
  if (!admission_.is_token(token)) {
    return {RequestVerdict::Kind::refuse,
            refusal(head,
                    {401,
                     "this is not the token of this server",
                     "latsch has started anew? Open the address that it printed"}),
            {}};
  }
  Answer answer = answer_of({303, "text/html; charset=utf-8", ""});
  answer.fields += "Set-Cookie: " + admission_.cookie() + "\r\n";
  if (head.fetch_site == "cross-site" || head.fetch_site == "same-site") {
    answer.status = 200;
    answer.body =
        "<!DOCTYPE html><meta http-equiv=\"refresh\" content=\"0; url=/\">"
        "<a href=\"/\">Latsch</a>\n";
  } else {
    answer.fields += "Location: /\r\n";
  }
  return {RequestVerdict::Kind::answer, std::move(answer), {}};
}

const Asset* Server::Impl::asset(const std::string& path) const {
  for (const Asset& each : options_.assets)
    if (each.path == path || (path == "/" && each.path == "/index.html")) return &each;
  return nullptr;
}

Answer Server::Impl::refusal(const Head& head, const Refusal& refusal) {
  Answer answer =
      answer_of(head.accept.find("text/html") == head.accept.npos
                    ? error_response(refusal.status, refusal.error, refusal.hint)
                    : Response{refusal.status,
                               "text/plain; charset=utf-8",
                               replaced_where_no_utf8(refusal.error) + "\n" + refusal.hint + "\n"});
  if (refusal.status == 405) answer.fields += "Allow: GET, HEAD, POST\r\n";
  if (refusal.status == 401) answer.fields += "WWW-Authenticate: Bearer\r\n";
  return answer;
}

void Server::Impl::handle(std::shared_ptr<Connection> connection, Request request) {
  if (!is_utf8(request.body) || request.body.find('\0') != request.body.npos)
    return connection->answer(
        answer_of(error_response(400, "the body is no UTF-8", "send JSON in UTF-8")));
  request.stop = stop_.get_token();
  // Only the thread of the sockets owns the connection, so at the end of the server the connection
  // may be gone before the handler returns.
  const std::weak_ptr<Connection> client = connection;
  const bool is_accepted = pool_.submit([this, client, request = std::move(request)] {
    if (client.expired()) return;
    net::post(io_, [client, response = response_of(request)]() mutable {
      if (const auto connection = client.lock()) connection->answer(answer_of(std::move(response)));
    });
  });
  if (!is_accepted) {
    connection->answer(answer_of(
        error_response(503, "too many requests at once", "wait a moment, or close other pages")));
  }
}

Response Server::Impl::response_of(const Request& request) const {
  try {
    return handler_(request);
  } catch (const InputError& error) {
    return error_response(400, error.what(), "");
  } catch (const std::exception& failure) {
    if (options_.report) options_.report(request.path + ": " + failure.what());
  } catch (...) {
    if (options_.report) options_.report(request.path + ": an exception without text");
  }
  return error_response(500, "the program failed while it answered", "its output may say why");
}

void Server::Impl::forget(const Connection& connection) {
  const auto found = std::find_if(connections_.begin(), connections_.end(), [&](const auto& each) {
    return each.get() == &connection;
  });
  if (found == connections_.end()) return;
  std::swap(*found, connections_.back());
  connections_.pop_back();
}

// Connections ---------------------------------------------------------------------------------

// The accept function of Asio is not used, because its socket would stay open in programs that are
// started at that moment.
void Server::Impl::wait_for_clients() {
  acceptor_.async_wait(tcp::acceptor::wait_read, [this](error_code error) {
    if (!error) accept_clients();
  });
}

void Server::Impl::accept_clients() {
  for (int i = 0; i < kAcceptedAtOnce; ++i) {
    const int fd = ::accept4(acceptor_.native_handle(), nullptr, nullptr, kSocketFlags);
    if (fd >= 0) {
      accept_client(fd);
    } else if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
      make_room();
      accept_timer_.expires_after(kSweep / 10);
      accept_timer_.async_wait([this](error_code error) {
        if (!error) wait_for_clients();
      });
      return;
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      break;
    }
  }
  wait_for_clients();
}

void Server::Impl::accept_client(int fd) {
  tcp::socket socket(io_);
  error_code error;
  socket.assign(listen_.is_v6() ? tcp::v6() : tcp::v4(), fd, error);
  if (error) {
    ::close(fd);
    return;
  }
  if (connections_.size() >= options_.limits.connections && !make_room()) return;
  socket.set_option(tcp::no_delay(true), error);
  const auto connection = std::make_shared<Connection>(std::move(socket), *this, options_.limits);
  connections_.push_back(connection);
  connection->read_request();
}

/// Closes the connection that may be closed first, to make room; returns false if all of them are
/// being answered.
bool Server::Impl::make_room() {
  std::shared_ptr<Connection> slowest;
  for (const auto& each : connections_)
    if (each->may_be_closed() && (!slowest || each->makes_room_before(*slowest))) slowest = each;
  if (slowest) slowest->close();
  return slowest != nullptr;
}

void Server::Impl::sweep() {
  const Moment now = std::chrono::steady_clock::now();
  const auto all = connections_;  // a copy, because closed connections are removed from the list
  for (const auto& each : all) each->close_if_overdue(now);
  std::erase_if(event_clients_, [](const auto& each) { return !each->is_open(); });
  sweep_timer_.expires_after(kSweep);
  sweep_timer_.async_wait([this](error_code error) {
    if (!error) sweep();
  });
}

void Server::Impl::end_connections() {
  error_code ignored;
  acceptor_.close(ignored);
  const auto all = connections_;
  for (const auto& each : all) each->close();
  for (const auto& each : event_clients_) each->close();
}

// Events --------------------------------------------------------------------------------------

void Server::Impl::follow(tcp::socket socket, const Target& target) {
  const auto study = target.query.find("study");
  const auto client = std::make_shared<EventClient>(
      std::move(socket), study == target.query.end() ? "" : study->second, options_.limits);
  Answer answer = answer_of({200, "text/event-stream", ""});
  answer.has_length = false;
  event_clients_.push_back(client);
  client->start(std::make_shared<const std::string>(head_text(answer, false) + "retry: 1000\n\n"));
}

void Server::Impl::publish(std::string_view topic, EventText text) {
  if (!published_.put({std::string(topic), std::move(text)})) return;
  net::post(io_, [this] {
    publish_timer_.expires_after(kGather);
    publish_timer_.async_wait([this](error_code error) {
      if (!error) send_published();
    });
  });
}

void Server::Impl::send_published() {
  const EventOutbox::Content content = published_.take();
  for (const auto& client : event_clients_) {
    if (content.has_overrun) client->close();
    for (const EventOutbox::Event& event : content.events)
      if (client->is_open() && (event.topic.empty() || event.topic == client->topic()))
        client->send(event.text);
  }
}

void Server::Impl::send_alive() {
  static const auto kAlive = std::make_shared<const std::string>(event_text("alive", "{}"));
  const Moment now = std::chrono::steady_clock::now();
  for (const auto& client : event_clients_)
    if (client->is_open()) client->send_alive(kAlive, now);
  alive_timer_.expires_after(options_.limits.alive);
  alive_timer_.async_wait([this](error_code error) {
    if (!error) send_alive();
  });
}

// Public interface ----------------------------------------------------------------------------

Server::Server(ServerOptions options, Handler handler)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(handler))) {}

Server::~Server() = default;

std::string Server::address() const { return impl_->address(); }
std::uint16_t Server::port() const { return impl_->port(); }
const std::string& Server::token() const { return impl_->token(); }

void Server::publish(std::string_view topic, std::string_view event, std::string_view json) {
  impl_->publish(topic, std::make_shared<const std::string>(event_text(event, json)));
}

}  // namespace latsch::studio
