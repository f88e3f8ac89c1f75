// SPDX-License-Identifier: Apache-2.0
// Reads a tire from an .inp file: mesh, materials, inflation and ground in the terms of
// models/fe_tire.
//
// The spin axis is that of the cylindrical orientation (z if there is none); the ground is the
// contact's master body, and its direction becomes down. A mesh of equal sectors is recognized and
// becomes one sector, and so does one of unequal sectors with the same nodes in every plane; a
// contact surface on part of the circumference is then continued around it.
// Without contact, outer faces that face outward are the tread.
//
// A corner that *EQUATION holds on the line between two nodes becomes an edge tie of its element
// (tied_corners.h), not a node.
//
// Walls, tread and the division of the standing tire are those of remarks (inp_remarks.h).
//
// Elements are computed as the deck states: C3D8 with full integration, as in CalculiX, its
// variants against locking (C3D8I, C3D8R, with H or without) by the solid shell.
#pragma once

#include <optional>

#include "formats/deck/inp_deck.h"
#include "formats/mesh/inp_rebars.h"
#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/element/materials.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::formats {

/// Flat ground with its motion in the file.
struct InpGround {
  double radius = 0.0;     // m, from wheel center to ground before the ground moves
  double travel = 0.0;     // m, toward the wheel center
  double stiffness = 0.0;  // Pa/m
  double mu = 0.0;
};

/// Names of the deck for a solid of the tire; no orientation: "".
struct InpSolid {
  std::string material, orientation;
  auto operator<=>(const InpSolid&) const = default;
};

struct InpTire {
  fe_tire::Mesh mesh;
  fe_tire::ElementKind element = fe_tire::ElementKind::solid_shell;
  std::vector<InpSolid> solids;  // solids of `materials`
  std::vector<InpLayer> layers;
  std::vector<fe_tire::CordLayer> cords;  // layers that the deck has as springs
  fe_tire::Materials materials;
  double pressure = 0.0;  // Pa
  std::optional<InpGround> ground;
  int modes = 0;  // number requested; 0: none
};

/// Throws InputError if the file cannot be such a tire, naming the line or the element.
InpTire read_inp_tire(const std::filesystem::path& file);
InpTire tire_from(const InpDeck& deck);

/// Returns the materials of the tire with the present numbers of the deck. Throws InputError if
/// they are invalid.
fe_tire::Materials materials_of(const InpTire& tire, const InpDeck& deck);
/// Returns the pressure in Pa.
double pressure_of(const InpDeck& deck);

}  // namespace latsch::formats
