// SPDX-License-Identifier: Apache-2.0
// A model made of models: the file of a car names those of its suspensions and tires. Read together
// they are one document in which each part is a table, its numbers under paths of their own:
// front_tire = "ring.toml" gives "front_tire.sidewall.radial.stiffness".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/document.h"

namespace latsch {

/// `whole` with the text at the top key `key` replaced by a table of all that is in `part`.
Document with_part(const Document& whole, std::string_view key, const Document& part);

/// `whole` with the line on which the text at this path stands alone ("bushing.ubj.file") replaced
/// by lines of other keys for the same table. Lines behind it move down by what comes to it.
Document with_lines(const Document& whole,
                    std::string_view path,
                    const std::vector<std::string>& lines);

/// Whether the part of that key is read already: a table stands there.
bool has_part(const Document& whole, std::string_view key);

/// The table at a top key as a document of its own, under the file name of the whole.
Document part_of(const Document& whole, std::string_view key);

}  // namespace latsch
