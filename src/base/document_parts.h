// SPDX-License-Identifier: Apache-2.0
// A model can be made of models: the file of a car names those of its suspensions and tires. They
// are read as one document in which each part is a table whose numbers have paths of their own:
// front_tire = "ring.toml" gives "front_tire.sidewall.radial.stiffness".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/document.h"

namespace latsch {

/// Returns `whole` with the text at the top-level key `key` replaced by a table of everything in
/// `part`.
Document with_part(const Document& whole, std::string_view key, const Document& part);

/// Returns `whole` with the line that holds the text at this path alone ("bushing.ubj.file")
/// replaced by lines of other keys for the same table. The numbers of all later lines grow by the
/// number of added lines.
Document with_lines(const Document& whole,
                    std::string_view path,
                    const std::vector<std::string>& lines);

/// True if the part at the given key was read already, so that the key holds a table instead of a
/// file name.
bool has_part(const Document& whole, std::string_view key);

/// Returns the table at a top-level key as a separate document, under the file name of the whole
/// document.
Document part_of(const Document& whole, std::string_view key);

}  // namespace latsch
