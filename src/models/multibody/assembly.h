// SPDX-License-Identifier: Apache-2.0
// Forces of all elements of a mechanism on its bodies at a pose and motion, and their derivatives:
// f(x, v) and the blocks of
//   J = ∂f/∂x + share ∂f/∂v,    share: change of v per change of x within a step; 0 in statics
// Forces are about the bodies' origins, in the ground's axes. ∂f/∂x omits the effect of rotating
// axes and arms on velocities and damping forces, which is small compared with ∂f/∂v of a damper.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "models/multibody/block_elimination.h"
#include "models/multibody/bushing_batch.h"
#include "models/multibody/mechanism.h"

namespace latsch::multibody {

/// Force and moment on a body about its origin, exerted by something outside the mechanism.
struct BodyForce {
  int body;
  Vector6d value = Vector6d::Zero();  // N, N m
  Matrix6d slopes = Matrix6d::Zero();  // ∂/∂x + share ∂/∂v of the wrench, significant parts only
};

/// Poses and velocities of the bodies, and further data, for which the forces are computed.
struct Motion {
  const Poses& poses;
  // Velocity and angular velocity, six numbers per body; null: zero.
  const Eigen::VectorXd* rates = nullptr;
  // Needed for inerters and inertia forces; null: zero.
  const Eigen::VectorXd* accelerations = nullptr;
  // Memories of the force parts at the end of the last step; null: those at rest.
  const Memories* memories = nullptr;
  std::span<const double> drivers = {};  // values of the drivers; empty: all zero
  double time = 0.0;                     // s
  double step = kStatics;  // s, time since the state of the memories; infinite in statics
  double share = 0.0;      // 1/s
  // 1/s^2: change of the accelerations per change of x within a step
  double acceleration_share = 0.0;
};

/// Function that adds forces on bodies from outside the mechanism, such as those of tires on their
/// road.
using Outside = std::function<void(const Motion&, std::vector<BodyForce>&)>;

class Assembly {
 public:
  /// Makes the assembly of a mechanism, which must outlive this object.
  explicit Assembly(const Mechanism& mechanism);

  /// Computes the forces and J for this motion, for elements, weight, loads (scaled by
  /// `load_share`), forces from outside and the gyroscopic terms -ω × I ω. The term M a is not
  /// included.
  void evaluate(const Motion& motion,
                std::span<const Load> loads,
                double load_share,
                const Outside& outside);
  Eigen::VectorXd& forces() { return forces_; }
  const Eigen::VectorXd& forces() const { return forces_; }
  BlockElimination& J() { return J_; }
  const BlockElimination& J() const { return J_; }
  /// Returns the largest angle by which a bushing was turned at the last evaluation, rad.
  double turned() const { return turned_; }
  /// Returns the inertia tensor of a body in its orientation at the last evaluation of a motion,
  /// about the ground's axes.
  const Eigen::Matrix3d& inertia(int body) const {
    return inertia_[static_cast<std::size_t>(body)];
  }

  /// Sets the memories of the force parts to those at the end of a step that ends in this motion.
  void remember(const Motion& motion, Memories& kept) const;
  /// Returns the force and moment of a joint on its second body, at the joint's point of that body,
  /// in the ground's axes.
  Vector6d joint_load(int joint, const Motion& motion) const;
  /// Returns the tension of a strut, N.
  double strut_force(int strut, const Motion& motion) const;
  /// Returns the extension of a strut from rest, m, without the travel of its driver.
  double extension(int strut, const Poses& poses) const;
  /// Returns the potential energy relative to rest, J, of all springs, force parts and weight,
  /// without that of loads and forces from outside.
  double potential_energy(const Motion& motion) const;
  double kinetic_energy(const Poses& poses, const Eigen::VectorXd& rates) const;
  /// Returns the name of the bushing that is turned by the largest angle.
  std::string most_turned(const Poses& poses) const;
  /// Returns the rounding error of a sum of forces in balance, N: the stiffness of the stiffest
  /// bushing times some units in the last place of the largest coordinate at rest, or of the
  /// largest displacement in these poses. The farther a mechanism is from its position at rest, the
  /// larger is the error.
  double rounding(const Poses& poses) const;

 private:
  struct Blocks {
    // Indices of blocks in J, by bodies a and b of the element; -1: a is the ground.
    int aa, ab, ba, bb;
  };
  const Pose& pose(const Poses& poses, int body) const;
  BushingStrain strain(int joint, const Motion& motion) const;
  void add_plain_joints(const Motion& motion);
  void add_joint(int joint, const Motion& motion);
  void add_strut(int strut, const Motion& motion);
  void add_body(int body, const Motion& motion);
  void add_load(const Load& load, double share, const Poses& poses);
  void add(int body, const Vector6d& wrench);
  struct StrutAnswer {
    double force = 0.0, slope = 0.0;  // tension of the strut; its derivative by the extension
    std::vector<LineGeometry>& lines;
  };
  StrutAnswer answer(int strut,
                     const Motion& motion,
                     PartMemory* kept,
                     std::vector<LineGeometry>& lines) const;

  const Mechanism& mechanism_;
  BlockElimination J_;
  std::vector<Blocks> joint_blocks_;
  std::vector<int> plain_;  // indices of the joints that have springs and dampers only
  std::vector<BushingTask> tasks_;
  // Attachment points of joints with a driver, by index of the joint; unset for others.
  std::vector<BushingPlace> driven_;
  std::vector<LineGeometry> lines_;
  Eigen::VectorXd forces_;
  std::vector<Eigen::Matrix3d> inertia_;
  std::vector<BodyForce> outside_;
  Memories none_;  // memories of the force parts at rest
  Pose ground_;
  double turned_ = 0.0;
};

/// Returns the inertia tensor of a body in the orientation of its pose, about the ground's axes.
Eigen::Matrix3d turned_inertia(const Body& body, const Pose& pose);

}  // namespace latsch::multibody
