// SPDX-License-Identifier: Apache-2.0
// Draws the parts that connect wheels to a frame as rods in space, with the forces in them, for any
// mechanism, from the joints between its bodies.
//
// A link's inner joints are those with the frame and with links nearer to it; its outer joints are
// the others at which it is the first body. A rod goes from every inner joint to the middle of the
// outer ones; its tension is the force of the inner joint along it. The tension at an outer joint
// is along the line to it from the middle of the inner ones.
//     T = -F u at an inner joint, F u at an outer one     F: on the link, u: unit vector outward
//
// So a rod with two joints has its axial force, and each leg of a wishbone its own; for links with
// mass in motion the tension is that at their inner end.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "models/multibody/assembly.h"
#include "report/scene.h"

namespace latsch::experiment {

struct DrawnWheel {
  std::string name;                 // "left"; empty if there is only one
  int upright;                      // body
  Eigen::Vector3d center, contact;  // at rest, m
};

class LinkageDrawing {
 public:
  /// `frame` lists bodies that belong to the frame in addition to the ground. The mechanism must
  /// outlive this object.
  LinkageDrawing(const multibody::Mechanism& mechanism,
                 std::vector<int> frame,
                 std::vector<DrawnWheel> wheels);

  /// Returns the mesh at rest. Points that this object does not move may be appended to a copy.
  const report::Scene::Mesh& mesh() const { return mesh_; }
  /// Arrows of joints and struts, then of the loads that were added.
  const std::vector<report::Scene::Arrow>& arrows() const { return arrows_; }
  const std::vector<DrawnWheel>& wheels() const { return wheels_; }

  /// Adds a point that moves with a body; returns its number in the mesh.
  std::uint32_t add_point(int body, const Eigen::Vector3d& at_rest);
  void add_rod(const std::string& name, std::uint32_t from, std::uint32_t to);
  void add_circle(const DrawnWheel& wheel);
  void add_load(const std::string& name, const std::string& unit, std::uint32_t point);

  /// Returns a step of the drawing: points, tensions in N (NaN: none), and forces: on links at
  /// their joints, on struts at their second end, of pads on wheels; those of loads are zero.
  report::Scene::Step step(double at,
                           const multibody::Assembly& assembly,
                           const multibody::Motion& motion) const;
  /// Index of the first load among the arrows.
  Eigen::Index first_load() const { return static_cast<Eigen::Index>(forces_.size()); }

 private:
  struct Place {
    int body;
    Eigen::Vector3d in_body;
  };
  /// Force of a joint, or of a line of a strut; with or without a tension between two points.
  struct Force {
    int joint, strut = -1, line = 0;
    bool is_axial = true, is_outer = false;
    Place from = {multibody::kGround, {}}, to = {multibody::kGround, {}};
  };
  enum class Role { none, inner, outer, pad };
  /// Number of joints between a body and the frame.
  std::map<int, int> ways_to_frame() const;
  void sort_joints();
  void add_link(int body);
  void add_upright(const DrawnWheel& wheel);
  void add_struts();
  int add_force(const Force& force, const std::string& name, std::uint32_t point, bool is_load);
  std::uint32_t add_valued_point(const Place& place, int force);
  Place on(int body, const Eigen::Vector3d& at_rest) const;
  Eigen::Vector3d where(const Place& place, const multibody::Poses& poses) const;
  Eigen::Vector3d middle(const std::vector<int>& joints) const;
  bool is_frame(int body) const;
  bool is_upright(int body) const;
  std::string name_of(int body) const;

  const multibody::Mechanism& mechanism_;
  std::vector<int> frame_;
  std::vector<DrawnWheel> wheels_;
  std::vector<int> links_;
  /// Joints of each link: towards the frame, outer ones, and those at which other links are held
  /// and push.
  std::map<int, std::vector<int>> inner_, outer_, held_, pushed_;
  std::map<int, int> force_at_;  // index of the force of an outer joint
  report::Scene::Mesh mesh_;
  std::vector<Eigen::Vector3d> at_rest_;
  std::vector<report::Scene::Arrow> arrows_;
  std::vector<Place> points_;
  std::vector<int> values_;  // index in forces_ for each point; -1: none
  std::vector<Force> forces_;
};

}  // namespace latsch::experiment
