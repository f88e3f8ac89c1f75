// SPDX-License-Identifier: Apache-2.0
// Statics of a mechanism: poses at which the elements' wrenches r and the load balance,
//   r(x) + w(x) = 0,   J = d(r + w)/dx,   x <- x - J^-1 (r + w)          Newton's method, exact J
// Where that finds nothing, everything comes on in shares s: whatever the start x0 leaves
// unbalanced (weight, preloads, loads, air, tires, drivers) is held and let go evenly,
//   r(x) + w(x; s) - (1 - s) (r(x0) + w(x0; 0)) = 0,   s from 0, where x0 rests, to 1
// with corrections d = -J^-1 (r + w) that are halved as long as the next one by the same J is no
// shorter, |J^-1 (r + w)(x + l d)| > (1 - l/4) |d|: lengths, not forces, so that stiff joints,
// which any turn strains, allow long steps [Deuflhard 2011, Newton Methods for Nonlinear Problems:
// the natural monotonicity test].
// What follows from the last J: compliance and slopes in the stiffnesses p,
//   dy/dp = -λ' dr/dp   with   J' λ = dy/dx                               adjoint
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "base/result.h"
#include "models/multibody/assembly.h"

namespace latsch::multibody {

struct EquilibriumSettings {
  double force = 1e-6;  // N and N m: the largest that may be left, or what rounding leaves
  int iterations = 20;  // of Newton's method; then the load comes on in shares
  int halvings = 8;     // of the share that is added at once: an end is found to 1/256 of the load
  double turn = 0.3;    // rad: no body turns more in one correction
  double most = 1.2;    // rad: a bushing turned more is near the end of its angles, and torn
};

/// What acts on a mechanism that comes to rest. In shares where it has to be: loads from none,
/// drivers from where they were, all else from where the start was in balance.
struct Standing {
  std::span<const Load> loads = {};
  std::span<const double> drivers = {};  // m; none: all zero
  const Outside* outside = nullptr;
};

/// Poses at rest, what friction remembers of the way there, and where drivers were.
struct Rest {
  Poses poses;
  Memories memories;
  std::vector<double> drivers = {};
};

/// Reuses its memory from one load to the next. The mechanism has to outlive it.
class Equilibrium {
 public:
  explicit Equilibrium(const Mechanism& mechanism, const EquilibriumSettings& settings = {});

  /// From `start`, or from rest. A failure names the part that gave way.
  Result<Poses> solve(std::span<const Load> loads, const Poses* start = nullptr);
  /// The same of all that can act, on from where it rested before.
  Result<Rest> solve(const Standing& standing, const Rest& before);
  Rest unloaded() const { return {mechanism_.at_rest(), mechanism_.no_memories()}; }
  /// Of the last solve.
  int iterations() const { return iterations_; }
  double left() const { return left_; }  // N, N m
  /// After a solve that failed: as it rested last, and under which share of what acts, 0 .. 1.
  const Rest& reached() const { return reached_; }
  double share() const { return share_; }

  /// Makes J at these poses under these loads that of the calls below. Empty, or which part nothing
  /// holds.
  std::string linearize(const Poses& poses, std::span<const Load> loads);
  std::string linearize(const Rest& rest, const Standing& standing);
  /// Travel and rotation of body `of` at its origin by force and moment on body `by` at a point of
  /// it, in m/N and so on: 6 x 6.
  Matrix6d compliance(int of, int by, const Eigen::Vector3d& arm) const;
  /// Slopes of outputs, `by_pose`: an output a column, in travel and rotation of all bodies, in
  /// the stiffnesses: of joint i the columns 6 i .. 6 i + 5, three of N/m and three of N m/rad.
  /// Drivers are where they were when J was made; what friction remembers is held.
  Eigen::MatrixXd by_stiffness(const Poses& poses, const Eigen::MatrixXd& by_pose) const;

 private:
  /// Empty, or why no rest was found there.
  std::string newton(Rest& rest, const Standing& standing, double share);
  std::string damped_newton(Rest& rest, const Standing& standing, double share);
  /// Corrects the poses as long as that brings them nearer; false: no length of the step does.
  bool go_on(Rest& rest, const Standing& standing, double share);
  std::string end_of_newton(Rest& rest);
  /// In shares, from a start that is held in balance.
  Result<Rest> follow(const Standing& standing, const Rest& before, const std::string& trouble);
  void assemble(const Rest& rest, const Standing& standing, double share);
  double enough() const;

  const Mechanism& mechanism_;
  EquilibriumSettings settings_;
  Assembly assembly_;
  Eigen::VectorXd step_, held_;  // held: what keeps the start in balance; empty: nothing does
  Rest reached_;
  double share_ = 0.0;
  std::vector<double> drivers_;
  int iterations_ = 0;
  double left_ = 0.0;
};

}  // namespace latsch::multibody
