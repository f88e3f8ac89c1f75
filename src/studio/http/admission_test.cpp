// SPDX-License-Identifier: Apache-2.0
#include "studio/http/admission.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace latsch::studio {
namespace {

const std::string kToken = "0123456789abcdef0123456789abcdef";

Admission loopback() { return Admission("127.0.0.1", 8421, kToken, {}); }

Head asking(const std::string& host) {
  Head head;
  head.method = "GET";
  head.target = "/api/home";
  head.hosts = 1;
  head.host = host;
  return head;
}

int status(const std::optional<Refusal>& refusal) { return refusal ? refusal->status : 200; }

TEST(Admission, OfLoopbackTakesNamesOfLoopbackOnAnyPort) {
  for (const char* host :
       {"127.0.0.1:8421", "localhost:8421", "LocalHost:9000", "[::1]:8421", "127.0.0.1"})
    EXPECT_EQ(status(loopback().refuse_stranger(asking(host))), 200) << host;
}

// DNS rebinding: a page of evil.example whose name leads to 127.0.0.1 sends its own name as Host.
TEST(Admission, RefusesEveryOtherHost) {
  for (const char* host : {"",
                           "evil.example:8421",
                           "evil.example",
                           "localhost.evil.example",
                           "127.0.0.1.evil.example:8421",
                           "localhost:8421@evil.example",
                           "evil.example:localhost",
                           "localhost.:8421",
                           "192.168.1.5:8421",
                           "0.0.0.0:8421",
                           "[::1",
                           "[::1]evil:1",
                           "127.0.0.1:123456",
                           "2130706433:8421"}) {
    EXPECT_EQ(status(loopback().refuse_stranger(asking(host))), 421) << host;
  }
  Head head = asking("127.0.0.1:8421");
  head.hosts = 2;
  EXPECT_EQ(status(loopback().refuse_stranger(head)), 421);
  head.hosts = 0;
  EXPECT_EQ(status(loopback().refuse_stranger(head)), 421);
}

TEST(Admission, OfAllAddressesTakesAnyAddressButOnlyNamesItWasGiven) {
  const Admission all("0.0.0.0", 8421, kToken, {"Rig-PC"});
  for (const char* host : {"192.168.1.5:8421", "[fe80::1]:8421", "localhost:1", "rig-pc:8421"})
    EXPECT_EQ(status(all.refuse_stranger(asking(host))), 200) << host;
  for (const char* host : {"evil.example:8421", "rig-pc.evil.example:8421", "[evil]:8421"})
    EXPECT_EQ(status(all.refuse_stranger(asking(host))), 421) << host;
  const Admission one("192.168.1.5", 8421, kToken, {});
  EXPECT_EQ(status(one.refuse_stranger(asking("192.168.1.5:8421"))), 200);
  EXPECT_EQ(status(one.refuse_stranger(asking("192.168.1.6:8421"))), 421);
}

TEST(Admission, TakesOnlyItsOwnOrigin) {
  Head head = asking("localhost:8421");
  for (const char* origin : {"http://localhost:8421", "HTTP://LOCALHOST:8421"}) {
    head.origin = origin;
    EXPECT_EQ(status(loopback().refuse_stranger(head)), 200) << origin;
  }
  for (const char* origin : {"null",
                             "http://localhost:3000",  // another program on this machine
                             "http://localhost",
                             "http://127.0.0.1:8421",
                             "https://localhost:8421",
                             "http://evil.example"}) {
    head.origin = origin;
    EXPECT_EQ(status(loopback().refuse_stranger(head)), 403) << origin;
  }
}

TEST(Admission, OtherPagesMayOpenThePageAndNothingElse) {
  Head head = asking("localhost:8421");
  for (const char* site : {"cross-site", "same-site"}) {
    head.fetch_site = site;
    head.fetch_mode = "no-cors";
    head.target = "/api/home";
    EXPECT_EQ(status(loopback().refuse_stranger(head)), 403);
    head.fetch_mode = "navigate";
    EXPECT_EQ(status(loopback().refuse_stranger(head)), 403);
    head.target = "/?token=" + kToken;
    EXPECT_EQ(status(loopback().refuse_stranger(head)), 200);
  }
  head = asking("localhost:8421");
  for (const char* site : {"same-origin", "none"}) {
    head.fetch_site = site;
    EXPECT_EQ(status(loopback().refuse_stranger(head)), 200);
  }
}

TEST(Admission, KnowsThreeMethods) {
  Head head = asking("localhost:8421");
  for (const char* method : {"OPTIONS", "PUT", "DELETE", "TRACE", "CONNECT", "get", ""}) {
    head.method = method;
    EXPECT_EQ(status(loopback().refuse_stranger(head)), 405) << method;
  }
}

TEST(Admission, WantsTheTokenAsBearerOrCookie) {
  Head head = asking("localhost:8421");
  EXPECT_EQ(status(loopback().refuse_untrusted(head)), 401);
  for (const std::string& text : {"Bearer " + kToken, "bearer  " + kToken}) {
    head.authorization = text;
    EXPECT_EQ(status(loopback().refuse_untrusted(head)), 200) << text;
  }
  for (const std::string& text : {std::string("Bearer"),
                                  std::string("Bearer "),
                                  "Bearer " + kToken.substr(1),
                                  "Bearer " + kToken + "0",
                                  "Bearer 1" + kToken.substr(1),
                                  "Basic " + kToken}) {
    head.authorization = text;
    EXPECT_EQ(status(loopback().refuse_untrusted(head)), 401) << text;
  }
  head.authorization.clear();
  for (const std::string& text : {"latsch_8421=" + kToken,
                                  "a=b; latsch_8421=" + kToken + "; c",
                                  "latsch_8421=of another program; latsch_8421=" + kToken}) {
    head.cookie = text;
    EXPECT_EQ(status(loopback().refuse_untrusted(head)), 200) << text;
  }
  for (const std::string& text : {"latsch_8422=" + kToken,
                                  std::string("latsch_8421="),
                                  "xlatsch_8421=" + kToken,
                                  "latsch_8421 " + kToken}) {
    head.cookie = text;
    EXPECT_EQ(status(loopback().refuse_untrusted(head)), 401) << text;
  }
}

// Forms can send these content types without a preflight [Fetch, CORS-safelisted request headers].
TEST(Admission, WantsJsonOfAPost) {
  Head head = asking("localhost:8421");
  head.authorization = "Bearer " + kToken;
  head.method = "POST";
  for (const char* type : {"",
                           "text/plain",
                           "application/x-www-form-urlencoded",
                           "multipart/form-data",
                           "text/plain; application/json"}) {
    head.content_type = type;
    EXPECT_EQ(status(loopback().refuse_untrusted(head)), 415) << type;
  }
  for (const char* type : {"application/json", "Application/JSON; charset=utf-8"}) {
    head.content_type = type;
    EXPECT_EQ(status(loopback().refuse_untrusted(head)), 200) << type;
  }
}

TEST(Admission, TokensAreLongRandomAndOfPlainCharacters) {
  const std::string one = random_token();
  EXPECT_EQ(one.size(), 32u);
  EXPECT_EQ(one.find_first_not_of("0123456789abcdef"), one.npos);
  EXPECT_NE(one, random_token());
  EXPECT_THROW(Admission("127.0.0.1", 1, "short", {}), InputError);
  EXPECT_THROW(Admission("127.0.0.1", 1, "0123456789abcdef; Path=/x", {}), InputError);
}

}  // namespace
}  // namespace latsch::studio
