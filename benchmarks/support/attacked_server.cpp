// SPDX-License-Identifier: Apache-2.0
#include "attacked_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <regex>
#include <stdexcept>
#include <utility>

namespace latsch::benchmarks {
namespace {

constexpr rlim_t kFilesOfALogin = 1024;
constexpr auto kPingPause = std::chrono::milliseconds(10);
constexpr double kNoAnswer = 10.0;  // s

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

pid_t spawn(const std::vector<std::string>& command, int output) {
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, output, 1);
  std::vector<char*> argv;
  for (const std::string& argument : command) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, argv[0], &files, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw std::runtime_error("cannot start " + command.front());
  const rlimit few{kFilesOfALogin, kFilesOfALogin};
  ::prlimit(child, RLIMIT_NOFILE, &few, nullptr);
  return child;
}

}  // namespace

AttackedServer::AttackedServer(const std::vector<std::string>& command) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  output_ = ends[0];
  child_ = spawn(command, ends[1]);
  ::close(ends[1]);
  std::string printed;
  std::smatch found;
  const std::regex address(R"(http://[^/\s]*:(\d+)/\?token=([A-Za-z0-9_-]+)\s)");
  while (!std::regex_search(printed, found, address)) {
    char bytes[512];
    const ssize_t count = ::read(output_, bytes, sizeof bytes);
    if (count <= 0) {
      terminate();
      throw std::runtime_error("the server printed no address, but: " + printed);
    }
    printed.append(bytes, static_cast<std::size_t>(count));
  }
  port_ = static_cast<std::uint16_t>(std::stoi(found[1]));
  token_ = found[2];
}

AttackedServer::~AttackedServer() {
  if (is_running()) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  ::close(output_);
}

std::string AttackedServer::request(const std::string& line,
                                    const std::string& fields,
                                    const std::string& body) const {
  std::string text = fmt::format("{} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}", line, port_, fields);
  if (!body.empty()) text += fmt::format("Content-Length: {}\r\n", body.size());
  return text + "\r\n" + body;
}

std::string AttackedServer::trusted(const std::string& line,
                                    const std::string& fields,
                                    const std::string& body) const {
  return request(line, "Authorization: Bearer " + token_ + "\r\n" + fields, body);
}

double AttackedServer::peak_memory() const {
  std::ifstream status(fmt::format("/proc/{}/status", child_));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024.0 * std::stod(line.substr(6));
  return -1.0;
}

bool AttackedServer::is_running() const {
  siginfo_t end{};
  return ::waitid(P_PID, static_cast<id_t>(child_), &end, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         end.si_pid == 0;
}

double AttackedServer::terminate() {
  const auto start = std::chrono::steady_clock::now();
  ::kill(child_, SIGTERM);
  while (is_running()) {
    if (seconds_since(start) > 10.0) return -1.0;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ::waitpid(child_, nullptr, 0);
  return seconds_since(start);
}

Pings::Pings(const AttackedServer& server) : server_(server), thread_([this] { run(); }) {}

Pings::~Pings() {
  is_ending_ = true;
  thread_.join();
}

std::vector<double> Pings::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(seconds_, {});
}

bool Pings::answers(studio::RawClient& client) const {
  client.send(server_.trusted("GET /api/ping"));
  return client.reply().status == 200;
}

void Pings::run() {
  std::optional<studio::RawClient> kept, fresh;
  for (bool is_new = true; !is_ending_; is_new = !is_new) {
    std::optional<studio::RawClient>& client = is_new ? fresh : kept;
    const auto start = std::chrono::steady_clock::now();
    if (!client) client.emplace(server_.port());
    const bool is_answered = answers(*client);
    const double seconds = is_answered ? seconds_since(start) : kNoAnswer;
    if (is_new || !is_answered) client.reset();
    {
      const std::lock_guard lock(mutex_);
      seconds_.push_back(seconds);
    }
    std::this_thread::sleep_for(kPingPause);
  }
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto at = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(at, 1) - 1];
}

}  // namespace latsch::benchmarks
