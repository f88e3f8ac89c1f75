// SPDX-License-Identifier: Apache-2.0
// A connection that receives the events of a topic until one side closes it. Bytes from the client
// are not read. A client that receives nothing for too long, or lags too far behind, is
// disconnected; its page connects again. Runs in the thread of the sockets. Only server.cpp
// includes this file, because Beast's headers take long to compile.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include "studio/http/connection.h"
#include "studio/http/event_queue.h"

namespace latsch::studio {

class EventClient : public std::enable_shared_from_this<EventClient> {
 public:
  EventClient(net::ip::tcp::socket socket, std::string topic, const ServerLimits& limits)
      : socket_(std::move(socket)),
        topic_(std::move(topic)),
        limits_(limits),
        queue_(limits.unread_events) {}

  void start(EventText head) {
    send(std::move(head));
    read_and_ignore();
  }

  void send(EventText text) {
    if (!queue_.push(std::move(text))) return close();
    if (on_their_way_.empty()) write();
  }

  /// Sends the event `alive`, unless another event is being sent.
  void send_alive(const EventText& text, Moment now) {
    if (!on_their_way_.empty() && now > since_ + limits_.stalled) return close();
    if (on_their_way_.empty()) send(text);
  }

  void close() {
    error_code ignored;
    socket_.close(ignored);
  }

  bool is_open() const { return socket_.is_open(); }
  const std::string& topic() const { return topic_; }

 private:
  void write() {
    on_their_way_ = queue_.take();
    since_ = std::chrono::steady_clock::now();
    std::vector<net::const_buffer> buffers;
    for (const EventText& text : on_their_way_) buffers.emplace_back(text->data(), text->size());
    net::async_write(socket_, buffers, [self = shared_from_this()](error_code error, std::size_t) {
      self->on_their_way_.clear();
      if (error) return self->close();
      if (!self->queue_.empty()) self->write();
    });
  }

  void read_and_ignore() {
    socket_.async_read_some(net::buffer(ignored_),
                            [self = shared_from_this()](error_code error, std::size_t) {
                              error ? self->close() : self->read_and_ignore();
                            });
  }

  net::ip::tcp::socket socket_;
  std::string topic_;
  const ServerLimits& limits_;
  EventQueue queue_;
  std::vector<EventText> on_their_way_;
  Moment since_;
  std::array<char, 256> ignored_;
};

}  // namespace latsch::studio
