// SPDX-License-Identifier: Apache-2.0
// Files of the studio's web page, built by npm and compressed into the program: index.html with its
// scripts and styles for the server; report/report.js and report/report.css for a report in one
// file. Empty if latsch is built without npm.
#pragma once

#include <vector>

#include "studio/http/server.h"

namespace latsch::studio {

std::vector<Asset> web_assets();

}  // namespace latsch::studio
