// SPDX-License-Identifier: Apache-2.0
// Writes a tire, its contact patch and chains of points as files for ParaView (.vtu, VTK's XML
// unstructured grid, ASCII).
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
/// displacement or a mode shape. `cells`: further values of the elements, [c x elements] of the
/// whole ring, sector by sector, written as they are.
void write_tire_vtu(std::ostream& out,
                    const fe_tire::Mesh& mesh,
                    const std::vector<VtuField>& fields,
                    const std::vector<VtuField>& cells = {});
void write_tire_vtu(const std::filesystem::path& file,
                    const fe_tire::Mesh& mesh,
                    const std::vector<VtuField>& fields,
                    const std::vector<VtuField>& cells = {});

/// Points with fields [c x points].
struct VtuPoints {
  Eigen::Matrix3Xd x;  // m
  std::vector<VtuField> fields;
  /// Numbers of points of closed lines, in the order of the points; empty: single vertices.
  std::vector<long> loops = {};
};

void write_points_vtu(std::ostream& out, const VtuPoints& points);
void write_points_vtu(const std::filesystem::path& file, const VtuPoints& points);

/// Writes the integration points in contact as single vertices on the ground, with pressure, shear,
/// area and sticking.
void write_patch_vtu(std::ostream& out, const fe_tire::Standing& standing);
void write_patch_vtu(const std::filesystem::path& file, const fe_tire::Standing& standing);

}  // namespace latsch::formats
