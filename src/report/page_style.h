// SPDX-License-Identifier: Apache-2.0
// Head and style sheet that every page contains.
#pragma once

#include <string>
#include <string_view>

namespace latsch::report {

/// Returns the beginning of a page up to its content; kPageEnd is the rest. The page is one file
/// that needs no other.
std::string page_begin(std::string_view title);
inline constexpr std::string_view kPageEnd = "</main>\n</body>\n</html>\n";

/// Returns a style sheet that is light or dark by the reader's setting, and always light on paper.
std::string_view style_sheet();

}  // namespace latsch::report
