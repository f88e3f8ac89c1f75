// SPDX-License-Identifier: Apache-2.0
// A road is described by a table, in a file of its own or inline.
//
// friction (of the road) and obstacle_friction (of an obstacle on it) are factors, default 1.
//
// The keys are in experiment/tests/keys/roads_keys.cpp.
#pragma once

#include <memory>

#include "base/document.h"
#include "models/road/kerb.h"
#include "models/road/road.h"

namespace latsch::road {

/// Throws InputError naming the place, for unknown keys too.
std::unique_ptr<Road> read_road(const Node& table);

/// True if `kind` is that of a road.
bool is_road(const Node& table);

/// Reads a road of kind "kerb" only.
Kerb read_kerb(const Node& table);

}  // namespace latsch::road
