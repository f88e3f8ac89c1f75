// SPDX-License-Identifier: Apache-2.0
// Statics of a mechanism: poses at which the elements' wrenches r and the load balance,
//   r(x) + w(x) = 0,   J = d(r + w)/dx,   x <- x - J^-1 (r + w)          Newton's method, exact J
// If this fails, the load is applied in shares s. The unbalance at the start x0 (weight, preloads,
// loads, air, tires, drivers) is compensated and released evenly,
//   r(x) + w(x; s) - (1 - s) (r(x0) + w(x0; 0)) = 0,   s from 0, with x0 in equilibrium, to 1
// with corrections d = -J^-1 (r + w). A correction is halved until the next one with the same J is
// shorter, |J^-1 (r + w)(x + l d)| <= (1 - l/4) |d|. The criterion uses lengths, not forces, so
// that stiff joints, which any rotation strains, allow long steps [Deuflhard 2011, Newton Methods
// for Nonlinear Problems: the natural monotonicity test].
// The last J also gives the compliance and the slopes by the stiffnesses p,
//   dy/dp = -λ' dr/dp   with   J' λ = dy/dx                               adjoint
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "base/result.h"
#include "models/multibody/assembly.h"

namespace latsch::multibody {

struct EquilibriumSettings {
  double force = 1e-6;  // N and N m: largest residual, unless rounding leaves more
  int iterations = 20;  // steps of Newton's method; then the load is applied in shares
  int halvings = 8;     // halvings of the added share: the last share found is exact to 1/256
  double turn = 0.3;    // rad: largest rotation of a body in one correction
  double most = 1.2;    // rad: a bushing turned more is torn, near the end of its angles
};

/// Actions on a mechanism that comes to rest. If they are applied in shares, loads start from none,
/// drivers from their previous values, and all others from balance at the start.
struct RestSettings {
  std::span<const Load> loads = {};
  std::span<const double> drivers = {};  // m; empty: all zero
  const Outside* outside = nullptr;
};

/// Poses at rest, the memories of friction on the path there, and the values of the drivers.
struct Rest {
  Poses poses;
  Memories memories;
  std::vector<double> drivers = {};
};

/// Solver whose memory is reused from one load to the next. The mechanism must outlive it.
class Equilibrium {
 public:
  explicit Equilibrium(const Mechanism& mechanism, const EquilibriumSettings& settings = {});

  /// Solves from `start`, or from rest. A Failure names the part that failed.
  Result<Poses> solve(std::span<const Load> loads, const Poses* start = nullptr);
  /// Solves for all kinds of action, starting at the rest found before.
  Result<Rest> solve(const RestSettings& standing, const Rest& before);
  Rest unloaded() const { return {mechanism_.at_rest(), mechanism_.no_memories()}; }
  /// Iterations of the last solve.
  int iterations() const { return iterations_; }
  double left() const { return left_; }  // residual, N, N m
  /// After a failed solve: the last rest found, and the share of the actions there, 0 .. 1.
  const Rest& reached() const { return reached_; }
  double share() const { return share_; }

  /// Computes J at these poses under these loads for the functions below. Returns a
  /// Failure that names the part that nothing holds.
  Status linearize(const Poses& poses, std::span<const Load> loads);
  Status linearize(const Rest& rest, const RestSettings& standing);
  /// Returns travel and rotation of body `of` at its origin per force and moment on body `by` at a
  /// point of it, in m/N and so on: 6 x 6.
  Matrix6d compliance(int of, int by, const Eigen::Vector3d& arm) const;
  /// Returns slopes of outputs by the stiffnesses. `by_pose` holds an output per column,
  /// differentiated by travel and rotation of all bodies. Joint i has the columns 6 i .. 6 i + 5,
  /// three per N/m and three per N m/rad. Drivers keep the values they had when J was computed, and
  /// friction its memories.
  Eigen::MatrixXd by_stiffness(const Poses& poses, const Eigen::MatrixXd& by_pose) const;

 private:
  /// Returns a Failure if no rest was found.
  Status newton(Rest& rest, const RestSettings& standing, double share);
  Status damped_newton(Rest& rest, const RestSettings& standing, double share);
  /// Corrects the poses as long as corrections become shorter. Returns false if no step length
  /// achieves this.
  bool go_on(Rest& rest, const RestSettings& standing, double share);
  Status end_of_newton(Rest& rest);
  /// Applies the actions in shares, from a start that is held in balance.
  Result<Rest> follow(const RestSettings& standing, const Rest& before, const Failure& at_once);
  void assemble(const Rest& rest, const RestSettings& standing, double share);
  /// Returns the residual, N and N m, at which poses count as an equilibrium.
  double enough(const Poses& poses) const;

  const Mechanism& mechanism_;
  EquilibriumSettings settings_;
  Assembly assembly_;
  Eigen::VectorXd step_, held_;  // held: compensates the imbalance of the start; empty: none
  Rest reached_;
  double share_ = 0.0;
  std::vector<double> drivers_;
  int iterations_ = 0;
  double left_ = 0.0;
};

}  // namespace latsch::multibody
