// SPDX-License-Identifier: Apache-2.0
// The script and the style sheet that draw the studio's views in a report. The program contains
// both.
#pragma once

#include <string>

namespace latsch::cli {

struct LiveScript {
  std::string script, style;  // empty: the program was built without the page
};
LiveScript live_script();

}  // namespace latsch::cli
