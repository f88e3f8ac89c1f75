// SPDX-License-Identifier: Apache-2.0
// What all elements of a mechanism do to its bodies where they stand and as they move, and how that
// changes: f(x, v) and the blocks of
//   J = ∂f/∂x + share ∂f/∂v,    share: by how much v changes with x within a step; 0 in statics
// Forces are about the bodies' origins, in the ground's axes. ∂f/∂x leaves out what velocities and
// damping forces owe to the turning of axes and arms, which is small beside a damper's share.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "models/multibody/block_elimination.h"
#include "models/multibody/bushing_batch.h"
#include "models/multibody/mechanism.h"

namespace latsch::multibody {

/// On a body, by something that is no element of the mechanism: force and moment about its origin.
struct Wrench {
  int body;
  Vector6d value = Vector6d::Zero();   // N, N m
  Matrix6d slopes = Matrix6d::Zero();  // ∂/∂x + share ∂/∂v, as far as they matter
};

/// Where and how the bodies are when forces are asked for.
struct Motion {
  const Poses& poses;
  const Eigen::VectorXd* rates = nullptr;          // velocity and angular velocity; null: at rest
  const Eigen::VectorXd* accelerations = nullptr;  // null: none; inerters and inertia need them
  const Memories* memories = nullptr;              // of the end of the last step; null: of rest
  std::span<const double> drivers = {};            // none: all zero
  double time = 0.0;                               // s
  double step = kStatics;                          // s since the memories' time
  double share = 0.0;                              // 1/s
  double acceleration_share = 0.0;                 // 1/s^2: of accelerations by x, within a step
};

/// Adds what acts from outside (tires on their road).
using Outside = std::function<void(const Motion&, std::vector<Wrench>&)>;

class Assembly {
 public:
  /// The mechanism has to outlive it.
  explicit Assembly(const Mechanism& mechanism);

  /// Forces and J at this motion: of elements, weight, loads (scaled by `load_share`) and from
  /// outside, also what turning bodies owe to their inertia (-ω × I ω), without M a.
  void evaluate(const Motion& motion,
                std::span<const Load> loads,
                double load_share,
                const Outside& outside);
  Eigen::VectorXd& forces() { return forces_; }
  const Eigen::VectorXd& forces() const { return forces_; }
  BlockElimination& J() { return J_; }
  const BlockElimination& J() const { return J_; }
  /// The largest angle of a bushing at the last evaluation, rad.
  double turned() const { return turned_; }
  /// As the body was turned at the last evaluation of a motion, about the ground's axes.
  const Eigen::Matrix3d& inertia(int body) const {
    return inertia_[static_cast<std::size_t>(body)];
  }

  /// What the parts remember at the end of a step that ends in this motion.
  void remember(const Motion& motion, Memories& kept) const;
  /// Force and moment of a joint on its second body at its own point, in the ground's axes.
  Vector6d joint_load(int joint, const Motion& motion) const;
  /// N, tension.
  double strut_force(int strut, const Motion& motion) const;
  /// m, against rest, without its driver's travel.
  double extension(int strut, const Poses& poses) const;
  /// Of all springs, of what parts store, and of weight against rest, J. Not of loads and outside.
  double potential_energy(const Motion& motion) const;
  double kinetic_energy(const Poses& poses, const Eigen::VectorXd& rates) const;
  /// The part that is turned most, in words.
  std::string most_turned(const Poses& poses) const;
  /// Of forces that cancel, by the stiffest bushing, N.
  double rounding() const;

 private:
  struct Blocks {
    int aa, ab, ba, bb;  // of J; -1: a is the ground
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
    double force = 0.0, slope = 0.0;  // tension; by extension
    std::vector<LineGeometry>& lines;
  };
  StrutAnswer answer(int strut,
                     const Motion& motion,
                     PartMemory* kept,
                     std::vector<LineGeometry>& lines) const;

  const Mechanism& mechanism_;
  BlockElimination J_;
  std::vector<Blocks> joint_blocks_;
  std::vector<int> plain_;  // joints without parts: springs and dampers alone
  std::vector<BushingTask> tasks_;
  std::vector<BushingPlace> driven_;  // of joints with a driver, by joint; of others not set
  std::vector<LineGeometry> lines_;
  Eigen::VectorXd forces_;
  std::vector<Eigen::Matrix3d> inertia_;
  std::vector<Wrench> outside_;
  Memories none_;  // of rest
  Pose ground_;
  double turned_ = 0.0;
};

/// Moments of inertia of a body as it is turned, about the ground's axes.
Eigen::Matrix3d turned_inertia(const Body& body, const Pose& pose);

}  // namespace latsch::multibody
