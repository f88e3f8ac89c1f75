// SPDX-License-Identifier: Apache-2.0
// Rigid bodies held together and to the ground by bushings, and a load on them. Constant: where the
// bodies stand is a value of its own. Axes of all bodies are the ground's at rest.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "models/multibody/bushing.h"

namespace latsch::multibody {

constexpr int kGround = -1;

struct Body {
  std::string name;
  Eigen::Vector3d origin;  // at rest, m
};

/// A bushing between bodies a and b, either of which may be the ground.
struct Joint {
  std::string name;
  int a, b;
  Eigen::Vector3d point;  // at rest, m
  BushingParameters bushing;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // of the bushing, columns
};

/// Of fixed direction, at a point of a body.
struct Load {
  int body;
  Eigen::Vector3d point;                                                              // at rest, m
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();  // N, N m
};

using Poses = std::vector<Pose>;  // by body

class Mechanism {
 public:
  /// What is wrong, naming the part, or empty: a body without a joint, a joint of a body with
  /// itself, stiffness that is not positive, places that are not finite.
  static std::string fault(const std::vector<Body>& bodies, const std::vector<Joint>& joints);
  /// Of bodies and joints without fault.
  Mechanism(std::vector<Body> bodies, std::vector<Joint> joints);

  const std::vector<Body>& bodies() const { return bodies_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const BushingPlace& place(int joint) const { return places_[static_cast<std::size_t>(joint)]; }
  /// The same mechanism, other bushings, by joint.
  void set_bushings(const std::vector<BushingParameters>& bushings);
  Poses at_rest() const;
  /// Bodies that share a joint.
  std::vector<std::pair<int, int>> pairs() const;

 private:
  std::vector<Body> bodies_;
  std::vector<Joint> joints_;
  std::vector<BushingPlace> places_;
};

}  // namespace latsch::multibody
