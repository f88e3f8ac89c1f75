// SPDX-License-Identifier: Apache-2.0
// The tables a laboratory hands over, and the same tables written from a simulation (a twin).
//
// Load-deflection: columns "deflection" (from first touch) or "loaded_radius" (wheel center to
// ground), and "force". Modes: column "frequency"; where known "n", "type" (torsional, lateral,
// radial, bending), "phase" (s, a). Shapes: one row a mode and point, columns "mode" (1, 2 ... in
// the order of the modes' table), "x" "y" "z" (undeformed, wheel frame) and "ux" "uy" "uz" (any
// scale); every mode at the same points in the same order.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "experiment/mode_record.h"
#include "measurement/channels.h"

namespace latsch::correlation {

/// Throws InputError for a missing column, an empty table, forces that are not positive.
struct MeasuredCurve {
  std::vector<double> deflections, loaded_radii;  // m, one of them empty
  std::vector<double> forces;                     // N
};
MeasuredCurve read_curve(const std::filesystem::path& file);
void write_curve(const std::filesystem::path& file, const MeasuredCurve& curve);

/// Modes without shapes.
std::vector<experiment::ModeRecord> read_modes(const std::filesystem::path& file);
void write_modes(const std::filesystem::path& file,
                 const std::vector<experiment::ModeRecord>& modes);

/// Gives the modes their shapes; returns the points [3 x points], m.
Eigen::Matrix3Xd read_shapes(const std::filesystem::path& file,
                             std::vector<experiment::ModeRecord>& modes);
void write_shapes(const std::filesystem::path& file,
                  const Eigen::Matrix3Xd& points,
                  const std::vector<experiment::ModeRecord>& modes);

}  // namespace latsch::correlation
