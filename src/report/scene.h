// SPDX-License-Identifier: Apache-2.0
// Bodies in space as a page shows them, whatever model they are of: surfaces and lines, and frames
// in which they are displaced, colored by a field, or swing.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace latsch::report {

struct TirePictures;

struct Scene {
  /// A range of a mesh's triangles.
  struct Part {
    std::string name;
    std::uint32_t first = 0, count = 0;
  };
  struct Mesh {
    std::string name;
    Eigen::Matrix3Xd points;               // m, ISO 8855: x forward, y left, z up
    std::vector<std::uint32_t> triangles;  // three points each
    std::vector<std::uint32_t> edges;      // two points each
    std::vector<Part> parts;
  };
  struct Frame {
    std::string name;
    std::string mesh;         // which one it shows
    Eigen::Matrix3Xd points;  // where its points are then, m
    std::string field_name, field_unit;
    std::vector<float> field = {};      // a value a point, in that unit; empty: none
    Eigen::Matrix3Xd swing = {};        // m, added times sin(t); no columns: it stands still
    double frequency = 0.0;             // Hz, of a mode
    std::optional<double> ground = {};  // m, height of a level road
  };
  std::vector<Mesh> meshes;
  std::vector<Frame> frames;
};

/// The tire as built, inflated, on the ground with the pressure in its contact, and its modes.
Scene scene_of(const TirePictures& pictures);

}  // namespace latsch::report
