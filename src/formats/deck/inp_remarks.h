// SPDX-License-Identifier: Apache-2.0
// Comments of an .inp file that state what the tire has and the language has no card for. Other
// programs ignore them; `latsch export --ccx` writes them, so that a deck comes back as its tire.
//
//   ** latsch wall: SET, 8.5, 1         elements that bend as a wall of this thickness (0: as
//                                       none), in a layer of this number of elements (0: in none)
//   ** latsch tread: SET                elements whose outer face may touch the ground
//   ** latsch planes: 0, 2.4, 4.8, ...  angles in degrees from the bottom, one for every sector, by
//                                       which the standing tire is divided; the next such comment
//                                       continues the list
//
// Set names are those of *ELSET. A number without sense is refused with its line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace latsch::formats {

struct InpRemarks {
  struct Wall {
    std::string elset;
    double thickness = 0.0;  // in the length unit of the file
    int layer_rows = 0;
    Place place;
  };
  struct Tread {
    std::string elset;
    Place place;
  };
  std::vector<Wall> walls;
  std::vector<Tread> treads;
  std::vector<double> planes;  // rad; empty: not stated
  Place planes_place;
};

/// Throws InputError naming the line of a remark that is malformed.
InpRemarks stated_remarks(std::string_view text, const std::string& file_name);

}  // namespace latsch::formats
