// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/stated_difference.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"

namespace latsch::correlation {

void expect_difference(const Node& table,
                       const std::string& key,
                       const std::string& written,
                       const std::string& unit) {
  const auto stated = parse_quantity(written);
  if (!stated) return;
  const double factor = stated->unit.to_si(1.0L) - stated->unit.to_si(0.0L);
  if (stated->unit.to_si(0.0L) != 0.0)
    table.reject(key,
                 fmt::format("is {}, which is a temperature and no difference of temperatures; "
                             "expected \"{:.6g} K\"",
                             in_quotes(written),
                             factor * stated->unit.from_si(stated->si)));
  const auto compared = Unit::find(unit);
  if (stated->unit.dimensionless() && compared && compared->same_dimension(Unit::of("K")))
    table.reject(
        key,
        fmt::format("is {}, a share of a temperature, which would count from absolute zero; "
                    "expected a difference such as \"2 K\"",
                    in_quotes(written)));
}

double read_difference(const Node& table, const std::string& key, const std::string& unit) {
  std::string written;
  try {
    written = table.text(key);
  } catch (const InputError&) {
    // a plain number, which is in SI
  }
  // read first, because the last type that is read is recorded for the key
  const double value = table.quantity(key, unit, Range::positive());
  expect_difference(table, key, written, unit);
  return value;
}

}  // namespace latsch::correlation
