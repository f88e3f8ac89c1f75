// SPDX-License-Identifier: Apache-2.0
// Attacks the studio's HTTP server. It must answer 4xx, need little memory, keep answering pings
// fast, and give no file that it must not serve.
//
//   ./bench.sh hostile_http [--alone]
//
// `latsch serve` runs in a separate process, over a folder with a study; files that it must not
// read are beside the folder. With --alone the server of src/studio/http runs without the studio,
// with a handler of a few lines that publishes a hundred events a second.
//
// During the whole run a user's page requests /api/ping a hundred times a second, on a kept
// connection and on new ones. Memory is the increase of the server's peak over that after a few
// dozen usual requests. The seed of the damaged requests is fixed.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <functional>
#include <iostream>
#include <map>

#include "attacked_server.h"
#include "base/file.h"
#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "base/spoiled_text_testing.h"
#include "hostile_requests.h"
#include "killed_study.h"
#include "studio/http/server.h"
#include "table.h"

namespace latsch::benchmarks {
namespace {

using studio::RawClient;
using studio::Reply;
using studio::reply_to;
using namespace std::chrono_literals;

constexpr double kMostMemory = 20e6;  // bytes
constexpr double kMostPing = 0.1;     // s
constexpr double kMostEnd = 1.0;      // s
constexpr std::size_t kGigabyte = 1u << 30;
constexpr int kSlow = 1000, kEventClients = 200;
constexpr std::uint64_t kSeed = 20260;
const std::string kSecret = "nobody may read this";

/// Runs the server until SIGTERM arrives or the benchmark's process has ended.
int serve() {
  const pid_t benchmark = ::getppid();
  sigset_t end;
  ::sigemptyset(&end);
  ::sigaddset(&end, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &end, nullptr);
  studio::Server server({}, [](const studio::Request& request) -> studio::Response {
    if (request.path == "/api/home") return {200, "application/json", R"({"studies": []})"};
    return studio::error_response(404, "there is no such thing", "ask for /api/home");
  });
  std::cout << server.address() << std::endl;
  const timespec pause{0, 10'000'000};
  const std::string filling(500, 'x');
  for (long i = 0; ::sigtimedwait(&end, nullptr, &pause) != SIGTERM; ++i) {
    if (::getppid() != benchmark) break;
    server.publish("", "trials", fmt::format(R"({{"total": {}, "x": "{}"}})", i, filling));
  }
  return 0;
}

/// Counts the replies of the server by their status and checks them.
struct Seen {
  long replies = 0;
  long with_secrets = 0;

  void add(const Reply& reply) {
    ++replies;
    for (const std::string_view secret : {std::string_view(kSecret), std::string_view("root:x:0:")})
      if (reply.body.find(secret) != reply.body.npos) ++with_secrets;
  }
};

class Attack {
 public:
  Attack(const AttackedServer& server,
         Pings& pings,
         Table& table,
         Seen& seen,
         std::chrono::milliseconds duration)
      : server_(server), pings_(pings), table_(table), seen_(seen), duration_(duration) {}

  /// Requires that each of these requests is refused with 4xx.
  void refused(const std::string& what, const std::vector<std::string>& requests) {
    repeated(what, [&] {
      std::vector<Reply> replies;
      for (const std::string& request : requests)
        replies.push_back(reply_to(server_.port(), request));
      return replies;
    });
  }

  /// Adds one row: repeats the attack for `duration` and counts the replies with status 4xx. All
  /// replies must have it.
  void repeated(const std::string& what, const std::function<std::vector<Reply>()>& attack) {
    std::map<int, long> count;
    long all = 0, refused = 0;
    const auto until = std::chrono::steady_clock::now() + duration_;
    do {
      for (const Reply& reply : attack()) {
        seen_.add(reply);
        ++all;
        ++count[reply.status];
        refused += reply.status >= 400 && reply.status < 500 ? 1 : 0;
      }
    } while (std::chrono::steady_clock::now() < until);
    std::string text = fmt::format("{} of {}:", refused, all);
    for (const auto& [status, number] : count) text += fmt::format(" {}", status);
    table_.row(what, text, "all 4xx", refused == all);
    ping_note(what);
  }

  void ping_note(const std::string& what) {
    const std::vector<double> seconds = pings_.take();
    all_pings_.insert(all_pings_.end(), seconds.begin(), seconds.end());
    table_.note("  pings meanwhile: " + what,
                fmt::format("{}, p99 {:.1f} ms", seconds.size(), 1e3 * quantile(seconds, 0.99)));
  }

  const std::vector<double>& all_pings() const { return all_pings_; }

 private:
  const AttackedServer& server_;
  Pings& pings_;
  Table& table_;
  Seen& seen_;
  std::chrono::milliseconds duration_;
  std::vector<double> all_pings_;
};

/// Sends a request of up to `bytes` while the server accepts data, then returns the server's reply.
Reply reply_to_endless(std::uint16_t port,
                       const std::string& beginning,
                       std::size_t bytes,
                       const std::string& piece) {
  RawClient client(port);
  client.send(beginning);
  for (std::size_t sent = 0; sent < bytes && client.received().empty();) {
    const std::size_t now = client.send(piece, 3s);
    if (now < piece.size()) break;
    sent += now;
    client.read_bytes(1, 0ms);
  }
  return client.reply(15s);
}

/// Sends requests whose bodies do not end. A smoke run sends less than the announced gigabyte.
void endless(const AttackedServer& server, std::size_t sent, Attack& attack) {
  const std::string piece(1 << 20, 'x');
  const std::string length = fmt::format("Content-Length: {}\r\n", kGigabyte);
  const std::string chunked = "Transfer-Encoding: chunked\r\n";
  const std::vector<std::string> bodies = {
      server.trusted("POST /api/check", kJson + length),
      server.request("POST /api/check", kJson + length),
      server.trusted("GET /api/home", length),
      server.trusted("POST /api/check", kJson + chunked) + "40000000\r\n",
      server.trusted("POST /api/check", kJson + "Content-Length: 99999999999999999999\r\n")};
  attack.repeated("a body of 1 GB", [&] {
    std::vector<Reply> replies;
    for (const std::string& body : bodies)
      replies.push_back(reply_to_endless(server.port(), body, sent, piece));
    return replies;
  });
  const std::vector<std::pair<std::string, std::string>> heads = {
      {"GET / HTTP/1.1\r\nX: ", piece},
      {"GET /", piece},
      {std::string(), piece},
      {"GET / HTTP/1.1\r\n", "X: y\r\n"},
      {"GET / HTTP/1.1\r\nCookie: ", "a=b; "}};
  attack.repeated("a head without end", [&] {
    std::vector<Reply> replies;
    for (const auto& [beginning, more] : heads)
      replies.push_back(reply_to_endless(server.port(), beginning, sent, more));
    return replies;
  });
  attack.repeated("a head of ten bytes a second", [&]() -> std::vector<Reply> {
    RawClient dripping(server.port());
    dripping.send("GET / HTTP/1.1\r\nX: ");
    while (!dripping.read_bytes(1, 100ms) && dripping.send("x") == 1) {
    }
    return {dripping.reply(1s)};
  });
}

/// Opens a thousand sockets at once that never end their request, and reopens them as fast as the
/// server ends them.
void slow_sockets(const AttackedServer& server,
                  std::chrono::milliseconds duration,
                  Attack& attack,
                  Table& table,
                  Seen& seen) {
  std::vector<RawClient> slow;
  slow.reserve(kSlow);
  long opened = 0;
  const auto until = std::chrono::steady_clock::now() + duration;
  for (std::size_t i = 0; std::chrono::steady_clock::now() < until; ++i) {
    if (slow.size() < kSlow) {
      slow.emplace_back(server.port());
    } else {
      RawClient& oldest = slow[i % kSlow];
      if (oldest.is_ended(0ms)) {
        std::destroy_at(&oldest);
        std::construct_at(&oldest, server.port());
      } else if (oldest.send("x") == 1) {
        continue;
      }
    }
    ++opened;
    slow[i % slow.size()].send(i % 3 == 0 ? "" : server.trusted("GET /").substr(0, 20 + i % 40));
  }
  seen.add(reply_to(server.port(), server.trusted("GET /api/home")));
  const Reply home = reply_to(server.port(), server.trusted("GET /api/home"));
  table.row(fmt::format("{} slow sockets, {} in {} s: a page is answered",
                        kSlow,
                        opened,
                        1e-3 * static_cast<double>(duration.count())),
            std::to_string(home.status),
            "200",
            home.status == 200);
  attack.ping_note("slow sockets");
}

/// Opens connections for server-sent events, half of which read nothing.
void event_clients(const AttackedServer& server, Attack& attack, Table& table) {
  std::vector<RawClient> clients;
  for (int i = 0; i < kEventClients; ++i) {
    clients.emplace_back(server.port(), i % 2 == 0 ? 0 : 4096);
    clients.back().send(server.trusted("GET /events?study=study.toml"));
  }
  int alive = 0;
  for (int round = 0; round < 8; ++round)
    for (int i = 0; i < kEventClients; i += 2) clients[static_cast<std::size_t>(i)].is_ended(10ms);
  for (int i = 0; i < kEventClients; i += 2) {
    RawClient& client = clients[static_cast<std::size_t>(i)];
    client.take(client.received().size());
    alive += client.read_to("event: alive\n", 3s) ? 1 : 0;
  }
  table.row(fmt::format("{} event clients, half of them read: alive within 3 s", kEventClients),
            fmt::format("{} of {}", alive, kEventClients / 2),
            "all",
            alive == kEventClients / 2);
  attack.ping_note("event clients");
}

/// Sends damaged requests. Every status except 5xx is allowed, because a damaged request may still
/// be valid.
void spoiled_requests(
    const AttackedServer& server, int count, Attack& attack, Table& table, Seen& seen) {
  const std::vector<std::string> seeds = {
      server.trusted("GET /api/home"),
      server.trusted("GET /api/comparison?study=study.toml&trial=best&weights=a:1"),
      server.trusted("POST /api/check", kJson, R"({"study": "study.toml", "text": "title = 1"})"),
      server.trusted("POST /api/check", kJson + "Transfer-Encoding: chunked\r\n") +
          "2\r\n{}\r\n0\r\n\r\n",
      server.trusted("GET / HTTP/1.1\r\nIf-None-Match: \"x\"")};
  const std::vector<std::string> pieces = {"\r\n",
                                           "\r",
                                           "\n",
                                           "\r\n\r\n",
                                           " ",
                                           ":",
                                           "%",
                                           "%2e",
                                           "..",
                                           "/",
                                           "\xff",
                                           std::string(1, '\0'),
                                           "HTTP/1.1",
                                           "Content-Length: 5\r\n",
                                           "Content-Length: -1\r\n",
                                           "Transfer-Encoding: chunked\r\n",
                                           "Host: x\r\n",
                                           "ffffffffffffffff\r\n"};
  RandomStream random(kSeed, 0);
  long failed = 0, answered = 0;
  for (int i = 0; i < count; ++i) {
    RawClient client(server.port());
    client.send(spoiled(seeds[random.below(seeds.size())], pieces, random));
    client.end_sending();
    const Reply reply = client.reply(5s);
    seen.add(reply);
    answered += reply.status != 0 ? 1 : 0;
    failed += reply.status >= 500 ? 1 : 0;
  }
  table.row(fmt::format("{} spoiled requests: {} answered, with 5xx", count, answered),
            std::to_string(failed),
            "0",
            failed == 0 && answered > 0);
  attack.ping_note("spoiled requests");
}

void usual_requests(const AttackedServer& server) {
  for (int i = 0; i < 50; ++i) {
    reply_to(server.port(), server.trusted("GET /"));
    reply_to(server.port(), server.trusted("GET /api/home"));
    reply_to(server.port(),
             server.trusted("POST /api/check", kJson, R"({"study": "study.toml", "text": ""})"));
  }
}

std::vector<std::string> latsch_serve(const std::filesystem::path& folder) {
  const auto latsch = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "latsch";
  return {latsch.string(), "serve", "--no-browser", folder.string()};
}

int attack(const Options& options) {
  const bool is_alone = options.has("--alone");
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch / "studies");
  write_small_study(scratch / "studies", 0.0);
  write_text_file(scratch / "secret.toml", "title = \"" + kSecret + "\"\n");
  AttackedServer server(is_alone ? std::vector<std::string>{"/proc/self/exe", "--serve"}
                                 : latsch_serve(scratch / "studies"));
  Table table(is_alone ? "hostile_http, the server alone" : "hostile_http, latsch serve", options);
  usual_requests(server);
  const double before = server.peak_memory();
  Seen seen;
  Pings pings(server);
  Attack attack(server, pings, table, seen, options.size(1000ms, 20ms));
  std::this_thread::sleep_for(1s);
  const std::vector<double> calm = pings.take();
  table.note("pings before the attacks",
             fmt::format("{}, p99 {:.1f} ms", calm.size(), 1e3 * quantile(calm, 0.99)));
  attack.refused("wrong Host", wrong_hosts(server));
  attack.refused("wrong Origin", wrong_origins(server));
  attack.refused("no token or a wrong one", without_token(server));
  attack.refused("forms of other pages", cross_site_forms(server));
  attack.refused("path traversal", traversals(server));
  attack.refused("bad UTF-8", bad_utf8(server));
  endless(server, options.size(kGigabyte, kGigabyte >> 6), attack);
  slow_sockets(server, options.size(10000ms, 500ms), attack, table, seen);
  event_clients(server, attack, table);
  spoiled_requests(server, options.size(20000, 300), attack, table, seen);

  const std::vector<double>& all = attack.all_pings();
  const auto lost = std::count_if(all.begin(), all.end(), [](double s) { return s >= 10.0; });
  const double p99 = quantile(all, 0.99);
  table.full_row(fmt::format("{} pings under attack, p99", all.size()),
                 fmt::format("{:.1f} ms", 1e3 * p99),
                 "< 100 ms",
                 p99 < kMostPing);
  table.row("pings that were not answered", std::to_string(lost), "0", lost == 0);
  const double grown = server.peak_memory() - before;
  table.row("memory grown",
            fmt::format("{:.1f} MB of {:.1f}", 1e-6 * grown, 1e-6 * before),
            "< 20 MB",
            before > 0.0 && grown < kMostMemory);
  table.row(fmt::format("{} replies, with something from outside", seen.replies),
            std::to_string(seen.with_secrets),
            "0",
            seen.with_secrets == 0 && seen.replies > 0);
  table.row(
      "the server still runs", server.is_running() ? "yes" : "no", "yes", server.is_running());
  const double end = server.terminate();
  table.row("SIGTERM ends it",
            fmt::format("{:.2f} s", end),
            "< 1 s",
            end >= 0.0 && (end < kMostEnd || options.is_smoke()));
  return table.exit_code();
}

}  // namespace
}  // namespace latsch::benchmarks

int main(int argc, char** argv) {
  using namespace latsch::benchmarks;
  if (argc > 1 && std::strcmp(argv[1], "--serve") == 0) return serve();
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;  // lets this process open a thousand sockets
  ::setrlimit(RLIMIT_NOFILE, &files);
  return run_benchmark(
      argc, argv, {{"--alone", "", "the server by itself, with a handler of its own"}}, attack);
}
