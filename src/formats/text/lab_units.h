// SPDX-License-Identifier: Apache-2.0
// Units as laboratories write them into their files: "deg C", "1/min", "NM", "[-]", "°".
//
// The spelling of base/units.h holds; beyond it, as a tire rig means it and other sciences do not:
// upper and lower case do not count where the text is no unit as it stands, "C" is degrees Celsius,
// "S" seconds, "nm" newton meters, "lb" a force, "1/min" revolutions a minute, an empty unit a
// plain number.
#pragma once

#include <optional>
#include <string_view>

#include "base/units.h"

namespace latsch::formats {

/// Nothing where the text is no unit.
std::optional<Unit> find_lab_unit(std::string_view text);

}  // namespace latsch::formats
