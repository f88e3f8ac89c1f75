// SPDX-License-Identifier: Apache-2.0
// Test support, also for benchmarks: an HTTP client that sends any bytes and never waits longer
// than a given time.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace latsch::studio {

struct Reply {
  int status = 0;  // 0: no reply arrived
  std::string head, body;

  /// Returns the value of a header field, whose name is spelled as the server writes it; empty if
  /// there is none.
  std::string field(const std::string& name) const {
    const std::size_t at = head.find("\r\n" + name + ": ");
    if (at == head.npos) return "";
    const std::size_t begin = at + name.size() + 4;
    return head.substr(begin, head.find("\r\n", begin) - begin);
  }
};

class RawClient {
 public:
  using Milliseconds = std::chrono::milliseconds;
  static constexpr Milliseconds kPatience{10000};

  explicit RawClient(std::uint16_t port, int receive_buffer = 0) {
    fd_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (receive_buffer > 0)
      ::setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(fd_, reinterpret_cast<sockaddr*>(&to), sizeof to) != 0 && errno != EINPROGRESS)
      end();
  }
  ~RawClient() { end(); }
  RawClient(RawClient&& other) noexcept : fd_(other.fd_), received_(std::move(other.received_)) {
    other.fd_ = -1;
  }
  RawClient& operator=(RawClient&&) = delete;

  void end() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }
  bool is_connected() const { return fd_ >= 0; }

  /// Sends bytes until all are sent, the server closes, or nothing can be sent for `patience`.
  /// Returns the number of bytes sent.
  std::size_t send(std::string_view bytes, Milliseconds patience = kPatience) {
    std::size_t sent = 0;
    while (sent < bytes.size() && wait(POLLOUT, patience)) {
      const ssize_t now = ::send(fd_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (now < 0 && errno != EAGAIN) break;
      if (now > 0) sent += static_cast<std::size_t>(now);
    }
    return sent;
  }

  /// Reads until `text` has arrived and returns true; false after `patience`. received() returns
  /// all bytes so far.
  bool read_to(std::string_view text, Milliseconds patience = kPatience) {
    while (received_.find(text) == received_.npos)
      if (!receive(patience)) return false;
    return true;
  }
  bool read_bytes(std::size_t bytes, Milliseconds patience = kPatience) {
    while (received_.size() < bytes)
      if (!receive(patience)) return false;
    return true;
  }
  /// True if the server closes the connection within the given time. Bytes that arrive before are
  /// kept.
  bool is_ended(Milliseconds patience = kPatience) {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (receive(std::max(
        Milliseconds(0),
        std::chrono::duration_cast<Milliseconds>(until - std::chrono::steady_clock::now())))) {
    }
    return has_ended_;
  }

  /// Returns the next reply, with its body if the reply states the length.
  Reply reply(Milliseconds patience = kPatience, bool has_body = true) {
    Reply result;
    if (!read_to("\r\n\r\n", patience)) return result;
    result.head = take(received_.find("\r\n\r\n") + 4);
    result.status = std::atoi(result.head.c_str() + std::string_view("HTTP/1.1 ").size());
    const std::string length = result.field("Content-Length");
    if (!has_body || length.empty() || result.status == 304) return result;
    const auto bytes = static_cast<std::size_t>(std::strtoul(length.c_str(), nullptr, 10));
    if (!read_bytes(bytes, patience)) return {};
    result.body = take(bytes);
    return result;
  }

  /// Closes the sending direction of the connection.
  void end_sending() { ::shutdown(fd_, SHUT_WR); }

  const std::string& received() const { return received_; }
  std::string take(std::size_t bytes) {
    std::string taken = received_.substr(0, bytes);
    received_.erase(0, bytes);
    return taken;
  }

 private:
  bool wait(short events, Milliseconds patience) {
    pollfd entry{fd_, events, 0};
    return fd_ >= 0 && ::poll(&entry, 1, static_cast<int>(patience.count())) > 0;
  }
  bool receive(Milliseconds patience) {
    if (has_ended_ || !wait(POLLIN, patience)) return false;
    std::array<char, 16384> bytes;
    const ssize_t now = ::recv(fd_, bytes.data(), bytes.size(), 0);
    has_ended_ = now == 0 || (now < 0 && errno != EAGAIN);
    if (now > 0) received_.append(bytes.data(), static_cast<std::size_t>(now));
    return !has_ended_;
  }

  int fd_ = -1;
  bool has_ended_ = false;
  std::string received_;
};

/// Sends one request on a new connection and returns the reply.
inline Reply reply_to(std::uint16_t port, std::string_view request) {
  RawClient client(port);
  client.send(request);
  return client.reply(RawClient::kPatience, !request.starts_with("HEAD "));
}

}  // namespace latsch::studio
