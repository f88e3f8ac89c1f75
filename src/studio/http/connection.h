// SPDX-License-Identifier: Apache-2.0
// One connection of the HTTP server. It reads the head of a request, lets its owner decide, reads
// the body, writes the answer, and repeats this until one side closes the connection.
//
//   reading ──► answering ──► writing ──► reading | lingering | closed
//
// An answer before the end of a request ends the connection, but further bytes are read and dropped
// for a second. If the connection were closed at once, the kernel would reset it and the client
// would never see the answer [RFC 9112, 9.6].
//
// All of it runs in the thread that owns the sockets. Only server.cpp includes this file, because
// Beast's headers take most of this module's compile time.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_suffix.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>

#include "studio/http/admission.h"
#include "studio/http/answer.h"
#include "studio/http/server.h"
#include "studio/http/target.h"

namespace latsch::studio {

namespace net = boost::asio;
namespace http = boost::beast::http;
using boost::system::error_code;
using Moment = std::chrono::steady_clock::time_point;

class Connection;

/// The server's decision about a request whose header has been read.
struct RequestVerdict {
  enum class Kind : std::uint8_t { refuse, answer, handle, follow } kind = Kind::refuse;
  Answer answer;  // set for `refuse` and `answer`
  Target target;  // set for `handle` and `follow`
};

/// The interface of the server that its connections use.
class ConnectionOwner {
 public:
  virtual RequestVerdict judge(const Head& head) = 0;
  /// Handles a request. The owner answers later by Connection::answer(), in the thread of the
  /// sockets. follow() takes over the socket for a stream of events.
  virtual void handle(std::shared_ptr<Connection> connection, Request request) = 0;
  virtual void follow(net::ip::tcp::socket socket, const Target& target) = 0;
  virtual Answer refusal(const Head& head, const Refusal& refusal) = 0;
  virtual void forget(const Connection& connection) = 0;

 protected:
  ~ConnectionOwner() = default;
};

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(net::ip::tcp::socket socket, ConnectionOwner& owner, const ServerLimits& limits)
      : socket_(std::move(socket)), owner_(owner), limits_(limits), buffer_(limits.head + kSpare) {
    is_until(limits.request);
  }

  void read_request();
  void answer(Answer answer);
  /// Closes the connection without an answer.
  void close();
  /// Closes the connection if it exceeds its time limit.
  void close_if_overdue(Moment now);

  /// Decide which connection is closed first if there are too many: those without a token before
  /// those with one, and among these the one that has been silent for the longest time. A
  /// connection whose answer is being computed is not closed.
  bool may_be_closed() const { return state_ != State::answering; }
  bool makes_room_before(const Connection& other) const {
    return std::pair(is_trusted_, heard_) < std::pair(other.is_trusted_, other.heard_);
  }

 private:
  enum class State : std::uint8_t { reading, answering, writing, lingering };
  /// Bytes of buffer beyond the limit of the head, so that the parser can notice that the limit is
  /// exceeded.
  static constexpr std::size_t kSpare = 1024;
  static constexpr std::size_t kPiece = 512;
  static constexpr std::size_t kMostThrownAway = 4 << 20;  // bytes
  static constexpr std::chrono::milliseconds kLinger{1000};

  void read_head_done(error_code error);
  void read_body();
  void read_body_done(error_code error);
  void refuse_unreadable(error_code error);
  void write_more();
  void written();
  void linger();
  void throw_away();
  void is_until(std::chrono::milliseconds time) {
    heard_ = std::chrono::steady_clock::now();
    deadline_ = heard_ + time;
  }

  net::ip::tcp::socket socket_;
  ConnectionOwner& owner_;
  const ServerLimits& limits_;
  State state_ = State::reading;
  bool is_trusted_ = false;
  bool is_overdue_ = false;  // the time limit of reading has passed
  bool is_refused_ = false;
  Moment heard_, deadline_;

  boost::beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  Head head_;
  Target target_;

  Answer answer_;
  std::string answer_head_;
  boost::beast::buffers_suffix<std::array<net::const_buffer, 2>> unwritten_;
  bool stays_open_ = false;
  std::size_t thrown_away_ = 0;
};

inline Head head_of(const http::request<http::string_body>& request) {
  const auto field = [&](http::field name) { return std::string(request[name]); };
  Head head;
  head.method = std::string(request.method_string());
  head.target = std::string(request.target());
  head.hosts = static_cast<int>(request.count(http::field::host));
  head.host = field(http::field::host);
  head.origin = field(http::field::origin);
  head.fetch_site = std::string(request["Sec-Fetch-Site"]);
  head.fetch_mode = std::string(request["Sec-Fetch-Mode"]);
  head.authorization = field(http::field::authorization);
  head.cookie = field(http::field::cookie);
  head.content_type = field(http::field::content_type);
  head.accept = field(http::field::accept);
  head.if_none_match = field(http::field::if_none_match);
  return head;
}

inline void Connection::read_request() {
  state_ = State::reading;
  head_ = {};
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(limits_.head));
  /// The body has no limit at this point, because the sender is checked first and the size after
  /// that.
  parser_->body_limit(std::numeric_limits<std::uint64_t>::max());
  http::async_read_header(
      socket_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
        self->read_head_done(error);
      });
}

inline void Connection::read_head_done(error_code error) {
  if (error) return refuse_unreadable(error);
  head_ = head_of(parser_->get());
  RequestVerdict verdict = owner_.judge(head_);
  is_trusted_ = is_trusted_ || verdict.kind != RequestVerdict::Kind::refuse;
  target_ = std::move(verdict.target);
  switch (verdict.kind) {
    case RequestVerdict::Kind::refuse:
      is_refused_ = true;
      return answer(std::move(verdict.answer));
    case RequestVerdict::Kind::answer:
      return answer(std::move(verdict.answer));
    case RequestVerdict::Kind::handle:
      return read_body();
    case RequestVerdict::Kind::follow:
      owner_.follow(std::move(socket_), target_);
      return owner_.forget(*this);
  }
}

inline void Connection::read_body() {
  if (parser_->content_length().value_or(0) > limits_.body)
    return refuse_unreadable(http::error::body_limit);
  parser_->body_limit(limits_.body);
  is_until(limits_.request);
  const auto read = [self = shared_from_this()] {
    http::async_read(
        self->socket_, self->buffer_, *self->parser_, [self](error_code error, std::size_t) {
          self->read_body_done(error);
        });
  };
  if (parser_->get()[http::field::expect] != "100-continue") return read();
  static constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
  net::async_write(socket_,
                   net::buffer(kContinue.data(), kContinue.size()),
                   [self = shared_from_this(), read](error_code error, std::size_t) {
                     error ? self->close() : read();
                   });
}

inline void Connection::read_body_done(error_code error) {
  if (error) return refuse_unreadable(error);
  state_ = State::answering;
  Request request;
  request.method = head_.method == "HEAD" ? "GET" : head_.method;
  request.path = std::move(target_.path);
  request.query = std::move(target_.query);
  request.body = std::move(parser_->get().body());
  owner_.handle(shared_from_this(), std::move(request));
}

inline void Connection::refuse_unreadable(error_code error) {
  const bool has_begun = buffer_.size() > 0 || parser_->got_some();
  const auto refuse = [&](int status, std::string_view text, std::string_view hint) {
    is_refused_ = true;
    answer(owner_.refusal(head_, {status, std::string(text), std::string(hint)}));
  };
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return refuse(431, "the head of the request is too long", "leave out what is not needed");
  if (error == http::error::body_limit)
    return refuse(413, "the body of the request is too long", "the studio takes text files only");
  if (error == net::error::operation_aborted && is_overdue_ && has_begun)
    return refuse(408, "the request did not end in time", "send it again");
  if (error.category() == http::make_error_code(http::error::bad_target).category() &&
      error != http::error::end_of_stream && error != http::error::partial_message)
    return refuse(400, "the request is no HTTP/1.1: " + error.message(), "send HTTP/1.1");
  close();
}

inline void Connection::answer(Answer answer) {
  if (!socket_.is_open()) return;
  state_ = State::writing;
  answer_ = std::move(answer);
  if (head_.method == "HEAD") answer_.has_body = false;
  stays_open_ = !is_refused_ && parser_->keep_alive() && parser_->is_done();
  answer_head_ = head_text(answer_, stays_open_);
  const std::string_view body = answer_.has_body ? answer_.text() : std::string_view{};
  unwritten_ = boost::beast::buffers_suffix<std::array<net::const_buffer, 2>>(
      std::array{net::const_buffer(answer_head_.data(), answer_head_.size()),
                 net::const_buffer(body.data(), body.size())});
  write_more();
}

inline void Connection::write_more() {
  is_until(limits_.stalled);
  socket_.async_write_some(
      unwritten_, [self = shared_from_this()](error_code error, std::size_t written) {
        if (error) return self->close();
        self->unwritten_.consume(written);
        net::buffer_size(self->unwritten_) > 0 ? self->write_more() : self->written();
      });
}

inline void Connection::written() {
  answer_ = {};
  if (!stays_open_) return linger();
  is_until(limits_.idle);
  read_request();
}

inline void Connection::linger() {
  state_ = State::lingering;
  is_trusted_ = false;
  is_until(kLinger);
  error_code ignored;
  socket_.shutdown(net::ip::tcp::socket::shutdown_send, ignored);
  throw_away();
}

inline void Connection::throw_away() {
  buffer_.clear();
  socket_.async_read_some(buffer_.prepare(kPiece),
                          [self = shared_from_this()](error_code error, std::size_t bytes) {
                            self->thrown_away_ += bytes;
                            if (error || self->thrown_away_ > kMostThrownAway) return self->close();
                            self->throw_away();
                          });
}

inline void Connection::close() {
  error_code ignored;
  socket_.close(ignored);
  owner_.forget(*this);
}

inline void Connection::close_if_overdue(Moment now) {
  if (state_ == State::answering || now < deadline_) return;
  if (state_ != State::reading || is_overdue_) return close();
  is_overdue_ = true;  // answered with an error if part of a request has arrived
  deadline_ = now + kLinger;
  error_code ignored;
  socket_.cancel(ignored);
}

}  // namespace latsch::studio
