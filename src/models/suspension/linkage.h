// SPDX-License-Identifier: Apache-2.0
// The rigid kinematics of a wheel carrier on five links of constant length, each from a point of
// the chassis or the rack to a point of the upright. A double wishbone is represented by two links
// to the upper ball joint, two to the lower one and the track-rod: a wishbone with a fixed axis
// guides its ball joint like two links from the ends of the axis.
//
//   |p_i + R o_i - c_i| = l_i,  i = 1 ... 5        c_track-rod moves with the rack
//   z of the wheel center or of the contact point = its z at rest + travel
//
// These are six equations for the six numbers of the upright's pose. They are solved by Newton's
// method from a neighboring pose, with the rows [n', ((R o) x n)'] of the links' directions n. The
// same matrix gives the twist of the upright by travel and by rack. [Blundell & Harty, The
// Multibody Systems Approach to Vehicle Dynamics, 2nd ed. 2015, ch. 4: the same constraints, there
// between all bodies]
//
// The tire is a rigid disk on level ground. The contact point is the lowest point of its middle
// circle; its vertical velocity is that of the upright's point at this position.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <string>

#include "base/result.h"
#include "models/multibody/pose.h"
#include "models/suspension/wheel_position.h"

namespace latsch::suspension {

/// A link. Points at rest, m.
struct Link {
  std::string name;
  Eigen::Vector3d inner, outer;
};

/// A wheel. Its spin axis points to the left of the car on both sides.
struct Wheel {
  Side side = Side::left;
  Eigen::Vector3d center, spin_axis = {0.0, 1.0, 0.0};
  double radius = 0.0;  // m, of the tire's middle circle
  double offset = 0.0;  // m, of that circle from the center along the spin axis

  /// Returns the vector from the wheel center to the contact point for that spin axis.
  Eigen::Vector3d down(const Eigen::Vector3d& axis) const;
};

struct Linkage {
  static constexpr int kLinks = 5;
  std::array<Link, kLinks> links;
  int trackrod = 4;  // the link whose inner point moves with the rack, along y
  Wheel wheel;

  /// Returns what is wrong with the linkage, naming the part, or an empty text: links without
  /// length, coincident points, an upright that can move with all links and its travel held.
  std::string fault() const;
};

enum class TravelOf { wheel_center, contact };

/// Velocity of the wheel center and rotation, in the axes of the ground, per travel and per rack
/// displacement.
struct Twists {
  Vector6d by_travel, by_rack;

  /// Returns the velocity of a point of the upright at `from_center`.
  static Eigen::Vector3d at(const Vector6d& twist, const Eigen::Vector3d& from_center) {
    return twist.head<3>() + twist.tail<3>().cross(from_center);
  }
};

/// A linkage on its path from rest. Two linkages that took the same path are equal to the last bit.
class MovingLinkage {
 public:
  /// The linkage must have no fault().
  MovingLinkage(const Linkage& linkage, TravelOf of);

  /// Moves from the present pose, in as many steps as needed. A Failure names the link that ends
  /// the path, and the linkage stays there.
  Result<Pose> move_to(double travel, double rack);

  const Pose& upright() const { return pose_; }
  double travel() const { return travel_; }
  double rack() const { return rack_; }
  const Twists& twists() const { return twists_; }
  Eigen::Vector3d spin_axis() const { return pose_.turn * linkage_->wheel.spin_axis; }
  /// Vector from the wheel center to the contact point.
  Eigen::Vector3d to_contact() const { return linkage_->wheel.down(spin_axis()); }
  Eigen::Vector3d inner(int link) const;
  Eigen::Vector3d outer(int link) const;
  /// Residual of the equations, m.
  double left() const { return left_; }

 private:
  struct Equations {
    Vector6d residual;
    Matrix6d jacobian;
  };
  Equations equations(const Pose& pose, double travel, double rack) const;
  bool try_step(double travel, double rack);
  void take(const Pose& pose, double travel, double rack, double left);
  std::string end_of_way(double travel, double rack) const;

  const Linkage* linkage_;
  TravelOf of_;
  std::array<Eigen::Vector3d, Linkage::kLinks> outer_;  // in the upright's axes, origin at the
                                                        // wheel center
  std::array<double, Linkage::kLinks> length_;
  double height_;  // m, at rest, of the point that travels
  Pose pose_;
  double travel_ = 0.0, rack_ = 0.0, left_ = 0.0;
  double orientation_ = 0.0;  // sign of the Jacobian's determinant; a change means another assembly
  Eigen::PartialPivLU<Matrix6d> factors_;
  Twists twists_;
};

}  // namespace latsch::suspension
