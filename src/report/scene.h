// SPDX-License-Identifier: Apache-2.0
// Bodies in space as a page shows them, whatever model they are of: surfaces and lines, and frames
// in which they are displaced, colored by a field, or swing; and sequences of a test, step by step,
// with the forces that act.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace latsch::report {

struct TirePictures;

struct Scene {
  /// A range of a mesh's triangles, or of its edges.
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
    std::vector<Part> rods = {};  // edges that are drawn thick: links, springs
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
  /// A force or moment at a point of a mesh.
  struct Arrow {
    std::string name, unit;   // "uca_front", "N"
    std::uint32_t point = 0;  // its color is that of the field there
    bool is_load = false;     // on the whole from outside: its head is at the point
  };
  /// A state of a rig, a moment of a run.
  struct Step {
    double at = 0.0;
    Eigen::Matrix3Xd points;   // m, from the origin
    std::vector<float> field;  // a value a point; not finite: none
    Eigen::Matrix3Xd vectors;  // of the arrows, in their units
    double origin = 0.0;       // m, how far along x the origin has gone
  };
  /// What a test does, step by step.
  struct Sequence {
    std::string name = {};              // of the test
    std::string mesh = {};              // which one moves
    std::string along = {}, unit = {};  // what its steps are told by: "time", "s"; "Fy", "N"
    std::string field_name = {}, field_unit = {};
    std::vector<Arrow> arrows = {};
    std::vector<Step> steps = {};
    std::string ground = {};  // a mesh that stands still: the road; empty: none
  };
  std::vector<Mesh> meshes;
  std::vector<Frame> frames;
  std::vector<Sequence> sequences = {};
  std::vector<std::string> remarks = {};  // what is not shown, a sentence each
};

/// The tire as built, inflated, on the ground with the pressure in its contact, and its modes.
Scene scene_of(const TirePictures& pictures);

}  // namespace latsch::report
