// SPDX-License-Identifier: Apache-2.0
// The flexible ring tire: a belt (belt.h) on a sidewall (sidewall.h) with a tread
// (tread_contact.h), in statics and in time.
//
//   M q'' = f(q, q', t),  q: positions of the nodes and torsions of their sections          (15)
//   q1 = q0 + h v0 + h^2 ((1/2 - β) a0 + β a1),  v1 = v0 + h ((1 - γ) a0 + γ a1)            (16)
//   M a1 = (1 - θ) f1 + θ f0,  β = (1 + θ)^2/4,  γ = 1/2 + θ                                (17)
//
// θ = 0 is the trapezoidal rule. A small θ damps vibrations faster than the step, still of order 2
// [Hilber, Hughes, Taylor 1977]. Each step is solved by Newton's method with the cyclic band matrix
// M/(β h^2) + (1 - θ) (K + γ/(β h) C).
//
//   hub force = -Σ f_k,  f: all forces on the nodes except those of road and weight         (18)
//   moment = -Σ (x_k - c) × f_k + Σ (T - c) × F + p_E × M - Σ (x_k - c) × f_road,k
//
// With this moment road and hub are in balance about all axes: the sections transmit to the rim
// that part of the blocks' moment which the nodes do not carry, because ψ is measured from the rim.
//
// settle() lowers the rim from first touch in equal steps and finds the equilibrium after each
// (statics.cpp), so the friction in the contact has the history of a tire that was pressed down. If
// the wheel spins, the resulting shape stays fixed in space and the belt flows through it.
// Velocities and accelerations are then those of steady rolling, except that the shape does not
// change with the speed.
//
// The limits of the model are in docs/ring_tire.md, section 9.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/belt/inner_forces.h"
#include "models/ring_tire/belt/section_bending.h"
#include "models/ring_tire/description/ring_parameters.h"
#include "models/ring_tire/ring/free_rows.h"
#include "models/ring_tire/ring/imbalance.h"
#include "models/ring_tire/ring/motion_slopes.h"
#include "models/ring_tire/ring/ring_state.h"
#include "models/ring_tire/step/repeated_correction.h"
#include "models/ring_tire/step/tangent_reuse.h"
#include "models/ring_tire/tread/tread_contact.h"
#include "models/tire/tire.h"

namespace latsch::ring_tire {

/// Settings of the time integration and of the solution of each step.
struct RingSettings {
  double dissipation = 0.05;  // θ, 0 .. 1/3
  /// Convergence tolerance, N (for torsion: N per meter): largest residual force at a node. If a
  /// step begins with a residual above 1 kN, the tolerance grows in proportion to it. A larger
  /// value saves iterations.
  double tolerance = 0.1;
  /// Convergence tolerance in statics, N: norm of all residual forces.
  double static_tolerance = 1e-3;
  int halvings = 4;            // number of times that a step without solution is halved
  int most_iterations = 15;    // largest number of Newton iterations in a step
  int lowerings = 8;           // number of steps in which settle() lowers the rim from first touch
  double largest_step = 2e-3;  // s, longest step of advance(), which divides longer ones
};

/// Counters of the work done by advance() and settle() so far.
struct RingCounts {
  /// Time steps, evaluated residuals and factorized matrices.
  long steps = 0, evaluations = 0, factorizations = 0;
};

/// Result of a trial step: the forces on the rim and the state after it.
struct RingTrial {
  HubForces hub;    // forces on the rim
  RingState state;  // state after the step
  /// Derivatives by the wheel's motion (MotionSlopes::over()); set if they were requested and
  /// exist.
  std::optional<HubSlopes> slopes;
};

class RingTire final : public Tire {
 public:
  /// Makes a tire from the parameters of a ring, which must have no fault.
  explicit RingTire(const RingParameters& parameters, const RingSettings& settings = {});

  double free_radius() const override;
  Result<HubForces> settle(const WheelMotion& motion, const road::Road& road, double time) override;
  Result<HubForces> advance(const WheelMotion& motion,
                            const road::Road& road,
                            double time,
                            double step) override;
  Result<HubForces> advance_free(WheelMotion& motion,
                                 FreeWheel& wheel,
                                 const road::Road& road,
                                 double time,
                                 double step) override;
  /// Returns the state from which advance() continues. A step that fails does not change it.
  RingState state() const;
  /// Continues from the given state. Contacts and footprint are results of a step, so there are
  /// none until the next step.
  void restore(const RingState& state);
  /// Computes a step from the state `from` to `motion`. restore() with the returned state accepts
  /// the step; otherwise it is discarded. The result does not depend, to the last bit, on what this
  /// tire computed before. If slopes are requested, the result also contains the derivatives of the
  /// hub's forces with respect to `motion` (motion_slopes.h), but no footprint.
  Result<RingTrial> trial(const RingState& from,
                          const WheelMotion& motion,
                          const road::Road& road,
                          double time,
                          double step,
                          bool with_slopes = false);
  std::optional<Footprint> footprint() const override;
  Eigen::Matrix3Xd outline() const override;
  std::unique_ptr<Tire> clone() const override { return std::make_unique<RingTire>(*this); }

  /// The parameters from which this tire was made.
  const RingParameters& parameters() const { return parameters_; }
  /// Position, axes and rates of the rim.
  const RimFrame& rim() const { return rim_; }
  /// Bending of the belt's cross-sections.
  const SectionBending& section() const { return section_; }
  /// Positions of the nodes, one column each: x, y, z (in the inertial frame, m) and torsion of the
  /// section (rad).
  const NodeValues& positions() const { return q_; }
  /// Rates of the values in positions(), per s.
  const NodeValues& velocities() const { return v_; }
  /// Returns the tread blocks in contact with the road.
  std::vector<BlockContact> contacts() const { return tread_.contacts(q_); }
  /// Returns the forces and moments of the tread blocks on the nodes in the last step, N, N m.
  NodeValues road_forces() const;
  /// Counters of the work done so far.
  const RingCounts& counts() const { return counts_; }
  /// Returns the kinetic energy plus the energy of all springs, J.
  double energy() const;
  /// Returns the energy without that of the tread blocks' springs, J. It changes by the work of the
  /// road on the nodes.
  double inner_energy() const;
  /// The tire linearized about its present state, for small vibrations in which friction of the
  /// road and in the sidewall sticks. `maxwell` is the stiffness of the Maxwell elements, which all
  /// have the same time constant. See standing_stiffness.cpp.
  struct Linearized {
    /// Matrices for the unknowns of the nodes, in SI units.
    CyclicBand mass, stiffness, damping, maxwell;
    double time_constant;  // s, time constant of the Maxwell elements
    /// Contribution of bending cross-sections: SectionBending::border().
    Eigen::MatrixXd section_border, section_stiffness;
  };
  /// Returns mass, stiffness and damping for small vibrations about the present state.
  Linearized linearized() const;
  /// Returns the tangent stiffness of belt, sidewall and contact in the present state.
  CyclicBand stiffness();
  /// Mass of one of the belt's knots (kg, three times) and its moment of inertia about the belt (kg
  /// m^2).
  Eigen::Vector4d knot_mass() const { return mass_; }

 private:
  friend class MotionSlopes;

  static constexpr const char* kNoRoad =
      "the road has no height under the tread, or none that is finite";

  /// Evaluates the forces f of (15) at positions q and velocities v, with the rim in its present
  /// position: inner forces, then those of the road.
  void evaluate(const NodeValues& q, const NodeValues& v);
  Result<HubForces> find_rest(const WheelMotion& motion, const road::Road& road, double time);
  Status equilibrate(const road::Road& road, double time);
  bool relax();
  bool advance_along(const NodeValues& direction);
  Status lower(double from, double to, const road::Road& road, double time, int halvings);
  void guess_end(double turn);
  void predict(const WheelMotion& motion, const road::Road& road, double time, double h);
  void follow();
  bool renew_tangent();
  void balance();
  void accept();
  void roll_on(const WheelMotion& motion);
  Status advance_in_parts(const WheelMotion& motion,
                          const road::Road& road,
                          double time,
                          double step);
  Status substep(const WheelMotion& from,
                 const WheelMotion& to,
                 const road::Road& road,
                 double time,
                 double step,
                 int halvings);
  Status step_forward(const WheelMotion& motion, const road::Road& road, double time, double step);
  Status solve_step(bool held, double time);
  Status check_belt(const NodeValues& q, double time) const;
  Failure no_solution(double time, const std::string& why) const;
  bool factorize(const NodeValues& q, double mass_factor, double scale, const StepRule& rule);
  bool correct_wheel();
  /// Replaces residual_, and the residual of the sections, by Newton's step.
  void solve();
  /// Returns the largest residual force, N, of nodes, sections and a free wheel.
  double left_at_a_node(double of_nodes);
  /// Returns the norm of all residual forces.
  double left_together() const;
  /// Computes the inertia forces B' m B a (belt_curve.h) for accelerations a.
  void times_mass(const NodeValues& a, NodeValues& force) const;
  HubForces hub_forces(const Eigen::Matrix3d& carrier) const;
  void place_at_rest();

  RingParameters parameters_;
  RingSettings settings_;
  NodeAngles angles_;
  InnerForces inner_forces_;
  RingTreadContact tread_;
  SectionBending section_;
  Eigen::Vector4d mass_;
  Imbalance imbalance_;
  RimFrame rim_;
  StepRule rule_;
  // positions, velocities and forces f of (15) at the end of the last step
  NodeValues q_, v_, force_;
  NodeValues q1_, v1_, a1_, q_predicted_, v_predicted_, a_;
  NodeValues inner_, inertia_, total_, residual_;  // inertia: M a1
  CyclicBandFactor factor_;
  TangentReuse reuse_;
  RepeatedCorrection repeated_;
  WheelMotion last_motion_;
  bool settled_ = false;
  MotionSlopes slopes_;
  std::vector<StepTaken>* taken_ = nullptr;  // set while the caller records the steps of advance()
  FreeRows free_rows_;
  FreeRows* free_ = nullptr;  // set while the wheel is free
  RingCounts counts_;
};

}  // namespace latsch::ring_tire
