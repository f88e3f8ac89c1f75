// SPDX-License-Identifier: Apache-2.0
// A case file that Simbody and Latsch both read: bodies on bushings, loads, tires on a road.
// README.md lists the fields. Units are SI; x points forward, y left, z up; positions and axes are
// those at rest.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "models/multibody/mechanism.h"

namespace latsch::verification {

struct LoadCase {
  std::string name;
  std::vector<multibody::Load> loads;  // applied in addition to the loads that all cases have
};

/// A tire as a vertical spring and damper at the wheel center: its upward force is F = k (R - (z_c
/// - h)) + c (h' - z_c') while F > 0, where R is the free radius, z_c the height of the center and
/// h that of the road.
struct LinearTire {
  std::string name;
  int body;
  Eigen::Vector3d wheel_center;
  double radius, stiffness, damping;  // m, N/m, N s/m
};

/// A road profile: `count` humps H/2 (1 - cos 2π s/L) of pitch L and height H in a row, the first
/// from `start` on, for right <= y <= left.
struct KerbStretch {
  double pitch, height, start;  // m
  int count;
  double right, left;  // m
};

struct OutputPoint {
  std::string name;
  int body;
  Eigen::Vector3d point;
};

struct CaseFile {
  Eigen::Vector3d gravity;
  std::vector<multibody::Body> bodies;
  std::vector<multibody::Joint> joints;
  /// Springs to the ground that remove the free motions of the model in statics. The loads have no
  /// component along these motions, so the springs carry no load: they only select one of many
  /// equilibria.
  std::optional<multibody::Joint> held_in_statics;
  std::vector<multibody::Load> loads;
  std::vector<LoadCase> load_cases;  // at least one
  std::vector<LinearTire> tires;
  std::optional<KerbStretch> road;
  double speed = 0.0, time = 0.0, output_step = 0.0;  // m/s, s, s
  std::vector<OutputPoint> outputs;
};

/// Throws InputError if the file cannot be read.
CaseFile read_case_file(const std::filesystem::path& file);

/// Returns the loads of this load case, those common to all load cases, and gravity.
std::vector<multibody::Load> loads_of(const CaseFile& file, const LoadCase& load_case);

/// Returns the joints together with those that statics needs: the springs of held_in_statics, and
/// the tires on level ground as vertical springs, which is exact as long as they touch it.
std::vector<multibody::Joint> joints_in_statics(const CaseFile& file);

/// Returns the displacement of an output point from its position at rest, m.
Eigen::Vector3d displacement(const CaseFile& file,
                             const OutputPoint& output,
                             const multibody::Poses& poses);

}  // namespace latsch::verification
