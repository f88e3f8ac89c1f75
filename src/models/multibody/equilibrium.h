// SPDX-License-Identifier: Apache-2.0
// Statics of a mechanism: poses at which the elements' wrenches r and the load balance,
//   r(x) + w(x) = 0,   J = d(r + w)/dx,   x <- x - J^-1 (r + w)          Newton's method, exact J
// If this fails, the load is applied in shares s. The imbalance at the start x0 (weight, preloads,
// loads, air, tires, drivers) is compensated by additional forces, which are reduced in proportion,
//   r(x) + w(x; s) - (1 - s) (r(x0) + w(x0; 0)) = 0,   s from 0, with x0 in equilibrium, to 1
// with corrections d = -J^-1 (r + w). A correction is halved until the next one with the same J is
// shorter, |J^-1 (r + w)(x + l d)| <= (1 - l/4) |d|. The criterion compares lengths of corrections,
// not forces. It therefore allows long steps even if stiff joints, which every rotation strains,
// have large forces [Deuflhard 2011, Newton Methods for Nonlinear Problems: the natural
// monotonicity test]. The last J also gives the compliance and the slopes by the stiffnesses p,
//   dy/dp = -λ' dr/dp   with   J' λ = dy/dx                               adjoint
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "base/result.h"
#include "models/multibody/assembly.h"

namespace latsch::multibody {

struct EquilibriumSettings {
  // N and N m: largest residual at convergence, unless rounding errors are larger
  double force = 1e-6;
  int iterations = 20;  // largest number of Newton steps before the load is applied in shares
  // Largest number of halvings of the load increment: the last share found is accurate to 1/256.
  int halvings = 8;
  double turn = 0.3;  // rad: largest rotation of a body in one correction
  // Largest rotation of a bushing, rad. A bushing that turns more counts as torn; its angles become
  // singular at a right angle.
  double most = 1.2;
};

/// Forces and drivers that act on a mechanism in equilibrium. If they are applied in shares, loads
/// start from zero, drivers from their previous values, and all others from balance at the start.
struct RestSettings {
  std::span<const Load> loads = {};
  std::span<const double> drivers = {};  // m, travels of the drivers; empty: all zero
  const Outside* outside = nullptr;
};

/// An equilibrium: poses of the bodies, memories of friction after the path to it, and the values
/// of the drivers.
struct Rest {
  Poses poses;
  Memories memories;
  std::vector<double> drivers = {};
};

/// Newton solver for equilibria. Its memory is reused from one load to the next. The mechanism must
/// outlive it.
class Equilibrium {
 public:
  explicit Equilibrium(const Mechanism& mechanism, const EquilibriumSettings& settings = {});

  /// Solves for the equilibrium under these loads, starting from the poses `start`, or from the
  /// position at rest if `start` is null. A Failure names the part that failed.
  Result<Poses> solve(std::span<const Load> loads, const Poses* start = nullptr);
  /// Solves for the equilibrium under loads, drivers and forces from outside, starting at an
  /// equilibrium found before.
  Result<Rest> solve(const RestSettings& standing, const Rest& before);
  Rest unloaded() const { return {mechanism_.at_rest(), mechanism_.no_memories()}; }
  /// Number of Newton iterations of the last solve.
  int iterations() const { return iterations_; }
  double left() const { return left_; }  // residual, N, N m
  /// Returns the last equilibrium found before a solve failed, and the share of the loads applied
  /// there, 0 to 1.
  const Rest& reached() const { return reached_; }
  double share() const { return share_; }

  /// Computes J at these poses under these loads, for the functions below. Returns a Failure that
  /// names the part that can move without resistance.
  Status linearize(const Poses& poses, std::span<const Load> loads);
  Status linearize(const Rest& rest, const RestSettings& standing);
  /// Returns the compliance matrix, 6 x 6: displacement (m) and rotation (rad) of body `of` at its
  /// origin, per force (N) and moment (N m) on body `by` at a point of it.
  Matrix6d compliance(int of, int by, const Eigen::Vector3d& arm) const;
  /// Returns the derivatives of outputs with respect to the stiffnesses of the joints. `by_pose`
  /// holds one column per output: its derivatives by displacement and rotation of all bodies. Of
  /// the result, joint i has the columns 6 i to 6 i + 5, three per N/m and three per N m/rad.
  /// Drivers keep the values they had when J was computed, and friction keeps its memories.
  Eigen::MatrixXd by_stiffness(const Poses& poses, const Eigen::MatrixXd& by_pose) const;

 private:
  /// Finds the equilibrium under this share of the actions by Newton's method. Returns a Failure if
  /// there is none.
  Status newton(Rest& rest, const RestSettings& standing, double share);
  Status damped_newton(Rest& rest, const RestSettings& standing, double share);
  /// Repeats Newton corrections as long as they become shorter. Returns false if no step length
  /// makes the next correction shorter.
  bool go_on(Rest& rest, const RestSettings& standing, double share);
  Status end_of_newton(Rest& rest);
  /// Applies the actions in increasing shares, from a start that compensating forces keep in
  /// balance.
  Result<Rest> follow(const RestSettings& standing, const Rest& before, const Failure& at_once);
  void assemble(const Rest& rest, const RestSettings& standing, double share);
  /// Returns the residual, N and N m, at which poses count as an equilibrium.
  double enough(const Poses& poses) const;

  const Mechanism& mechanism_;
  EquilibriumSettings settings_;
  Assembly assembly_;
  // Forces that compensate the imbalance of the start (held_); empty: none.
  Eigen::VectorXd step_, held_;
  Rest reached_;
  double share_ = 0.0;
  std::vector<double> drivers_;
  int iterations_ = 0;
  double left_ = 0.0;
};

}  // namespace latsch::multibody
