// SPDX-License-Identifier: Apache-2.0
// Requests that a server of the studio has to refuse. Each is valid except for the fault that the
// function's name states.
#pragma once

#include <string>
#include <vector>

#include "attacked_server.h"

namespace latsch::benchmarks {

inline const std::string kJson = "Content-Type: application/json\r\n";

std::vector<std::string> wrong_hosts(const AttackedServer& server);
std::vector<std::string> wrong_origins(const AttackedServer& server);
std::vector<std::string> without_token(const AttackedServer& server);
/// Returns forms that a page of another site, evil.example, sends, and forms that a page from
/// another port of this machine sends, to which browsers add the cookie.
std::vector<std::string> cross_site_forms(const AttackedServer& server);
/// Returns requests for the file ../secret.toml outside the served folder and for files of the
/// operating system, named in the path or as a study.
std::vector<std::string> traversals(const AttackedServer& server);
std::vector<std::string> bad_utf8(const AttackedServer& server);

}  // namespace latsch::benchmarks
