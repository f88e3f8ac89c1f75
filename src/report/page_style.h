// SPDX-License-Identifier: Apache-2.0
// HTML head and style sheet of every page that the program writes.
#pragma once

#include <string>
#include <string_view>

namespace latsch::report {

/// Returns the beginning of a page up to its content; kPageEnd is the end after the content. The
/// page needs no other file.
std::string page_begin(std::string_view title);
inline constexpr std::string_view kPageEnd = "</main>\n</body>\n</html>\n";

/// Returns a style sheet that is light or dark as the reader's browser is set, and always light on
/// paper.
std::string_view style_sheet();

}  // namespace latsch::report
