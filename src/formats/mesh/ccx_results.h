// SPDX-License-Identifier: Apache-2.0
// Reads the .dat file of CalculiX: total forces, displacements, frequencies.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::formats {

/// Results in the units and the frame of the deck (mm, N, tonne, s). Forces and displacements are
/// the first ones in the file, because later ones belong to modes.
struct CcxResults {
  std::map<std::string, Eigen::Vector3d> total_force;  // keys: names of node sets
  std::map<int, Eigen::Vector3d> displacement;         // keys: node numbers
  std::vector<double> frequencies;                     // ascending, Hz
};

/// Throws InputError if the file cannot be read or a table contains anything but numbers.
CcxResults read_ccx_results(const std::filesystem::path& dat_file);
CcxResults parse_ccx_results(std::string_view text, const std::string& file_name);

}  // namespace latsch::formats
