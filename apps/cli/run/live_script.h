// SPDX-License-Identifier: Apache-2.0
// The script and the style sheet of the studio's views for a report, contained in the program.
#pragma once

#include <string>

namespace latsch::cli {

struct LiveScript {
  std::string script, style;  // empty: the program was built without the page
};
LiveScript live_script();

}  // namespace latsch::cli
