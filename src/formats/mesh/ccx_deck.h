// SPDX-License-Identifier: Apache-2.0
// Writes a tire as a CalculiX deck (mm, N, tonne, s): inflation, load against flat ground,
// frequencies.
//
// The deck has the same mesh, material laws and loads as the tire, for computation by an
// independent program. CalculiX has no rebars; every layer of cords in an element becomes a spring
// (ccx_cords.h). CalculiX 2.20 counts the load stiffness of the pressure twice in a prestressed
// frequency step, so that step has half the pressure.
//
// A ring of sectors of unequal width does not stay round when it is inflated: narrow and wide
// facets have different resultants along the circumference, by about the square of their width, and
// a tire is soft in bending. A 205/55R16 of 40 sectors, 2.4 to 13.1 degrees wide, grows in CalculiX
// 2.20 by 1.272 mm at its narrow sectors and by 1.380 mm at its wide ones; with 40 equal sectors it
// grows by 1.366 mm everywhere, in Latsch by 1.375 mm. Latsch inflates a tire with equal sectors,
// and a deck without ground has equal sectors too. A deck with ground has the tire's zones of
// unequal sectors, because the contact patch needs narrow ones: the tire above, pressed by 20 mm,
// carries 3916 N, in Latsch 3954 N.
//
// Comments (inp_remarks.h) state walls, tread and planes, for which CalculiX has no card, so that
// the deck is read back as the same tire.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/mesh/materials.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::formats {

struct CcxGround {
  double radius = 0.0;        // m, from the wheel center to the ground before it moves
  double travel = 0.0;        // m, motion of the ground toward the wheel center
  double stiffness = 2.0e10;  // Pa/m
  double mu = 0.0;
};

struct CcxRun {
  std::string title;
  double pressure = 0.0;            // Pa
  std::optional<CcxGround> ground;  // none: no load step
  int load_increments = 5;          // number of increments in which the ground moves
  int modes = 20;                   // 0: no frequency step
  bool loaded_modes = true;         // false: modes of the inflated tire, before the load step
  /// Element type of the deck: C3D8 for full integration, C3D8I with incompatible modes instead of
  /// the solid shell.
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
