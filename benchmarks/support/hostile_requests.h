// SPDX-License-Identifier: Apache-2.0
// Requests that a server of the studio has to refuse, each valid except for the fault in its name.
#pragma once

#include <string>
#include <vector>

#include "attacked_server.h"

namespace latsch::benchmarks {

inline const std::string kJson = "Content-Type: application/json\r\n";

std::vector<std::string> wrong_hosts(const AttackedServer& server);
std::vector<std::string> wrong_origins(const AttackedServer& server);
std::vector<std::string> without_token(const AttackedServer& server);
/// Returns forms as sent by a page of evil.example, and by a page of another port of this machine,
/// to which browsers add the cookie.
std::vector<std::string> cross_site_forms(const AttackedServer& server);
/// Returns requests for ../secret.toml from the served folder, and for files of the system, in the
/// path and as the name of a study.
std::vector<std::string> traversals(const AttackedServer& server);
std::vector<std::string> bad_utf8(const AttackedServer& server);

}  // namespace latsch::benchmarks
