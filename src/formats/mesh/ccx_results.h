// SPDX-License-Identifier: Apache-2.0
// What CalculiX prints into its .dat file: total forces, displacements, frequencies.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::formats {

/// In the units and frame of the deck (mm, N, tonne, s). Forces and displacements are those of the
/// first time they were printed: what follows belongs to the modes.
struct CcxResults {
  std::map<std::string, Eigen::Vector3d> total_force;  // of a node set
  std::map<int, Eigen::Vector3d> displacement;         // of a node
  std::vector<double> frequencies;                     // ascending, Hz
};

/// Throws InputError where the file cannot be read or a table holds something else than numbers.
CcxResults read_ccx_results(const std::filesystem::path& dat_file);
CcxResults parse_ccx_results(std::string_view text, const std::string& file_name);

}  // namespace latsch::formats
