// SPDX-License-Identifier: Apache-2.0
// Reads a road from a table, which is a file of its own or part of another document.
//
// The keys `friction` (of the road) and `obstacle_friction` (of an obstacle on it) are factors with
// the default 1.
//
// All keys are listed in experiment/tests/keys/roads_keys.cpp.
#pragma once

#include <memory>

#include "base/document.h"
#include "models/road/kerb.h"
#include "models/road/road.h"

namespace latsch::road {

/// Makes the road that the table describes. Throws InputError with file and line if a value is
/// wrong or a key is unknown.
std::unique_ptr<Road> read_road(const Node& table);

/// Returns true if the `kind` of the table is that of a road.
bool is_road(const Node& table);

/// Reads a table whose `kind` must be "kerb".
Kerb read_kerb(const Node& table);

}  // namespace latsch::road
