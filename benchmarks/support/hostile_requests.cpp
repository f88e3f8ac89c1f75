// SPDX-License-Identifier: Apache-2.0
#include "hostile_requests.h"

#include <fmt/format.h>

namespace latsch::benchmarks {

std::vector<std::string> wrong_hosts(const AttackedServer& server) {
  std::vector<std::string> requests;
  for (const char* host : {"evil.example",
                           "evil.example:{}",
                           "localhost.evil.example:{}",
                           "127.0.0.1.evil.example:{}",
                           "localhost:{}@evil.example",
                           "192.168.1.5:{}",
                           "2130706433:{}",
                           "[::2]:{}",
                           ""}) {
    std::string text = server.trusted("GET /api/home");
    const std::size_t at = text.find("127.0.0.1"), end = text.find("\r\n", at);
    requests.push_back(text.replace(at, end - at, fmt::format(fmt::runtime(host), server.port())));
  }
  requests.push_back("GET /api/home HTTP/1.1\r\nAuthorization: Bearer " + server.token() +
                     "\r\n\r\n");
  requests.push_back(server.trusted("GET /api/home", "Host: evil.example\r\n"));
  requests.push_back(server.trusted("GET http://evil.example/api/home"));
  return requests;
}

std::vector<std::string> wrong_origins(const AttackedServer& server) {
  std::vector<std::string> requests;
  for (const char* origin :
       {"http://evil.example", "null", "http://127.0.0.1:3000", "https://127.0.0.1", "file://"})
    for (const char* line : {"GET /api/home", "POST /api/run", "GET /events", "GET /"})
      requests.push_back(server.trusted(line, fmt::format("{}Origin: {}\r\n", kJson, origin)));
  requests.push_back(
      server.trusted("OPTIONS /api/run",
                     "Origin: http://evil.example\r\nAccess-Control-Request-Method: POST\r\n"));
  requests.push_back(
      server.trusted("GET /api/home", "Sec-Fetch-Site: same-site\r\nSec-Fetch-Mode: no-cors\r\n"));
  return requests;
}

std::vector<std::string> without_token(const AttackedServer& server) {
  std::vector<std::string> requests;
  std::string near = server.token();
  near.back() = near.back() == '0' ? '1' : '0';
  for (const char* line : {"GET /",
                           "GET /api/home",
                           "GET /api/file?study=study.toml",
                           "GET /events",
                           "POST /api/run",
                           "HEAD /"}) {
    for (const std::string& fields : {std::string(),
                                      "Authorization: Bearer " + near + "\r\n",
                                      std::string("Authorization: Bearer \r\n"),
                                      fmt::format("Cookie: latsch_{}={}\r\n", server.port(), near),
                                      fmt::format("Cookie: latsch_1={}\r\n", server.token())})
      requests.push_back(server.request(line, kJson + fields));
  }
  requests.push_back(server.request("GET /?token=" + near));
  requests.push_back(server.request("GET /api/home?token=" + server.token()));
  return requests;
}

std::vector<std::string> cross_site_forms(const AttackedServer& server) {
  std::vector<std::string> requests;
  const std::string cookie = fmt::format("Cookie: latsch_{}={}\r\n", server.port(), server.token());
  for (const char* type :
       {"application/x-www-form-urlencoded", "text/plain", "multipart/form-data; boundary=x"}) {
    const std::string typed = fmt::format("Content-Type: {}\r\n", type);
    const std::string body = R"({"study": "study.toml", "verb": "run", "x=": 1})";
    requests.push_back(
        server.request("POST /api/run", typed + "Origin: http://evil.example\r\n", body));
    requests.push_back(server.request(
        "POST /api/run", typed + cookie + "Origin: http://127.0.0.1:3000\r\n", body));
    requests.push_back(server.request("POST /api/run", typed + cookie + "Origin: null\r\n", body));
    requests.push_back(server.request("POST /api/run", typed + cookie, body));
  }
  return requests;
}

std::vector<std::string> traversals(const AttackedServer& server) {
  std::vector<std::string> requests;
  for (const char* path : {"../secret.toml",
                           "..%2fsecret.toml",
                           "%2e%2e/secret.toml",
                           "..%5csecret.toml",
                           "..\\secret.toml",
                           "%c0%ae%c0%ae/secret.toml",
                           "....//secret.toml",
                           "x/../../secret.toml",
                           "study.toml/../../secret.toml",
                           "../../../../../../../../etc/passwd",
                           "/etc/passwd",
                           "%2fetc%2fpasswd",
                           "file:///etc/passwd",
                           "model.awk",  // a file in the folder that is not a study
                           "/proc/self/environ",
                           "study.toml%00.html",
                           "~/.ssh/id_rsa"}) {
    requests.push_back(server.trusted(fmt::format("GET /{}", path)));
    requests.push_back(server.trusted(fmt::format("GET /api/{}", path)));
    requests.push_back(server.trusted(fmt::format("GET /api/file?study={}", path)));
    requests.push_back(server.trusted(fmt::format("GET /api/study?study={}", path)));
    requests.push_back(server.trusted(
        "POST /api/check", kJson, fmt::format(R"({{"study": "{}", "text": ""}})", path)));
  }
  return requests;
}

std::vector<std::string> bad_utf8(const AttackedServer& server) {
  std::vector<std::string> requests;
  for (const char* bytes :
       {"%ff", "%c0%af", "%ed%a0%80", "%f4%90%80%80", "%e2%82", "\xff", "%00", "%zz"}) {
    requests.push_back(server.trusted(fmt::format("GET /api/{}", bytes)));
    requests.push_back(server.trusted(fmt::format("GET /api/study?study={}", bytes)));
    requests.push_back(server.trusted(fmt::format("GET /events?{}=", bytes)));
  }
  for (const char* body : {"\xff", "{\"study\": \"\xc0\xaf\"}", "\xed\xa0\x80", "\xf5\x80\x80\x80"})
    requests.push_back(server.trusted("POST /api/check", kJson, body));
  return requests;
}

}  // namespace latsch::benchmarks
