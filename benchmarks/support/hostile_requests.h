// SPDX-License-Identifier: Apache-2.0
// Requests that a server of the studio has to refuse, each good but for what it is named after.
#pragma once

#include <string>
#include <vector>

#include "attacked_server.h"

namespace latsch::benchmarks {

inline const std::string kJson = "Content-Type: application/json\r\n";

std::vector<std::string> wrong_hosts(const AttackedServer& server);
std::vector<std::string> wrong_origins(const AttackedServer& server);
std::vector<std::string> without_token(const AttackedServer& server);
/// As a page of evil.example sends them, and as a page of another port of this machine does, to
/// which browsers add the cookie.
std::vector<std::string> cross_site_forms(const AttackedServer& server);
/// To ../secret.toml from the folder that is served, and to files of the system, in the path and as
/// the name of a study.
std::vector<std::string> traversals(const AttackedServer& server);
std::vector<std::string> bad_utf8(const AttackedServer& server);

}  // namespace latsch::benchmarks
