// SPDX-License-Identifier: Apache-2.0
// Writes a tire as a CalculiX deck (mm, N, tonne, s): inflation, load against flat ground,
// frequencies.
//
// The deck has the same mesh, laws and loads for an independent program. CalculiX has no rebars;
// every layer of cords in an element becomes a cord slice (ccx_cords.h). CalculiX 2.20 counts the
// load stiffness of the pressure twice in a prestressed frequency step, so that step has half the
// pressure.
//
// A ring of sectors of unequal width does not stay round: with equal stress, narrow and wide facets
// pull differently along the circumference, by about the square of their width, and a tire bends
// easily. A 205/55R16 of 40 sectors, 2.4 to 13.1 degrees wide, grows in CalculiX 2.20 by 1.272 mm
// at its narrow sectors and by 1.380 mm at its wide ones; with 40 equal sectors it grows by 1.366
// mm everywhere, in Latsch by 1.375 mm. Latsch inflates a tire by equal sectors, and so does a deck
// without ground. A deck with ground has the zones, because the patch needs narrow sectors: the
// tire above, pressed by 20 mm, carries 3916 N, in Latsch 3954 N.
//
// Comments (inp_remarks.h) state walls, tread and planes, which CalculiX has no card for, so that
// the deck is read back as the same tire.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/element/materials.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::formats {

struct CcxGround {
  double radius = 0.0;        // m, from wheel center to ground before the ground moves
  double travel = 0.0;        // m, of the ground toward the wheel center
  double stiffness = 2.0e10;  // Pa/m
  double mu = 0.0;
};

struct CcxRun {
  std::string title;
  double pressure = 0.0;            // Pa
  std::optional<CcxGround> ground;  // none: no load step
  int load_increments = 5;          // number of increments of the travel
  int modes = 20;                   // 0: no frequency step
  bool loaded_modes = true;         // false: modes of the inflated tire, before the load step
  /// Element of the deck: C3D8, or C3D8I with incompatible modes in place of the solid shell.
  fe_tire::ElementKind element = fe_tire::ElementKind::full_integration;
};

/// Throws InputError if a layer of cords has a pretension.
void write_ccx_deck(std::ostream& out,
                    const fe_tire::Mesh& mesh,
                    const fe_tire::Materials& materials,
                    const CcxRun& run);
void write_ccx_deck(const std::filesystem::path& file,
                    const fe_tire::Mesh& mesh,
                    const fe_tire::Materials& materials,
                    const CcxRun& run);

}  // namespace latsch::formats
