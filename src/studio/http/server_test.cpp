// SPDX-License-Identifier: Apache-2.0
#include "studio/http/server.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <latch>
#include <thread>

#include "base/error.h"
#include "studio/http/raw_client_testing.h"

namespace latsch::studio {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

const std::string kToken = "0123456789abcdef0123456789abcdef";

ServerOptions options() {
  ServerOptions result;
  result.token = kToken;
  return result;
}

/// Answers with the text of the request's method, path and query.
Response echo(const Request& request) {
  std::string text = request.method + " " + request.path;
  for (const auto& [name, value] : request.query) text += " " + name + "=" + value;
  return {200, "text/plain; charset=utf-8", text + " " + request.body};
}

std::string request(const std::string& line,
                    const std::string& fields = "",
                    const std::string& body = "") {
  std::string text = line + " HTTP/1.1\r\nHost: localhost:1\r\n" + fields;
  if (!body.empty()) text += fmt::format("Content-Length: {}\r\n", body.size());
  return text + "\r\n" + body;
}

std::string trusted(const std::string& line,
                    const std::string& fields = "",
                    const std::string& body = "") {
  return request(line, "Authorization: Bearer " + kToken + "\r\n" + fields, body);
}

const std::string kJson = "Content-Type: application/json\r\n";

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(Server, HandsOverWhatWasAskedDecoded) {
  Server server(options(), echo);
  EXPECT_EQ(reply_to(server.port(), trusted("GET /api/a%20b?study=x%2Fy.toml&w=1+2")).body,
            "GET /api/a b study=x/y.toml w=1 2 ");
  EXPECT_EQ(reply_to(server.port(), trusted("POST /api/save", kJson, "{\"a\": 1}")).body,
            "POST /api/save {\"a\": 1}");
  const Reply head = reply_to(server.port(), trusted("HEAD /api/home"));
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.field("Content-Length"), "14");  // the length of the body that GET returns
  EXPECT_EQ(head.field("Cache-Control"), "no-store");
}

TEST(Server, AnswersManyRequestsOfOneConnectionInTheirOrder) {
  Server server(options(), echo);
  RawClient client(server.port());
  client.send(trusted("GET /1") + trusted("POST /2", kJson, "{}") +
              trusted("POST /3", kJson + "Transfer-Encoding: chunked\r\n") +
              "3\r\n{\"a\r\n5\r\n\": 1}\r\n0\r\n\r\n" + trusted("GET /4", "Connection: close\r\n"));
  EXPECT_EQ(client.reply().body, "GET /1 ");
  EXPECT_EQ(client.reply().body, "POST /2 {}");
  EXPECT_EQ(client.reply().body, "POST /3 {\"a\": 1}");
  EXPECT_EQ(client.reply().body, "GET /4 ");
  EXPECT_TRUE(client.is_ended());
}

TEST(Server, SaysThatABodyMayComeWhereItIsAsked) {
  Server server(options(), echo);
  RawClient client(server.port());
  client.send(trusted("POST /a", kJson + "Expect: 100-continue\r\nContent-Length: 2\r\n"));
  EXPECT_EQ(client.reply().status, 100);
  client.send("{}");
  EXPECT_EQ(client.reply().body, "POST /a {}");
}

TEST(Server, AddressLeadsToTheCookieAndTheCookieToThePage) {
  ServerOptions with_page = options();
  with_page.assets = {{"/index.html", "text/html; charset=utf-8", "<p>page</p>", false, "\"1\""}};
  Server server(with_page, echo);
  EXPECT_EQ(server.address(), fmt::format("http://127.0.0.1:{}/?token={}", server.port(), kToken));
  const Reply opened = reply_to(server.port(), request("GET /?token=" + kToken));
  EXPECT_EQ(opened.status, 303);
  EXPECT_EQ(opened.field("Location"), "/");
  const std::string cookie = opened.field("Set-Cookie");
  EXPECT_EQ(cookie,
            fmt::format("latsch_{}={}; Path=/; HttpOnly; SameSite=Strict", server.port(), kToken));
  const std::string kept = "Cookie: " + cookie.substr(0, cookie.find(';')) + "\r\n";
  EXPECT_EQ(reply_to(server.port(), request("GET /", kept)).body, "<p>page</p>");
  EXPECT_EQ(reply_to(server.port(), request("GET /api/x", kept)).body, "GET /api/x ");
  EXPECT_EQ(reply_to(server.port(), request("GET /?token=" + std::string(32, '0'), kept)).status,
            401);
}

// A browser that comes from another site follows a redirection without a SameSite=Strict cookie.
TEST(Server, AddressOpenedFromAnotherPageLeadsThereByAPageOfItsOwn) {
  Server server(options(), echo);
  const Reply opened =
      reply_to(server.port(),
               request("GET /?token=" + kToken,
                       "Sec-Fetch-Site: cross-site\r\nSec-Fetch-Mode: navigate\r\n"));
  EXPECT_EQ(opened.status, 200);
  EXPECT_THAT(opened.field("Set-Cookie"), HasSubstr(kToken));
  EXPECT_THAT(opened.body, HasSubstr("url=/"));
  EXPECT_THAT(opened.body, Not(HasSubstr(kToken)));
}

TEST(Server, RandomTokensDiffer) {
  Server one({}, echo), other({}, echo);
  EXPECT_EQ(one.token().size(), 32u);
  EXPECT_NE(one.token(), other.token());
  EXPECT_NE(one.port(), other.port());
}

TEST(Server, EveryAnswerHasTheFieldsForSafetyAndNoneOfCors) {
  Server server(options(), echo);
  for (const std::string& text : {trusted("GET /api/a"),
                                  trusted("GET /"),
                                  request("GET /"),
                                  request("OPTIONS /api/save", "Origin: http://localhost:1\r\n"),
                                  request("GET /?token=" + kToken),
                                  std::string("nonsense\r\n\r\n")}) {
    const Reply reply = reply_to(server.port(), text);
    EXPECT_THAT(reply.field("Content-Security-Policy"),
                HasSubstr("default-src 'none'; script-src 'self'"));
    EXPECT_THAT(reply.field("Content-Security-Policy"), HasSubstr("frame-ancestors 'none'"));
    EXPECT_EQ(reply.field("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(reply.field("Referrer-Policy"), "no-referrer");
    EXPECT_EQ(reply.field("Cross-Origin-Resource-Policy"), "same-origin");
    EXPECT_EQ(reply.field("Cache-Control"), "no-store");
    EXPECT_THAT(reply.head, Not(HasSubstr("Access-Control")));
  }
}

TEST(Server, RefusesBeforeItRoutes) {
  std::atomic<int> asked = 0;
  Server server(options(), [&](const Request&) -> Response {
    ++asked;
    return {};
  });
  const auto status = [&](const std::string& text) { return reply_to(server.port(), text).status; };
  const std::string bearer = "Authorization: Bearer " + kToken + "\r\n";
  EXPECT_EQ(status("GET / HTTP/1.1\r\nHost: evil.example\r\n" + bearer + "\r\n"), 421);
  EXPECT_EQ(status("GET / HTTP/1.1\r\n" + bearer + "\r\n"), 421);
  EXPECT_EQ(status("GET / HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\n" + bearer + "\r\n"),
            421);
  EXPECT_EQ(status(trusted("GET /api/a", "Origin: http://evil.example\r\n")), 403);
  EXPECT_EQ(status(trusted("GET /api/a", "Sec-Fetch-Site: same-site\r\n")), 403);
  EXPECT_EQ(status(trusted("DELETE /api/a")), 405);
  EXPECT_EQ(status(request("GET /api/a")), 401);
  EXPECT_EQ(status(request("GET /events?study=a")), 401);
  EXPECT_EQ(status(request("GET /api/ping")), 401);
  EXPECT_EQ(status(request("GET /?token=x")), 401);
  EXPECT_EQ(status(trusted("POST /api/a", "Content-Type: text/plain\r\n", "{}")), 415);
  EXPECT_EQ(status(trusted("GET /../../etc/passwd")), 400);
  EXPECT_EQ(status(trusted("GET /a?b=%ff")), 400);
  EXPECT_EQ(status(trusted("POST /a", kJson, "\"\xff\"")), 400);
  EXPECT_EQ(status("GET / HTTP/9.1\r\n\r\n"), 400);
  EXPECT_EQ(status("\x16\x03\x01\x02\r\n\r\n"), 400);  // the first bytes of an HTTPS connection
  EXPECT_EQ(asked, 0);
}

TEST(Server, TellsAPersonInPlainTextAndAScriptInJson) {
  Server server(options(), echo);
  const Reply script = reply_to(server.port(), request("GET /"));
  EXPECT_EQ(script.field("Content-Type"), "application/json");
  EXPECT_THAT(script.body, HasSubstr("{\"error\": \"the request shows no token"));
  const Reply person = reply_to(server.port(), request("GET /", "Accept: text/html,*/*\r\n"));
  EXPECT_EQ(person.field("Content-Type"), "text/plain; charset=utf-8");
  EXPECT_THAT(person.body, HasSubstr("open the address that latsch printed"));
}

// The body of a refused request is not read: it uses no memory, and the answer is sent before the
// body ends.
TEST(Server, RefusesALongBodyOrHeadAtOnce) {
  Server server(options(), echo);
  EXPECT_EQ(
      reply_to(server.port(), trusted("POST /a", kJson + "Content-Length: 1000000000\r\n")).status,
      413);
  EXPECT_EQ(
      reply_to(server.port(), trusted("GET /a", "X: " + std::string(20000, 'x') + "\r\n")).status,
      431);
  RawClient chunked(server.port());
  chunked.send(trusted("POST /a", kJson + "Transfer-Encoding: chunked\r\n") + "40000000\r\n");
  chunked.send(std::string(2 << 20, 'x'));
  EXPECT_EQ(chunked.reply().status, 413);
  const std::string most(1 << 20, 'x');
  EXPECT_EQ(reply_to(server.port(), trusted("POST /a", kJson, most)).body.size(), most.size() + 8);
}

TEST(Server, AnswersAlsoWhoStillSends) {
  Server server(options(), echo);
  RawClient client(server.port());
  client.send(request("POST /a", kJson + "Content-Length: 100000000\r\n"));
  EXPECT_GT(client.send(std::string(3 << 20, 'x')), 1u << 20);
  EXPECT_EQ(client.reply().status, 401);
  EXPECT_TRUE(client.is_ended(3s));
}

TEST(Server, WhatAHandlerThrowsIsAnAnswer) {
  std::string reported;
  ServerOptions with_report = options();
  with_report.report = [&](std::string_view text) { reported = text; };
  Server server(with_report, [](const Request& request) -> Response {
    if (request.path == "/input") throw InputError({"a.toml", 4}, "\"mass\" is \"1\x01\"");
    if (request.path == "/fault") throw std::logic_error("secret");
    throw 42;
  });
  const Reply input = reply_to(server.port(), trusted("GET /input"));
  EXPECT_EQ(input.status, 400);
  EXPECT_EQ(input.body, R"({"error": "a.toml:4: \"mass\" is \"1\u0001\"", "hint": ""})");
  for (const char* path : {"/fault", "/number"}) {
    const Reply fault = reply_to(server.port(), trusted(std::string("GET ") + path));
    EXPECT_EQ(fault.status, 500);
    EXPECT_THAT(fault.body, Not(HasSubstr("secret")));
    EXPECT_THAT(reported, HasSubstr(path));
  }
}

TEST(Server, PageIsAnsweredFromMemoryByItsTag) {
  const std::string zipped("\x1f\x8b\0raw", 6);
  ServerOptions with_page = options();
  with_page.assets = {{"/index.html", "text/html; charset=utf-8", "<p>", false, "\"h\""},
                      {"/page.js", "text/javascript", zipped, true, "\"j\""}};
  Server server(with_page, echo);
  EXPECT_EQ(reply_to(server.port(), trusted("GET /index.html")).body, "<p>");
  const Reply script = reply_to(server.port(), trusted("GET /page.js?v=1"));
  EXPECT_EQ(script.body, zipped);
  EXPECT_EQ(script.field("Content-Encoding"), "gzip");
  EXPECT_EQ(script.field("Content-Type"), "text/javascript");
  EXPECT_EQ(script.field("ETag"), "\"j\"");
  EXPECT_EQ(script.field("Cache-Control"), "no-cache");
  for (const char* tags : {"\"j\"", "W/\"j\"", "\"a\", \"j\"", "*"}) {
    const Reply same = reply_to(
        server.port(), trusted("GET /page.js", fmt::format("If-None-Match: {}\r\n", tags)));
    EXPECT_EQ(same.status, 304) << tags;
    EXPECT_EQ(same.field("ETag"), "\"j\"");
  }
  EXPECT_EQ(reply_to(server.port(), trusted("GET /page.js", "If-None-Match: \"h\"\r\n")).status,
            200);
  EXPECT_EQ(reply_to(server.port(), trusted("GET /page.css")).body, "GET /page.css ");
}

TEST(Server, WithoutAPageSaysSo) {
  Server server(options(), echo);
  const Reply reply = reply_to(server.port(), trusted("GET /"));
  EXPECT_EQ(reply.status, 200);
  EXPECT_THAT(reply.body, HasSubstr("built without Node"));
}

TEST(Server, TellsWhyItCannotListen) {
  Server server(options(), echo);
  const auto why = [](const std::string& listen, std::uint16_t port) -> std::string {
    ServerOptions there = options();
    there.listen = listen;
    there.port = port;
    try {
      Server another(there, echo);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(why("127.0.0.1", server.port()), HasSubstr("another program does"));
  // This address is reserved for documentation [RFC 5737], so no machine has it.
  EXPECT_THAT(why("192.0.2.1", 0), HasSubstr("no such address"));
  EXPECT_THAT(why("evil.example", 0), HasSubstr("expected an address"));
  EXPECT_EQ(why("localhost", 0), "");
}

// Both handler threads are busy. Requests that need no handler are answered anyway.
TEST(Server, SlowHandlersDelayNeitherPingsNorEvents) {
  std::latch both_begun(2), may_end(1);
  ServerOptions fast = options();
  fast.limits.alive = 20ms;
  Server server(fast, [&](const Request&) -> Response {
    both_begun.count_down();
    may_end.wait();
    return {};
  });
  RawClient one(server.port()), other(server.port()), events(server.port());
  one.send(trusted("GET /slow"));
  other.send(trusted("GET /slow"));
  both_begun.wait();
  EXPECT_EQ(reply_to(server.port(), trusted("GET /api/ping")).body, "{}");
  events.send(trusted("GET /events"));
  EXPECT_TRUE(events.read_to("event: alive\ndata: {}\n\n"));
  server.publish("", "home", "{}");
  EXPECT_TRUE(events.read_to("event: home\ndata: {}\n\n"));
  may_end.count_down();
  EXPECT_EQ(one.reply().status, 200);
  EXPECT_EQ(other.reply().status, 200);
}

TEST(Server, WhereTooMuchIsAskedAtOnceSaysSo) {
  std::latch begun(1), may_end(1);
  ServerOptions small = options();
  small.threads = 1;
  small.limits.waiting = 1;
  Server server(small, [&](const Request& request) -> Response {
    if (request.path == "/first") begun.count_down();
    may_end.wait();
    return {};
  });
  RawClient first(server.port()), second(server.port()), third(server.port());
  first.send(trusted("GET /first"));
  begun.wait();
  second.send(
      trusted("GET /"
              "x"));
  third.send(trusted("GET /x"));
  // One of two further requests waits in the queue, and there is no room for the other.
  while (!second.is_ended(10ms) && second.received().empty() && !third.is_ended(10ms) &&
         third.received().empty()) {
  }
  EXPECT_EQ((second.received().empty() ? third : second).reply().status, 503);
  may_end.count_down();
}

TEST(Server, EventsGoToWhoFollowsTheirTopic) {
  Server server(options(), echo);
  RawClient a(server.port()), b(server.port()), none(server.port());
  a.send(trusted("GET /events?study=tires/a.toml"));
  b.send(trusted("GET /events?study=b"));
  none.send(trusted("GET /events"));
  for (RawClient* client : {&a, &b, &none}) {
    ASSERT_TRUE(client->read_to("retry: 1000\n\n"));
    EXPECT_THAT(client->received(), HasSubstr("Content-Type: text/event-stream"));
    client->take(client->received().size());
  }
  server.publish("tires/a.toml", "trials", "{\"total\": 1}");
  server.publish("b", "trials", "{\"total\": 2}");
  server.publish("", "home", "{}");
  const std::string home = "event: home\ndata: {}\n\n";
  for (RawClient* client : {&a, &b, &none}) ASSERT_TRUE(client->read_to(home));
  EXPECT_EQ(a.received(), "event: trials\ndata: {\"total\": 1}\n\n" + home);
  EXPECT_EQ(b.received(), "event: trials\ndata: {\"total\": 2}\n\n" + home);
  EXPECT_EQ(none.received(), home);
}

// A client that reads nothing is disconnected; publishing never waits for it, and other clients
// receive all events.
TEST(Server, AClientThatReadsNoEventsIsEndedAndDelaysNobody) {
  ServerOptions silent = options();
  silent.limits.alive = 1h;
  Server server(silent, echo);
  RawClient slow(server.port(), 4096), fast(server.port());
  slow.send(trusted("GET /events"));
  fast.send(trusted("GET /events"));
  for (RawClient* client : {&slow, &fast}) {
    ASSERT_TRUE(client->read_to("retry: 1000\n\n"));
    client->take(client->received().size());
  }
  constexpr int kRounds = 128, kEvents = 8;
  // text of an event, sent often enough for 16 MB in total, which is more than the kernel buffers
  // for a socket
  const std::string filling(16000, 'x');
  for (int round = 0; round < kRounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kEvents; ++i)
      server.publish("", "trials", fmt::format("[{}, {}, \"{}\"]", round, i, filling));
    EXPECT_LT(seconds_since(start), 1.0);
    for (int i = 0; i < kEvents; ++i) {
      const std::string beginning = fmt::format("event: trials\ndata: [{}, {}, ", round, i);
      ASSERT_TRUE(fast.read_to("\"]\n\n"));
      ASSERT_EQ(fast.take(fast.received().find("\n\n") + 2).substr(0, beginning.size()), beginning);
    }
  }
  EXPECT_TRUE(slow.is_ended(2s));
}

TEST(Server, SlowOnesMakeRoomForNewOnes) {
  ServerOptions narrow = options();
  narrow.limits.connections = 4;
  Server server(narrow, echo);
  RawClient kept(server.port());
  kept.send(trusted("GET /a"));
  EXPECT_EQ(kept.reply().status, 200);
  std::vector<RawClient> slow;
  for (int i = 0; i < 20; ++i) {
    slow.emplace_back(server.port());
    slow.back().send("GET / HTTP/1.1\r\nHo");
  }
  EXPECT_EQ(reply_to(server.port(), trusted("GET /b")).body, "GET /b ");
  EXPECT_TRUE(slow.front().is_ended());
  kept.send(trusted("GET /c"));  // the client that showed the token is closed last
  EXPECT_EQ(kept.reply().body, "GET /c ");
}

TEST(Server, ARequestThatDoesNotEndIsEnded) {
  ServerOptions hasty = options();
  hasty.limits.request = 300ms;
  hasty.limits.idle = 300ms;
  Server server(hasty, echo);
  RawClient silent(server.port()), half_head(server.port()), half_body(server.port()),
      idle(server.port());
  half_head.send("GET / HTTP/1.1\r\nHost: loc");
  half_body.send(trusted("POST /a", kJson + "Content-Length: 9\r\n") + "{");
  idle.send(trusted("GET /a"));
  EXPECT_EQ(idle.reply().status, 200);
  EXPECT_EQ(half_head.reply().status, 408);
  EXPECT_EQ(half_body.reply().status, 408);
  EXPECT_TRUE(silent.is_ended());
  EXPECT_EQ(silent.received(), "");
  EXPECT_TRUE(idle.is_ended());
  EXPECT_EQ(idle.received(), "");
}

TEST(Server, AnAnswerOfWhichNothingIsTakenIsEnded) {
  ServerOptions hasty = options();
  hasty.limits.stalled = 300ms;
  Server server(hasty, [](const Request&) -> Response {
    return {200, "application/octet-stream", std::string(32 << 20, 'x')};
  });
  RawClient stalled(server.port(), 4096), reading(server.port());
  stalled.send(trusted("GET /a"));
  reading.send(trusted("GET /a"));
  EXPECT_EQ(reading.reply().body.size(), 32u << 20);
  std::this_thread::sleep_for(1s);
  EXPECT_TRUE(stalled.is_ended());
  EXPECT_LT(stalled.received().size(), 32u << 20);
}

TEST(Server, ClientsThatGoAwayInTheMiddleLeaveItAsItWas) {
  Server server(options(), [](const Request&) -> Response {
    std::this_thread::sleep_for(20ms);
    return {200, "text/plain", std::string(1 << 20, 'x')};
  });
  for (int i = 0; i < 20; ++i) {
    RawClient(server.port()).send(trusted("GET /a"));
    RawClient(server.port()).send(trusted("GET /events"));
    RawClient(server.port()).send(trusted("GET /api/ping") + "GET");
    RawClient(server.port()).send(trusted("POST /a", kJson + "Content-Length: 10\r\n"));
  }
  EXPECT_EQ(reply_to(server.port(), trusted("GET /api/ping")).body, "{}");
}

TEST(Server, EndsAllConnectionsAndTellsItsHandlers) {
  std::latch begun(1);
  std::atomic<bool> was_told = false;
  auto server = std::make_unique<Server>(options(), [&](const Request& request) -> Response {
    begun.count_down();
    while (!request.stop.stop_requested()) std::this_thread::sleep_for(1ms);
    was_told = true;
    return {};
  });
  const std::uint16_t port = server->port();
  RawClient silent(port), events(port), waiting(port);
  events.send(trusted("GET /events"));
  waiting.send(trusted("GET /a"));
  ASSERT_TRUE(events.read_to("retry"));
  begun.wait();
  const auto start = std::chrono::steady_clock::now();
  server.reset();
  EXPECT_LT(seconds_since(start), 1.0);
  EXPECT_TRUE(was_told);
  for (RawClient* client : {&silent, &events, &waiting}) EXPECT_TRUE(client->is_ended());
  ServerOptions again = options();
  again.port = port;
  // the port is free again after the first server has ended
  EXPECT_EQ(Server(again, echo).port(), port);
}

// A program that a handler starts must not inherit the server's sockets.
TEST(Server, ProgramsStartedMeanwhileInheritNoSocket) {
  Server server(options(), [](const Request&) -> Response {
    FILE* listing = ::popen("ls -l /proc/self/fd", "r");
    std::string text(10000, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), listing));
    ::pclose(listing);
    return {200, "text/plain", text};
  });
  RawClient events(server.port());
  events.send(trusted("GET /events"));
  ASSERT_TRUE(events.read_to("retry"));
  const std::string listing = reply_to(server.port(), trusted("GET /a")).body;
  EXPECT_THAT(listing, HasSubstr("pipe:"));
  EXPECT_THAT(listing, Not(HasSubstr("socket:")));
  EXPECT_THAT(listing, Not(HasSubstr("eventpoll")));
}

}  // namespace
}  // namespace latsch::studio
