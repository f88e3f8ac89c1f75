// SPDX-License-Identifier: Apache-2.0
// Hardpoints as a table, as drawings and spreadsheets hand them out: one a row, its coordinates in
// the axes of the suspension (x forward, y left, z up) with the unit of each column. Names are
// those of a suspension's [hardpoint] (models/suspension/suspension_reader.h). Of several corners
// in one table a column `of` says which a point belongs to.
//
//   of, name,         x [mm],   y [mm],  z [mm]
//   FL, uca_front,    1648.347, 273.206, 303.434
//   FL, wheel_center, 1550,     612.5,   235
//   RL, uca_front,    125.161,  318.339, 314.902
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"

namespace latsch::formats {

struct Hardpoint {
  std::string name;
  std::array<std::string, 3> place;  // as written, with units: "1648.347 mm"
  int line = 0;                      // of the table
};

/// Those of one corner; `of`: nothing where the table has no such column. Throws InputError naming
/// file and line: a column, name or number that is none, a unit that is no length, a point that
/// comes twice, a corner that is not there or not asked for.
std::vector<Hardpoint> read_hardpoints(const std::filesystem::path& file,
                                       const std::optional<std::string>& of);

}  // namespace latsch::formats
