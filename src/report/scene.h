// SPDX-License-Identifier: Apache-2.0
// Bodies in space for display, from any model: surfaces and lines; frames in which they are
// displaced, colored by a field, or swing; and sequences of a test, step by step, with the acting
// forces.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace latsch::report {

struct TirePictures;

struct Scene {
  /// Range of a mesh's triangles, or of its edges.
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
    std::vector<Part> rods = {};  // edges drawn thick: links, springs
  };
  struct Frame {
    std::string name;
    std::string mesh;         // name of the mesh shown
    Eigen::Matrix3Xd points;  // displaced positions of its points, m
    std::string field_name, field_unit;
    std::vector<float> field = {};      // one value for each point, in that unit; empty: none
    Eigen::Matrix3Xd swing = {};        // m, added times sin(t); no columns: no motion
    double frequency = 0.0;             // Hz, frequency of a mode
    std::optional<double> ground = {};  // m, height of a level road
  };
  /// Force or moment at a point of a mesh.
  struct Arrow {
    std::string name, unit;   // for example "uca_front", "N"
    std::uint32_t point = 0;  // the arrow has the color of the field at this point
    bool is_load = false;     // true for an external load: the arrow's head is at the point
  };
  /// State of a rig, or moment of a run.
  struct Step {
    double at = 0.0;
    Eigen::Matrix3Xd points;   // m, relative to the origin
    std::vector<float> field;  // one value for each point; not finite: none
    Eigen::Matrix3Xd vectors;  // components of the arrows, in their units
    double origin = 0.0;       // m, distance along x that the origin has moved
  };
  /// Course of a test, step by step.
  struct Sequence {
    std::string name = {};              // name of the test
    std::string mesh = {};              // name of the moving mesh
    std::string along = {}, unit = {};  // quantity and unit of the steps: "time", "s"; "Fy", "N"
    std::string field_name = {}, field_unit = {};
    std::vector<Arrow> arrows = {};
    std::vector<Step> steps = {};
    std::string ground = {};  // mesh that stands still: the road; empty: none
  };
  std::vector<Mesh> meshes;
  std::vector<Frame> frames;
  std::vector<Sequence> sequences = {};
  std::vector<std::string> remarks = {};  // parts that are not shown, one sentence each
};

/// Returns the tire as built, inflated, on the ground with the contact pressure, and its modes.
Scene scene_of(const TirePictures& pictures);

}  // namespace latsch::report
