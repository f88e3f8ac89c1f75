// SPDX-License-Identifier: Apache-2.0
// Forces of all elements of a mechanism on its bodies at a pose and motion, and their derivatives:
// f(x, v) and the blocks of
//   J = ∂f/∂x + share ∂f/∂v,    share: change of v per change of x within a step; 0 in statics
// Forces are about the bodies' origins, in the ground's axes. ∂f/∂x omits the effect of rotating
// axes and arms on velocities and damping forces, which is small beside a damper's part.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "models/multibody/block_elimination.h"
#include "models/multibody/bushing_batch.h"
#include "models/multibody/mechanism.h"

namespace latsch::multibody {

/// Force and moment on a body about its origin from something outside the mechanism.
struct BodyForce {
  int body;
  Vector6d value = Vector6d::Zero();   // N, N m
  Matrix6d slopes = Matrix6d::Zero();  // ∂/∂x + share ∂/∂v, their significant parts
};

/// Poses, velocities and further data for which forces are computed.
struct Motion {
  const Poses& poses;
  const Eigen::VectorXd* rates = nullptr;          // velocity and angular velocity; null: zero
  const Eigen::VectorXd* accelerations = nullptr;  // needed for inerters and inertia; null: zero
  const Memories* memories = nullptr;              // at the end of the last step; null: those at
                                                   // rest
  std::span<const double> drivers = {};            // empty: all zero
  double time = 0.0;                               // s
  double step = kStatics;                          // s since the memories' time
  double share = 0.0;                              // 1/s
  double acceleration_share = 0.0;                 // 1/s^2: change of accelerations per change of x
                                                   // in a step
};

/// Adds actions from outside, such as tires on their road.
using Outside = std::function<void(const Motion&, std::vector<BodyForce>&)>;

class Assembly {
 public:
  /// The mechanism must outlive this object.
  explicit Assembly(const Mechanism& mechanism);

  /// Computes forces and J for this motion: of elements, weight, loads (scaled by `load_share`),
  /// actions from outside and the gyroscopic terms -ω × I ω, without M a.
  void evaluate(const Motion& motion,
                std::span<const Load> loads,
                double load_share,
                const Outside& outside);
  Eigen::VectorXd& forces() { return forces_; }
  const Eigen::VectorXd& forces() const { return forces_; }
  BlockElimination& J() { return J_; }
  const BlockElimination& J() const { return J_; }
  /// Largest angle of a bushing at the last evaluation, rad.
  double turned() const { return turned_; }
  /// Inertia of the body in its orientation at the last evaluation of a motion, about the ground's
  /// axes.
  const Eigen::Matrix3d& inertia(int body) const {
    return inertia_[static_cast<std::size_t>(body)];
  }

  /// Sets the memories of the parts at the end of a step that ends in this motion.
  void remember(const Motion& motion, Memories& kept) const;
  /// Returns force and moment of a joint on its second body at its own point, in the ground's axes.
  Vector6d joint_load(int joint, const Motion& motion) const;
  /// Returns the tension of a strut, N.
  double strut_force(int strut, const Motion& motion) const;
  /// Returns the extension from rest, m, without its driver's travel.
  double extension(int strut, const Poses& poses) const;
  /// Returns the potential energy of all springs, parts, and weight relative to rest, J, without
  /// loads and actions from outside.
  double potential_energy(const Motion& motion) const;
  double kinetic_energy(const Poses& poses, const Eigen::VectorXd& rates) const;
  /// Names the part with the largest rotation.
  std::string most_turned(const Poses& poses) const;
  /// Returns the rounding error of forces that cancel, N: the stiffest bushing times some last
  /// digits of the largest coordinate at rest, or of the largest displacement in these poses. A
  /// mechanism that stands far from its position at rest has a larger one.
  double rounding(const Poses& poses) const;

 private:
  struct Blocks {
    int aa, ab, ba, bb;  // positions in J; -1: a is the ground
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
    double force = 0.0, slope = 0.0;  // tension; its slope by extension
    std::vector<LineGeometry>& lines;
  };
  StrutAnswer answer(int strut,
                     const Motion& motion,
                     PartMemory* kept,
                     std::vector<LineGeometry>& lines) const;

  const Mechanism& mechanism_;
  BlockElimination J_;
  std::vector<Blocks> joint_blocks_;
  std::vector<int> plain_;  // joints with springs and dampers only
  std::vector<BushingTask> tasks_;
  std::vector<BushingPlace> driven_;  // for joints with a driver, by joint; unset for others
  std::vector<LineGeometry> lines_;
  Eigen::VectorXd forces_;
  std::vector<Eigen::Matrix3d> inertia_;
  std::vector<BodyForce> outside_;
  Memories none_;  // memories at rest
  Pose ground_;
  double turned_ = 0.0;
};

/// Returns the moments of inertia of a body in its orientation, about the ground's axes.
Eigen::Matrix3d turned_inertia(const Body& body, const Pose& pose);

}  // namespace latsch::multibody
