// SPDX-License-Identifier: Apache-2.0
// The contents of a case file for the oracle: bodies on bushings, loads, tires on a road. Units are
// SI; x forward, y left, z up; places and axes are those at rest. README.md lists the fields.
#pragma once

#include <SimTKcommon.h>

#include <string>
#include <vector>

namespace oracle {

struct BodyData {
  std::string name;
  double mass;
  SimTK::Vec3 center;             // center of mass, which is the body's origin
  SimTK::Vec3 moments, products;  // Ixx Iyy Izz; Ixy Ixz Iyz, elements of the tensor
};

struct BushingData {
  std::string name;
  std::string a, b;  // bodies or "ground"
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
  std::vector<LoadData> loads;  // in addition to those that are always applied
};

/// F = k (R - (z_c - h)) + c (h' - z_c'), upward at the wheel center, while it is above zero.
struct TireData {
  std::string body;
  SimTK::Vec3 wheel_center;
  double radius, stiffness, damping;
};

/// A road profile: `count` times H/2 (1 - cos 2π s/L), the first from `start` on, for lateral[0] <=
/// y <= lateral[1].
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
  /// Springs to the ground that hold, in statics, what nothing else holds; empty body: none.
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
