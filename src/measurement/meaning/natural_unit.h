// SPDX-License-Identifier: Apache-2.0
// The unit in which people usually write a quantity. A message proposes it for a column without
// unit, because files of rigs seldom contain radians, pascals or kelvin, and a user who copied a
// proposal in SI would get wrong numbers.
#pragma once

#include <string>
#include <string_view>

namespace latsch {

/// Returns "deg" for "rad", "kPa" for "Pa", "mm" for "m", "degC" for "K", "km/h" for "m/s", "rpm"
/// for "rad/s"; any other SI unit unchanged.
std::string natural_unit(std::string_view si_unit);

}  // namespace latsch
