// SPDX-License-Identifier: Apache-2.0
// Reads a tire from an .inp file: mesh, materials, inflation and ground in the terms of
// models/fe_tire.
//
// The spin axis is that of the cylindrical orientation (z if there is none); the ground is the
// master body of the contact, and its direction becomes down. A mesh of equal sectors is recognized
// and reduced to one sector, and so is one of unequal sectors with the same nodes in every plane; a
// contact surface on part of the circumference is then continued around it. Without contact, outer
// faces that face outward are the tread. A corner that *EQUATION ties to the line between two nodes
// becomes an edge tie of its element (tied_corners.h), not a node. Walls, tread and the division of
// the tire on the ground are those of the comments of the deck (inp_remarks.h).
//
// Elements are computed as the deck states: C3D8 with full integration, as in CalculiX, and its
// variants against locking (C3D8I, C3D8R, with or without H) by the solid shell.
#pragma once

#include <optional>

#include "formats/deck/inp_deck.h"
#include "formats/mesh/inp_rebars.h"
#include "models/fe_tire/element/hex8.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/mesh/materials.h"
#include "models/fe_tire/mesh/mesh.h"

namespace latsch::formats {

/// Flat ground and its motion as the file states it.
struct InpGround {
  double radius = 0.0;     // m, from the wheel center to the ground before it moves
  double travel = 0.0;     // m, motion toward the wheel center
  double stiffness = 0.0;  // Pa/m
  double mu = 0.0;
};

/// Names that the deck has for a solid material of the tire; `orientation` is "" if there is none.
struct InpSolid {
  std::string material, orientation;
  auto operator<=>(const InpSolid&) const = default;
};

struct InpTire {
  fe_tire::Mesh mesh;
  fe_tire::ElementKind element = fe_tire::ElementKind::solid_shell;
  std::vector<InpSolid> solids;  // names of the solids in `materials`
  std::vector<InpLayer> layers;
  std::vector<fe_tire::CordLayer> cords;  // layers of cords that the deck models as springs
  fe_tire::Materials materials;
  fe_tire::LossMaterials losses;  // Prony terms of the materials (inp_losses.h)
  double pressure = 0.0;          // Pa
  std::optional<InpGround> ground;
  int modes = 0;  // number of modes requested by the deck; 0: none
};

/// Throws InputError, which names the line or the element, if the file does not describe such a
/// tire.
InpTire read_inp_tire(const std::filesystem::path& file);
InpTire tire_from(const InpDeck& deck);

/// Returns the materials of the tire with the present numbers of the deck. Throws InputError if
/// they are invalid.
fe_tire::Materials materials_of(const InpTire& tire, const InpDeck& deck);
/// Returns the pressure in Pa.
double pressure_of(const InpDeck& deck);

}  // namespace latsch::formats
