// SPDX-License-Identifier: Apache-2.0
// The tables a laboratory hands over, and the same tables written from a simulation (a twin).
//
// Load-deflection, CSV: columns "deflection" (from first touch) or "loaded_radius" (wheel center to
// ground), "force" and, where known, "spread", the standard deviation of the force.
//
// Modes, CSV: column "frequency"; where known "n", "type" (torsional, lateral, radial) and "phase"
// (s, a); a cell may be empty. Or TOML, one table a mode:
//
//   [[mode]]
//   frequency = "43.2 Hz"
//   n = 1
//   type = "lateral"
//   phase = "s"
//
// Shapes, CSV beside it: one row a mode and sensor point, columns "mode" (1, 2 ... in the order of
// the modes), "x" "y" "z" (undeformed tire, wheel frame) and "ux" "uy" "uz" (any scale); every mode
// at the same points in the same order.
//
// Units stand in the header, see csv_table.h. What is written here is read back bit for bit.
#pragma once

#include <filesystem>
#include <string>

#include "measurement/load_deflection.h"
#include "measurement/mode_table.h"

namespace latsch::formats {

/// Throws InputError naming file and line: a missing column, a wrong unit, a fault of the curve.
LoadDeflectionCurve read_load_deflection(const std::filesystem::path& file);

/// Modes without shapes, from .toml or CSV.
ModeTable read_modes(const std::filesystem::path& file);
/// Adds the shapes and sensor points.
void read_shapes(const std::filesystem::path& file, ModeTable& table);

/// `comment` becomes the first line: where the numbers come from.
void write_load_deflection(const std::filesystem::path& file,
                           const LoadDeflectionCurve& curve,
                           const std::string& comment);
/// Labels and frequencies; TOML where the name ends in .toml.
void write_modes(const std::filesystem::path& file,
                 const ModeTable& table,
                 const std::string& comment);
void write_shapes(const std::filesystem::path& file,
                  const ModeTable& table,
                  const std::string& comment);

}  // namespace latsch::formats
