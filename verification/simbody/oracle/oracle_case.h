// SPDX-License-Identifier: Apache-2.0
// The contents of a case file for the oracle, the reference program on Simbody: bodies on bushings,
// loads, tires on a road. Units are SI; x points forward, y left, z up; positions and axes are
// those at rest. README.md lists the fields.
#pragma once

#include <SimTKcommon.h>

#include <string>
#include <vector>

namespace oracle {

struct BodyData {
  std::string name;
  double mass;
  SimTK::Vec3 center;  // m, center of mass, which is the origin of the body
  /// moments Ixx Iyy Izz and products Ixy Ixz Iyz of inertia, kg m^2
  SimTK::Vec3 moments, products;
};

struct BushingData {
  std::string name;
  std::string a, b;  // names of bodies, or "ground"
  SimTK::Vec3 point;
  SimTK::Vec3 stiffness, rotational_stiffness;  // N/m, N m/rad
  SimTK::Vec3 damping, rotational_damping;      // N s/m, N m s/rad
};

/// A load of fixed direction at a point of a body.
struct LoadData {
  std::string body;
  SimTK::Vec3 point, force, moment;
};

struct LoadCase {
  std::string name;
  std::vector<LoadData> loads;  // applied in addition to the loads that all cases have
};

/// A tire as a vertical spring and damper at the wheel center: its upward force is F = k (R - (z_c
/// - h)) + c (h' - z_c') while F > 0, where R is the free radius, z_c the height of the center and
/// h that of the road.
struct TireData {
  std::string body;
  SimTK::Vec3 wheel_center;
  double radius, stiffness, damping;
};

/// A road profile: `count` humps H/2 (1 - cos 2π s/L) of pitch L and height H in a row, the first
/// from `start` on, for lateral[0] <= y <= lateral[1].
struct RoadData {
  double pitch = 1.0, height = 0.0, start = 0.0;
  int count = 0;
  double lateral[2] = {0.0, 0.0};

  double height_at(double s) const;
  double slope_at(double s) const;
  bool is_under(double y) const { return lateral[0] <= y && y <= lateral[1]; }
};

struct OutputPoint {
  std::string name, body;
  SimTK::Vec3 point;
};

struct Case {
  SimTK::Vec3 gravity;
  std::vector<BodyData> bodies;
  std::vector<BushingData> bushings;
  /// Springs to the ground that remove the free motions of the model in statics; none if their
  /// body's name is empty.
  BushingData held_in_statics;
  std::vector<LoadData> loads;
  std::vector<LoadCase> load_cases;
  std::vector<TireData> tires;
  RoadData road;
  double speed = 0.0, time = 0.0, output_step = 0.0;  // m/s, s, s
  std::vector<OutputPoint> outputs;
};

Case read_case(const std::string& file);

}  // namespace oracle
