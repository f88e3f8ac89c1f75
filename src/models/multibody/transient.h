// SPDX-License-Identifier: Apache-2.0
// Time integration of a mechanism: linearly implicit, of order 2.
//
//   M g1 = f(x1, v1, g1, t1)                              g: accelerations at the end of the step
//   a1 = (1 - θ) g1 + θ g0
//   x1 = x0 + h v0 + h² ((1/2 - β) a0 + β a1),  v1 = v0 + h ((1 - γ) a0 + γ a1)
//   β = (1 + θ)²/4,  γ = 1/2 + θ
// [Hilber, Hughes, Taylor 1977, Earthquake Eng. Struct. Dyn. 5, 283; here for the accelerations of
// rotating bodies]. θ = 0 is the trapezoidal rule; a small θ damps vibrations faster than the step.
// x1, v1 are predicted with a1 = a0, and corrected by one linear system,
//   (M/((1 - θ) β h²) - J) δx = f - M g1,     J = ∂f/∂x + γ/(β h) ∂f/∂v
// The remaining error is of order h⁴ per step, so the order stays 2. Forces are evaluated only once
// per step, at the predicted motion, so that forces from outside (tires on their road) may have a
// state that advances with the step. More corrections can be chosen if elements have kinks and the
// forces from outside have no state.
//
// The state is a value that can be copied, restored and compared.
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
  int corrections = 1;        // linear systems solved per step
};

struct MechanismState {
  double time = 0.0;  // s
  Poses poses;
  Eigen::VectorXd rates;  // velocity and angular velocity, six numbers per body, m/s and rad/s
  Eigen::VectorXd algorithmic, accelerations;  // a, g
  Memories memories;
  bool operator==(const MechanismState& other) const = default;
};

class Transient {
 public:
  /// Makes the integrator of a mechanism, all of whose bodies must have mass and inertia. The
  /// mechanism must outlive this object.
  explicit Transient(const Mechanism& mechanism, const TransientSettings& settings = {});

  /// Returns the state with these poses and rates (null: at rest). Its accelerations satisfy M g =
  /// f.
  Result<MechanismState> start(const Rest& rest,
                               const RestSettings& standing,
                               double time = 0.0,
                               const Eigen::VectorXd* rates = nullptr);
  /// Advances the state by `step` seconds. Loads, drivers and forces from outside are those at the
  /// end of the step. A Failure leaves the state unchanged and names the part that moves too far.
  Status advance(MechanismState& state, double step, const RestSettings& standing);

  /// Returns the motion of a state as the elements' force laws and energies need it.
  Motion motion_of(const MechanismState& state, std::span<const double> drivers = {}) const;
  const Assembly& assembly() const { return assembly_; }

 private:
  /// Add the mass matrix, and subtract the inertia forces, with the bodies' orientations at the
  /// last evaluation.
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
