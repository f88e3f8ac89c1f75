// SPDX-License-Identifier: Apache-2.0
// The views of the studio in a report. One script reads the answers, which the studio gets from a
// server, from the page itself.
//
// The chapters of the report are in the same file. They are shown without scripts and on paper. The
// script shows a chapter if its anchor is requested, and otherwise the views, each with its own
// style sheet.
#pragma once

#include <string>
#include <string_view>

namespace latsch::report {

struct LivePage {
  std::string answers;             // JSON object from requests to answers
  std::string_view script, style;  // script and style sheet of the page as a report
};

/// Returns the document from its beginning to the beginning of its chapters.
std::string live_page_begin(std::string_view title, const LivePage& live);
/// Returns the document from the end of its chapters.
std::string live_page_end(const LivePage& live);

}  // namespace latsch::report
