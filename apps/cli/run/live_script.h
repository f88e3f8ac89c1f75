// SPDX-License-Identifier: Apache-2.0
// The script and the style sheet of the studio's views for a report, as the program holds them.
#pragma once

#include <string>

namespace latsch::cli {

struct LiveScript {
  std::string script, style;  // empty: the program was built without the page
};
LiveScript live_script();

}  // namespace latsch::cli
