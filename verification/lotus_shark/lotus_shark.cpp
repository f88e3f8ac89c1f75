// SPDX-License-Identifier: Apache-2.0
#include "lotus_shark/lotus_shark.h"

#include <map>

#include "base/units.h"
#include "formats/tables/csv_table.h"

namespace latsch::verification {

using formats::CsvTable;
using namespace suspension;

CornerGeometry lotus_corner() {
  const CsvTable table = CsvTable::read(LATSCH_LOTUS_SHARK "/hardpoints.csv");
  const auto columns = table.numbers({{"x", "m"}, {"y", "m"}, {"z", "m"}});
  std::map<std::string, Eigen::Vector3d> at;
  for (int i = 0; i < table.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    at[table.text("point", i)] = {-columns[0][k], columns[1][k], columns[2][k]};
  }
  CornerGeometry corner;
  corner.linkage.links = {{{"uca_front", at["uca_front"], at["ubj"]},
                           {"uca_rear", at["uca_rear"], at["ubj"]},
                           {"lca_front", at["lca_front"], at["lbj"]},
                           {"lca_rear", at["lca_rear"], at["lbj"]},
                           {"trackrod", at["trackrod_inner"], at["trackrod_outer"]}}};
  corner.linkage.wheel = {.side = Side::right, .center = at["wheel_center"], .radius = 0.225};
  corner.spring.on = SpringDrive::On::upper_wishbone;
  corner.spring.outer = at["damper_on_upper_wishbone"];
  corner.spring.inner = at["damper_on_chassis"];
  corner.spring.hinge_front = at["uca_front"];
  corner.spring.hinge_rear = at["uca_rear"];
  corner.spring.ball = at["ubj"];
  corner.kingpin = {at["lbj"], at["ubj"]};
  return corner;
}

std::vector<PrintedValue> lotus_printed_values() {
  const CsvTable table = CsvTable::read(LATSCH_LOTUS_SHARK "/printed.csv");
  const std::vector<double> values = table.numbers("value", "1");
  const std::vector<double> tolerances = table.numbers("tolerance", "1");
  std::vector<PrintedValue> printed;
  for (int i = 0; i < table.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double unit = table.text("unit", i) == "deg" ? M_PI / 180.0 : 1e-3;
    printed.push_back({table.text("output", i), values[k] * unit, tolerances[k] * unit});
  }
  return printed;
}

}  // namespace latsch::verification
