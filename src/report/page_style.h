// SPDX-License-Identifier: Apache-2.0
// What every page carries in itself: head and style sheet; the viewer of the tire.
#pragma once

#include <string>
#include <string_view>

namespace latsch::report {

/// A page to the beginning of what it shows, and the rest of it: one file that needs no other.
std::string page_begin(std::string_view title);
inline constexpr std::string_view kPageEnd = "</main>\n</body>\n</html>\n";

/// Light and dark by the reader's setting, always light on paper.
std::string_view style_sheet();

/// Draws every canvas of class "tire" from the JSON in the element "tire-data": farther faces first
/// (painter's algorithm), shaded, colored by displacement; a drag turns it, modes swing while the
/// pointer is over them.
std::string_view viewer_script();

}  // namespace latsch::report
