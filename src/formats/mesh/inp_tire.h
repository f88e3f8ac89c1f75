// SPDX-License-Identifier: Apache-2.0
// A tire out of an .inp file: mesh, materials, inflation and ground in the terms of models/fe_tire.
//
// The spin axis is that of the cylindrical orientation (z where there is none); the ground lies
// where the contact's master body is, and that direction becomes down. A mesh made of equal sectors
// is found out and becomes one sector; a contact surface on part of the circumference is then
// continued around it. Without contact, the outer faces that look outward are the tread.
#pragma once

#include <optional>

#include "formats/mesh/inp_deck.h"
#include "models/fe_tire/element/materials.h"
#include "models/fe_tire/element/mesh.h"

namespace latsch::formats {

/// What one unit of the file is in SI. Decks of tires are usually written in mm, N, tonne, s.
struct InpUnits {
  double length = 1e-3;  // m
  double force = 1.0;    // N
  double mass = 1e3;     // kg
};

/// Flat ground as the file moves it.
struct InpGround {
  double radius = 0.0;     // m, from wheel center to ground before it moves
  double travel = 0.0;     // m, toward the wheel center
  double stiffness = 0.0;  // Pa/m
  double mu = 0.0;
};

struct InpTire {
  fe_tire::Mesh mesh;
  fe_tire::Materials materials;
  double pressure = 0.0;  // Pa
  std::optional<InpGround> ground;
  int modes = 0;  // asked for; 0: none
};

/// Throws InputError for what such a tire cannot be, naming the line or the element.
InpTire read_inp_tire(const std::filesystem::path& file, const InpUnits& units = {});
InpTire tire_from(const InpDeck& deck, const InpUnits& units = {});

}  // namespace latsch::formats
