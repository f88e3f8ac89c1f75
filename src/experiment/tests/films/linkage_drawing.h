// SPDX-License-Identifier: Apache-2.0
// Draws the links between wheels and frame of any mechanism as rods in space, with the forces in
// them, from the joints between its bodies.
//
// The inner joints of a link are those with the frame and with links that are nearer to the frame.
// Its outer joints are the other joints in which it is the first body. A rod is drawn from every
// inner joint to the mean position of the outer joints. The tension T, N, of the rod is the
// component of the inner joint's force along the rod; the tension at an outer joint is the
// component along the line from the mean position of the inner joints:
//
//     T = -F u at an inner joint, F u at an outer joint
//
// where F is the force on the link, N, and u the unit vector that points outward.
//
// A link with two joints thus shows its axial force, and each leg of a wishbone a tension of its
// own. The tension of a link that has mass and moves is that at its inner end.
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
  /// The arrows of joints and struts, followed by those of the loads that were added.
  const std::vector<report::Scene::Arrow>& arrows() const { return arrows_; }
  const std::vector<DrawnWheel>& wheels() const { return wheels_; }

  /// Adds a point that moves with a body; returns the index of the point in the mesh.
  std::uint32_t add_point(int body, const Eigen::Vector3d& at_rest);
  void add_rod(const std::string& name, std::uint32_t from, std::uint32_t to);
  void add_circle(const DrawnWheel& wheel);
  void add_load(const std::string& name, const std::string& unit, std::uint32_t point);

  /// Returns one step of the drawing: the points, the tensions, N (NaN: none), and the forces: of
  /// joints on links, of struts at their second end, and of pads on wheels. The forces of loads are
  /// zero.
  report::Scene::Step step(double at,
                           const multibody::Assembly& assembly,
                           const multibody::Motion& motion) const;
  /// Returns the index of the first load among the arrows.
  Eigen::Index first_load() const { return static_cast<Eigen::Index>(forces_.size()); }

 private:
  struct Place {
    int body;
    Eigen::Vector3d in_body;
  };
  /// The force of a joint, or of a line of a strut. A force with is_axial is drawn as the tension
  /// between two points.
  struct Force {
    int joint, strut = -1, line = 0;
    bool is_axial = true, is_outer = false;
    Place from = {multibody::kGround, {}}, to = {multibody::kGround, {}};
  };
  enum class Role { none, inner, outer, pad };
  /// Returns the number of joints between each body and the frame.
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
  /// Joints of each link: those toward the frame, those toward the wheel, and those at which other
  /// links are held and at which they push.
  std::map<int, std::vector<int>> inner_, outer_, held_, pushed_;
  std::map<int, int> force_at_;  // index of the force of each outer joint
  report::Scene::Mesh mesh_;
  std::vector<Eigen::Vector3d> at_rest_;
  std::vector<report::Scene::Arrow> arrows_;
  std::vector<Place> points_;
  std::vector<int> values_;  // for each point, index in forces_ of the force shown at it; -1: none
  std::vector<Force> forces_;
};

}  // namespace latsch::experiment
