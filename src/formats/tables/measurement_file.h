// SPDX-License-Identifier: Apache-2.0
// Reads tables as laboratories deliver them, and writes such tables from a simulation.
//
// Load-deflection, CSV: columns "deflection" (from the first contact) or "loaded_radius" (wheel
// center to ground), "force" and, if known, "spread", the standard deviation of the force. A table
// with other names is read like any other measurement (correlation/laboratory/measurement.h).
//
// Modes, CSV: column "frequency" (also "f", "Eigenfrequenz" and a few others); if known "n" (also
// "order"), "type" (torsional, lateral, radial) and "phase" (s, a); letter case does not matter; a
// cell may be empty. Or TOML, one table for each mode:
//
//   [[mode]]
//   frequency = "43.2 Hz"
//   n = 1
//   type = "lateral"
//   phase = "s"
//
// Mode shapes, CSV beside the modes: one row for each mode and sensor point, columns "mode" (1, 2
// ... in the order of the modes), "x" "y" "z" (undeformed tire, wheel frame) and "ux" "uy" "uz"
// (any scale); every mode has the same points in the same order.
//
// Units are stated in the header, see csv_table.h. A table that was written and is read again has
// bitwise equal numbers.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/document_record.h"
#include "measurement/load_deflection.h"
#include "measurement/mode_table.h"

namespace latsch::formats {

/// Throws InputError that names file and line for a missing column, a wrong unit, or an invalid
/// curve.
LoadDeflectionCurve read_load_deflection(const std::filesystem::path& file);
/// True if a file is a CSV table with no columns except those that read_load_deflection() reads.
bool is_load_deflection_table(const std::filesystem::path& file);

/// Reads modes without shapes, from .toml or CSV.
ModeTable read_modes(const std::filesystem::path& file);
/// Reads modes from a .toml and returns every key that is requested, by its path. Throws InputError
/// as read_modes() does.
std::map<std::string, DeclaredKey> keys_of_modes(const std::filesystem::path& file);
/// Reads mode shapes and sensor points and adds them to `table`.
void read_shapes(const std::filesystem::path& file, ModeTable& table);

/// Write a table. `comment` becomes the first line and states the origin of the numbers.
void write_load_deflection(const std::filesystem::path& file,
                           const LoadDeflectionCurve& curve,
                           const std::string& comment);
/// Writes labels and frequencies; as TOML if the name ends in .toml.
void write_modes(const std::filesystem::path& file,
                 const ModeTable& table,
                 const std::string& comment);
void write_shapes(const std::filesystem::path& file,
                  const ModeTable& table,
                  const std::string& comment);

}  // namespace latsch::formats
