// SPDX-License-Identifier: Apache-2.0
// Writes a tire and its contact patch as files for ParaView (.vtu, VTK's XML unstructured grid,
// ASCII).
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "models/fe_tire/analysis/fe_tire.h"

namespace latsch::formats {

/// A named field in sector frames, one column for each node, with one or three rows: [c x nodes] of
/// the whole ring, or [c x nodes_per_sector] if it is equal in all sectors.
struct VtuField {
  std::string name;
  Eigen::MatrixXd values;
};

/// Writes the whole ring in the wheel frame, m, undeformed. Every element has its region (names are
/// in a comment of the file), "inner" and "tread"; ParaView's "Warp By Vector" applies a
/// displacement or a mode shape.
void write_tire_vtu(std::ostream& out,
                    const fe_tire::Mesh& mesh,
                    const std::vector<VtuField>& fields);
void write_tire_vtu(const std::filesystem::path& file,
                    const fe_tire::Mesh& mesh,
                    const std::vector<VtuField>& fields);

/// Writes the integration points in contact as single vertices on the ground, with pressure, shear,
/// area and sticking.
void write_patch_vtu(std::ostream& out, const fe_tire::Standing& standing);
void write_patch_vtu(const std::filesystem::path& file, const fe_tire::Standing& standing);

}  // namespace latsch::formats
