// SPDX-License-Identifier: Apache-2.0
// The unit in which people write a quantity: the unit that a message proposes for a column which
// has none. Files of rigs seldom hold radians, pascals or kelvin, so a user who copied a proposal
// in SI would get wrong numbers.
#pragma once

#include <string>
#include <string_view>

namespace latsch {

/// "deg" for "rad", "kPa" for "Pa", "mm" for "m", "degC" for "K", "km/h" for "m/s", "rpm" for
/// "rad/s"; any other SI unit stays.
std::string natural_unit(std::string_view si_unit);

}  // namespace latsch
