// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/inflation.h"

#include "base/units.h"

namespace latsch::experiment {

Inflation read_pressure(const Node& test, const MeasuredConditions& measured) {
  if (!test.has("pressure")) return std::nullopt;
  if (const auto from = find_measured(test, "pressure"))
    return measured_mean(*from, {"pressure", "Pa"}, measured);
  return test.quantity("pressure", "Pa", Range::positive());
}

std::string inflated(const Inflation& pressure) {
  return pressure ? ", " + format_quantity(*pressure, "bar", 4) : "";
}

}  // namespace latsch::experiment
