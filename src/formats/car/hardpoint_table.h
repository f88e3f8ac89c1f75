// SPDX-License-Identifier: Apache-2.0
// Hardpoints as a table from drawings and spreadsheets: one in each row, its coordinates in the
// axes of the suspension (x forward, y left, z up) with the unit of each column. Names are those of
// a suspension's [hardpoint] (models/suspension/suspension_reader.h). If a table has several
// corners, a column `of` names the corner of each point.
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
  std::array<std::string, 3> place;  // text with units: "1648.347 mm"
  int line = 0;                      // line in the table
};

/// Reads the hardpoints of the corner `of`, which is empty if the table has no such column. Throws
/// InputError that names file and line for an invalid column, name or number, a unit that is no
/// length, a point that occurs twice, and a corner that does not exist or is not chosen.
std::vector<Hardpoint> read_hardpoints(const std::filesystem::path& file,
                                       const std::optional<std::string>& of);

}  // namespace latsch::formats
