// SPDX-License-Identifier: Apache-2.0
// The views of the studio in a report: one script that finds the answers it would ask a server for
// in the page itself.
//
// The chapters of the report stand in the same file. They are what is seen without scripts and on
// paper; the script shows them where an anchor of theirs is asked for and itself otherwise, each
// under its own style sheet.
#pragma once

#include <string>
#include <string_view>

namespace latsch::report {

struct LivePage {
  std::string answers;             // JSON: requests to answers
  std::string_view script, style;  // of the page as a report
};

/// From the document's beginning to that of its chapters.
std::string live_page_begin(std::string_view title, const LivePage& live);
/// From the chapters' end to that of the document.
std::string live_page_end(const LivePage& live);

}  // namespace latsch::report
