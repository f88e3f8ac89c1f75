// SPDX-License-Identifier: Apache-2.0
// Adds the interactive views of the studio to a report. The same script serves both: in the studio
// it requests JSON answers from a server, in the report it reads them from the page itself.
//
// The chapters of the report are in the same file. They are shown if scripts are disabled and on
// paper. The script shows a chapter if the address names its anchor, and otherwise the views.
// Chapters and views have separate style sheets.
#pragma once

#include <string>
#include <string_view>

namespace latsch::report {

struct LivePage {
  std::string answers;             // JSON object: for each request of the views, the answer
  std::string_view script, style;  // script and style sheet of the views in a report
};

/// Returns the document up to the beginning of its chapters.
std::string live_page_begin(std::string_view title, const LivePage& live);
/// Returns the rest of the document after its chapters.
std::string live_page_end(const LivePage& live);

}  // namespace latsch::report
