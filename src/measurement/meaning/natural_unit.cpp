// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/natural_unit.h"

#include <array>
#include <utility>

namespace latsch {

std::string natural_unit(std::string_view si_unit) {
  using Pair = std::pair<std::string_view, std::string_view>;
  static constexpr std::array kNatural = {Pair{"rad", "deg"},
                                          Pair{"Pa", "kPa"},
                                          Pair{"m", "mm"},
                                          Pair{"K", "degC"},
                                          Pair{"m/s", "km/h"},
                                          Pair{"rad/s", "rpm"}};
  for (const auto& [si, natural] : kNatural)
    if (si == si_unit) return std::string(natural);
  return std::string(si_unit);
}

}  // namespace latsch
