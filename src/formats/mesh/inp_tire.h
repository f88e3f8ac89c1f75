// SPDX-License-Identifier: Apache-2.0
// A tire out of an .inp file: mesh, materials, inflation and ground in the terms of models/fe_tire.
//
// The spin axis is that of the cylindrical orientation (z where there is none); the ground lies
// where the contact's master body is, and that direction becomes down. A mesh made of equal sectors
// is found out and becomes one sector; a contact surface on part of the circumference is then
// continued around it. Without contact, the outer faces that look outward are the tread.
//
// A corner that *EQUATION holds on the line between two nodes becomes an edge tie of its element
// (tied_corners.h), no node.
//
// Elements are computed as the deck says: C3D8 with full integration, as CalculiX does, its
// variants against locking (C3D8I, C3D8R, with H or without) by the solid shell.
#pragma once

#include <optional>

#include "formats/deck/inp_deck.h"
#include "formats/mesh/inp_rebars.h"
#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/element/materials.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::formats {

/// Flat ground as the file moves it.
struct InpGround {
  double radius = 0.0;     // m, from wheel center to ground before it moves
  double travel = 0.0;     // m, toward the wheel center
  double stiffness = 0.0;  // Pa/m
  double mu = 0.0;
};

/// What a solid of the tire is made of: names of the deck; no orientation: "".
struct InpSolid {
  std::string material, orientation;
  auto operator<=>(const InpSolid&) const = default;
};

struct InpTire {
  fe_tire::Mesh mesh;
  fe_tire::ElementKind element = fe_tire::ElementKind::solid_shell;
  std::vector<InpSolid> solids;  // of `materials`
  std::vector<InpLayer> layers;
  fe_tire::Materials materials;
  double pressure = 0.0;  // Pa
  std::optional<InpGround> ground;
  int modes = 0;  // asked for; 0: none
};

/// Throws InputError for what such a tire cannot be, naming the line or the element.
InpTire read_inp_tire(const std::filesystem::path& file);
InpTire tire_from(const InpDeck& deck);

/// The materials of that tire with the numbers of the deck as they are now. Throws InputError where
/// they are none.
fe_tire::Materials materials_of(const InpTire& tire, const InpDeck& deck);
/// Pa.
double pressure_of(const InpDeck& deck);

}  // namespace latsch::formats
