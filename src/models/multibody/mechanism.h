// SPDX-License-Identifier: Apache-2.0
// Rigid bodies, the bushings and struts that join them to each other and to the ground, and a load
// on them. A mechanism is constant; poses and motions are separate values. All bodies have the
// ground's axes at rest. Drivers are lengths prescribed from outside as functions of time: the
// travel of a rack, which shifts a joint's position in its first body, or that of an actuator,
// which shortens a strut.
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
  Eigen::Vector3d origin;  // at rest, m; the center of mass if it has a mass
  double mass = 0.0;       // kg
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the origin, axes at rest, kg m^2
};

/// A bushing between bodies a and b, either of which may be the ground.
struct Joint {
  std::string name;
  int a, b;
  Eigen::Vector3d point;  // at rest, m
  BushingParameters bushing;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // axes of the bushing, columns
  int driver = -1;                                     // driver whose travel shifts the joint in a;
                                                       // -1: none
  Eigen::Vector3d along = Eigen::Vector3d::Zero();     // direction of that shift, in a's axes
};

/// A load of fixed direction at a point of a body.
struct Load {
  int body;
  Eigen::Vector3d point;                                                              // at rest, m
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();  // N, N m
};

using Poses = std::vector<Pose>;  // one for each body
/// Memories of the parts of all elements, in the order of Mechanism::memory_of_joint and
/// memory_of_strut.
using Memories = std::vector<PartMemory>;

class Mechanism {
 public:
  /// Returns what is wrong, naming the part, or an empty text: a body without a joint, a joint of a
  /// body with itself, stiffness that is not positive, positions that are not finite, a massless
  /// rod that spins freely.
  static std::string fault(const std::vector<Body>& bodies,
                           const std::vector<Joint>& joints,
                           const std::vector<Strut>& struts = {},
                           int drivers = 0);
  /// Checks the bodies for free motion: reports one that has no mass or no inertia in some
  /// direction.
  static std::string fault_in_motion(const std::vector<Body>& bodies);
  /// Takes parts without fault.
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
  /// Returns the points of a strut's line, from the origins of both bodies.
  const std::pair<Eigen::Vector3d, Eigen::Vector3d>& ends(int strut, int line) const {
    return ends_[static_cast<std::size_t>(strut)][static_cast<std::size_t>(line)];
  }
  /// Returns Σ w L0.
  double rest_length(int strut) const { return rest_lengths_[static_cast<std::size_t>(strut)]; }
  /// Return the index of an element's first part in the memories.
  std::size_t memory_of_joint(int joint) const {
    return joint_memory_[static_cast<std::size_t>(joint)];
  }
  std::size_t memory_of_strut(int strut) const {
    return strut_memory_[static_cast<std::size_t>(strut)];
  }
  /// Returns the memories of a mechanism at rest.
  Memories no_memories() const { return Memories(memories_); }
  double mass() const;  // kg, of all bodies
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
