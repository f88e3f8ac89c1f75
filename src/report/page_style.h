// SPDX-License-Identifier: Apache-2.0
// What every page carries in itself: head and style sheet.
#pragma once

#include <string>
#include <string_view>

namespace latsch::report {

/// A page to the beginning of what it shows, and the rest of it: one file that needs no other.
std::string page_begin(std::string_view title);
inline constexpr std::string_view kPageEnd = "</main>\n</body>\n</html>\n";

/// Light and dark by the reader's setting, always light on paper.
std::string_view style_sheet();

}  // namespace latsch::report
