// SPDX-License-Identifier: Apache-2.0
// Rigid bodies, the bushings and struts that join them to each other and to the ground, and a load
// on them. A mechanism is constant; poses and motions are separate values. At rest the axes of all
// bodies are parallel to those of the ground. Drivers are lengths prescribed from outside as
// functions of time: the travel of a rack, which shifts a joint's position in its first body, or
// that of an actuator, which shortens a strut.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "models/multibody/bushing.h"
#include "models/multibody/strut.h"

namespace latsch::multibody {

constexpr int kGround = -1;

struct Body {
  std::string name;
  Eigen::Vector3d origin;  // at rest, m; the center of mass if the body has mass
  double mass = 0.0;       // kg
  // About the origin, in the body's axes at rest, kg m^2.
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// A bushing between bodies a and b, either of which may be the ground.
struct Joint {
  std::string name;
  int a, b;
  Eigen::Vector3d point;  // at rest, m
  BushingParameters bushing;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns: axes of the bushing
  int driver = -1;  // driver whose travel shifts the joint's point in body a; -1: none
  // Direction of that shift, in the axes of body a.
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
};

/// A force of constant direction on a body, at one of its points.
struct Load {
  int body;
  Eigen::Vector3d point;                                                              // at rest, m
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();  // N, N m
};

using Poses = std::vector<Pose>;  // one pose per body
/// Memories of the force parts of all elements, in the order of Mechanism::memory_of_joint and
/// memory_of_strut.
using Memories = std::vector<PartMemory>;

class Mechanism {
 public:
  /// Returns an empty text for a valid mechanism, otherwise a message that names the part: a body
  /// without a joint, a joint of a body with itself, a stiffness that is not positive, a position
  /// that is not finite, or a massless rod that spins freely.
  static std::string fault(const std::vector<Body>& bodies,
                           const std::vector<Joint>& joints,
                           const std::vector<Strut>& struts = {},
                           int drivers = 0);
  /// Returns an empty text if the mechanism can move dynamically, otherwise a message that names a
  /// body without mass or without inertia about some axis.
  static std::string fault_in_motion(const std::vector<Body>& bodies);
  /// Constructs the mechanism. The parts must have no fault().
  Mechanism(std::vector<Body> bodies,
            std::vector<Joint> joints,
            std::vector<Strut> struts = {},
            int drivers = 0,
            const Eigen::Vector3d& gravity = Eigen::Vector3d::Zero());

  const std::vector<Body>& bodies() const { return bodies_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const std::vector<Strut>& struts() const { return struts_; }
  int drivers() const { return drivers_; }
  const Eigen::Vector3d& gravity() const { return gravity_; }  // m/s^2
  const BushingPlace& place(int joint) const { return places_[static_cast<std::size_t>(joint)]; }
  /// Returns the end points of a strut's line, each relative to the origin of its body.
  const std::pair<Eigen::Vector3d, Eigen::Vector3d>& ends(int strut, int line) const {
    return ends_[static_cast<std::size_t>(strut)][static_cast<std::size_t>(line)];
  }
  /// Returns Σ w L0.
  double rest_length(int strut) const { return rest_lengths_[static_cast<std::size_t>(strut)]; }
  /// Return the index of an element's first force part in the memories.
  std::size_t memory_of_joint(int joint) const {
    return joint_memory_[static_cast<std::size_t>(joint)];
  }
  std::size_t memory_of_strut(int strut) const {
    return strut_memory_[static_cast<std::size_t>(strut)];
  }
  /// Returns the memories of all force parts at rest, which are zero.
  Memories no_memories() const { return Memories(memories_); }
  double mass() const;  // kg, total mass of all bodies
  Poses at_rest() const;
  /// Returns the pairs of bodies that share an element.
  std::vector<std::pair<int, int>> pairs() const;

 private:
  std::vector<Body> bodies_;
  std::vector<Joint> joints_;
  std::vector<Strut> struts_;
  int drivers_;
  Eigen::Vector3d gravity_;
  std::vector<BushingPlace> places_;
  std::vector<std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>> ends_;
  std::vector<double> rest_lengths_;
  std::vector<std::size_t> joint_memory_, strut_memory_;
  std::size_t memories_ = 0;
};

}  // namespace latsch::multibody
