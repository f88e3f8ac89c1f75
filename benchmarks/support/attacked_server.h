// SPDX-License-Identifier: Apache-2.0
// A server of the studio in a separate process, whose memory and response are measured while it is
// attacked.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "studio/http/raw_client_testing.h"

namespace latsch::benchmarks {

class AttackedServer {
 public:
  /// Starts the program and waits until it prints http://HOST:PORT/?token=TOKEN. Its limit of open
  /// files is the default of a login, 1,024. Throws std::runtime_error.
  explicit AttackedServer(const std::vector<std::string>& command);
  ~AttackedServer();
  AttackedServer(const AttackedServer&) = delete;
  AttackedServer& operator=(const AttackedServer&) = delete;

  std::uint16_t port() const { return port_; }
  const std::string& token() const { return token_; }
  /// Returns the text of a request: `line`, for example "GET /x HTTP/1.1", with the field Host, the
  /// given fields and, if there is a body, its length and the body.
  std::string request(const std::string& line,
                      const std::string& fields = "",
                      const std::string& body = "") const;
  /// Returns the text of the same kind of request with the access token of the server.
  std::string trusted(const std::string& line,
                      const std::string& fields = "",
                      const std::string& body = "") const;

  /// Returns the peak of the server's memory since its process began, bytes; -1 if the process has
  /// ended.
  double peak_memory() const;
  bool is_running() const;
  /// Sends SIGTERM and returns the seconds until the process ended; -1 if it did not end within ten
  /// seconds.
  double terminate();

 private:
  pid_t child_ = -1;
  int output_ = -1;
  std::uint16_t port_ = 0;
  std::string token_;
};

/// Requests /api/ping a hundred times a second, alternately on a new connection and on a kept one,
/// in a separate thread.
class Pings {
 public:
  explicit Pings(const AttackedServer& server);
  ~Pings();

  /// Returns the response times, s, since the last call; an unanswered request counts as ten
  /// seconds.
  std::vector<double> take();

 private:
  void run();
  bool answers(studio::RawClient& client) const;

  const AttackedServer& server_;
  std::atomic<bool> is_ending_ = false;
  std::mutex mutex_;
  std::vector<double> seconds_;
  std::thread thread_;
};

/// Returns the quantile of the values: the number that a share `share` (for example 0.99) of them
/// does not exceed; 0 for an empty list.
double quantile(std::vector<double> values, double share);

}  // namespace latsch::benchmarks
