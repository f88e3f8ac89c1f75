// SPDX-License-Identifier: Apache-2.0
// Comments of an .inp file that state properties of the tire for which the language has no card.
// Other programs ignore them; `latsch export --ccx` writes them, so that its decks are read back as
// the same tire.
//
//   ** latsch wall: SET, 8.5, 1         these elements form a wall that bends, of this thickness
//                                       (0: no wall), with this number of elements through the
//                                       layer (0: no layer)
//   ** latsch tread: SET                elements whose outer face may touch the ground
//   ** latsch planes: 0, 2.4, 4.8, ...  angles in degrees from the bottom of the planes between
//                                       the sectors of the tire on the ground; a further comment
//                                       of this kind continues the list
//
// Set names are those of *ELSET. An invalid number is refused with its line.
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

/// Returns the statements of these comments in the text. Throws InputError, with the line, for a
/// malformed one.
InpRemarks stated_remarks(std::string_view text, const std::string& file_name);

}  // namespace latsch::formats
