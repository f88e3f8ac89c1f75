// SPDX-License-Identifier: Apache-2.0
// Bodies in space for display, from any model: surfaces and lines; frames, in which they are
// displaced, colored by a field, or vibrate; and sequences, the steps of a test with the acting
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
  /// A named range of a mesh's triangles or edges.
  struct Part {
    std::string name;
    std::uint32_t first = 0, count = 0;
  };
  struct Mesh {
    std::string name;
    Eigen::Matrix3Xd points;               // m, ISO 8855: x forward, y left, z up
    std::vector<std::uint32_t> triangles;  // indices of points, three for each triangle
    std::vector<std::uint32_t> edges;      // indices of points, two for each edge
    std::vector<Part> parts;
    std::vector<Part> rods = {};  // ranges of edges that are drawn thick: links, springs
  };
  struct Frame {
    std::string name;
    std::string mesh;         // name of the mesh shown
    Eigen::Matrix3Xd points;  // displaced positions of its points, m
    std::string field_name, field_unit;
    std::vector<float> field = {};  // one value for each point, in the frame's unit; empty: none
    // m, displacement that is added times sin(t); no columns: no motion
    Eigen::Matrix3Xd swing = {};
    double frequency = 0.0;             // Hz, if the frame shows a mode
    std::optional<double> ground = {};  // m, height of a level road; nullopt: no road
  };
  /// A force or moment at a point of a mesh, drawn as an arrow.
  struct Arrow {
    std::string name, unit;   // for example "uca_front", "N"
    std::uint32_t point = 0;  // index of the point; the arrow has the color of the field there
    bool is_load = false;     // true for an external load: the tip of the arrow is at the point
  };
  /// A state of a rig, or a moment of a simulation.
  struct Step {
    double at = 0.0;
    Eigen::Matrix3Xd points;   // m, relative to the origin
    std::vector<float> field;  // one value for each point; not finite: none
    Eigen::Matrix3Xd vectors;  // components of the arrows, in the arrows' units
    double origin = 0.0;       // m, distance along x by which the origin has moved
  };
  /// The course of a test as a sequence of steps.
  struct Sequence {
    std::string name = {};  // name of the test
    std::string mesh = {};  // name of the mesh that moves
    // quantity that changes from step to step, and its unit: "time", "s"; "Fy", "N"
    std::string along = {}, unit = {};
    std::string field_name = {}, field_unit = {};
    std::vector<Arrow> arrows = {};
    std::vector<Step> steps = {};
    std::string ground = {};  // name of the mesh that does not move, the road; empty: none
  };
  std::vector<Mesh> meshes;
  std::vector<Frame> frames;
  std::vector<Sequence> sequences = {};
  std::vector<std::string> remarks = {};  // parts of the test that are not shown, one sentence each
};

/// Returns a scene of the tire: as built, inflated, on the ground with the contact pressure, and
/// its modes.
Scene scene_of(const TirePictures& pictures);

}  // namespace latsch::report
