// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/section_columns.h"

#include <cmath>
#include <utility>

namespace latsch::fe_tire {

std::vector<double> columns_of(const Section& section) {
  const double half = 0.5 * section.meridional;
  std::vector<double> columns = {0.0};
  for (double i = half - std::floor(half); i < half; i += 1.0) {
    if (i > 0.0) columns.push_back(section.station(half + i));
  }
  columns.push_back(1.0);
  return columns;
}

TireDescription with_columns(TireDescription tire, std::vector<double> columns) {
  tire.section.meridional = 2 * (static_cast<int>(columns.size()) - 1);
  tire.section.spacing = {};
  tire.section.columns = std::move(columns);
  return tire;
}

}  // namespace latsch::fe_tire
