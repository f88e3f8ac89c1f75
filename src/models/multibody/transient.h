// SPDX-License-Identifier: Apache-2.0
// A mechanism in motion, one step after the other: linearly implicit, of order 2.
//
//   M g1 = f(x1, v1, g1, t1)                              g: accelerations at the end of the step
//   a1 = (1 - θ) g1 + θ g0
//   x1 = x0 + h v0 + h² ((1/2 - β) a0 + β a1),  v1 = v0 + h ((1 - γ) a0 + γ a1)
//   β = (1 + θ)²/4,  γ = 1/2 + θ
// [Hilber, Hughes, Taylor 1977, Earthquake Eng. Struct. Dyn. 5, 283; here for the accelerations of
// bodies that turn]. θ = 0 is the trapezoidal rule; a small θ damps what vibrates faster than the
// step. From x1, v1 predicted with a1 = a0, one linear system
//   (M/((1 - θ) β h²) - J) δx = f - M g1,     J = ∂f/∂x + γ/(β h) ∂f/∂v
// corrects them. What that leaves is of order h⁴ in a step and does not add up to less than order
// 2, so forces are asked for once a step, at the predicted motion: forces from outside (tires on
// their road) may have a state of their own that goes on with the step. More corrections can be
// asked for where elements have kinks and nothing outside has a state.
//
// The state is a value: copied, restored, compared.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/multibody/assembly.h"
#include "models/multibody/equilibrium.h"

namespace latsch::multibody {

struct TransientSettings {
  double dissipation = 0.05;  // θ, 0 .. 1/3
  int corrections = 1;        // linear systems a step
};

struct MechanismState {
  double time = 0.0;  // s
  Poses poses;
  Eigen::VectorXd rates;  // velocity and angular velocity, six a body, m/s and rad/s
  Eigen::VectorXd algorithmic, accelerations;  // a, g
  Memories memories;
  bool operator==(const MechanismState& other) const = default;
};

class Transient {
 public:
  /// The mechanism, all of whose bodies have mass and inertia, has to outlive it.
  explicit Transient(const Mechanism& mechanism, const TransientSettings& settings = {});

  /// At these poses with these rates (none: at rest), accelerations such that M g = f.
  Result<MechanismState> start(const Rest& rest,
                               const Standing& standing,
                               double time = 0.0,
                               const Eigen::VectorXd* rates = nullptr);
  /// To `step` seconds later; loads, drivers and what is outside are those of the end. A Failure
  /// leaves the state as it was and names the part that moves beyond reason.
  Result<bool> advance(MechanismState& state, double step, const Standing& standing);

  /// What is asked of elements and energies at a state.
  Motion motion_of(const MechanismState& state, std::span<const double> drivers = {}) const;
  const Assembly& assembly() const { return assembly_; }

 private:
  /// Of bodies turned as in the last evaluation.
  void add_mass(double scale);
  void subtract_inertia(const Eigen::VectorXd& accelerations);
  void place(const MechanismState& from, double h, MechanismState& to) const;

  const Mechanism& mechanism_;
  TransientSettings settings_;
  Assembly assembly_;
  double beta_, gamma_;
  MechanismState next_;
  Eigen::VectorXd correction_;
};

}  // namespace latsch::multibody
