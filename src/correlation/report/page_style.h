// SPDX-License-Identifier: Apache-2.0
// What the page carries in itself: its style sheet and the viewer of the tire.
#pragma once

#include <string_view>

namespace latsch::report {

/// Light and dark by the reader's setting, always light on paper.
std::string_view style_sheet();

/// Draws every canvas of class "tire" from the JSON in the element "tire-data": farther faces first
/// (painter's algorithm), shaded, colored by displacement; a drag turns it, modes swing while the
/// pointer is over them.
std::string_view viewer_script();

}  // namespace latsch::report
