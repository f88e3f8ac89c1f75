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

/// One of the five links of a wheel carrier. Points at rest, m.
struct Link {
  std::string name;
  Eigen::Vector3d inner, outer;
};

/// A wheel with its rigid tire. Its spin axis points to the left of the car on both sides.
struct Wheel {
  Side side = Side::left;
  Eigen::Vector3d center, spin_axis = {0.0, 1.0, 0.0};
  double radius = 0.0;  // m, radius of the tire's middle circle
  double offset = 0.0;  // m, distance of that circle from the wheel center along the spin axis

  /// Returns the vector from the wheel center to the contact point for this spin axis.
  Eigen::Vector3d down(const Eigen::Vector3d& axis) const;
};

struct Linkage {
  static constexpr int kLinks = 5;
  std::array<Link, kLinks> links;
  int trackrod = 4;  // index of the link whose inner point moves with the rack along y
  Wheel wheel;

  /// Returns an empty text for a valid linkage, otherwise a message that names the part: a link
  /// without length, coincident points, or an upright that can move while all links and its travel
  /// are held.
  std::string fault() const;
};

enum class TravelOf { wheel_center, contact };

/// Derivatives of the upright's position: velocity of the wheel center and angular velocity, in the
/// axes of the ground, per wheel travel and per rack travel.
struct Twists {
  Vector6d by_travel, by_rack;

  /// Returns the velocity of the upright's point that lies at `from_center` relative to the wheel
  /// center.
  static Eigen::Vector3d at(const Vector6d& twist, const Eigen::Vector3d& from_center) {
    return twist.head<3>() + twist.tail<3>().cross(from_center);
  }
};

/// A linkage that moves from its position at rest. Two linkages that made the same movements are
/// equal to the last bit.
class MovingLinkage {
 public:
  /// Makes the linkage in its position at rest. It must have no fault().
  MovingLinkage(const Linkage& linkage, TravelOf of);

  /// Moves the linkage from its present position to this wheel travel and rack travel, in as many
  /// steps as needed. A Failure names the link that limits the motion; the linkage then stays at
  /// the end of its range.
  Result<Pose> move_to(double travel, double rack);

  const Pose& upright() const { return pose_; }
  double travel() const { return travel_; }
  double rack() const { return rack_; }
  const Twists& twists() const { return twists_; }
  Eigen::Vector3d spin_axis() const { return pose_.turn * linkage_->wheel.spin_axis; }
  /// Returns the vector from the wheel center to the contact point.
  Eigen::Vector3d to_contact() const { return linkage_->wheel.down(spin_axis()); }
  Eigen::Vector3d inner(int link) const;
  Eigen::Vector3d outer(int link) const;
  /// Returns the residual of the link equations, m.
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
  // Outer points of the links in the upright's axes, relative to the wheel center.
  std::array<Eigen::Vector3d, Linkage::kLinks> outer_;
  std::array<double, Linkage::kLinks> length_;
  double height_;  // m, height at rest of the point whose travel is prescribed
  Pose pose_;
  double travel_ = 0.0, rack_ = 0.0, left_ = 0.0;
  // Sign of the Jacobian's determinant; if it changes, another assembly was reached.
  double orientation_ = 0.0;
  Eigen::PartialPivLU<Matrix6d> factors_;
  Twists twists_;
};

}  // namespace latsch::suspension
