// SPDX-License-Identifier: Apache-2.0
// Flexible ring tire: belt.h on sidewall.h with tread_contact.h, in statics and in time.
//
//   M q'' = f(q, q', t),  q: positions of the nodes and torsions of their sections          (15)
//   q1 = q0 + h v0 + h^2 ((1/2 - β) a0 + β a1),  v1 = v0 + h ((1 - γ) a0 + γ a1)            (16)
//   M a1 = (1 - θ) f1 + θ f0,  β = (1 + θ)^2/4,  γ = 1/2 + θ                                (17)
// θ = 0 is the trapezoidal rule. A small θ damps vibrations faster than the step, still of order 2
// [Hilber, Hughes, Taylor 1977]. Each step is solved by Newton's method with the cyclic band matrix
// M/(β h^2) + (1 - θ) (K + γ/(β h) C).
//   hub force = -Σ f_k,  f: all but those of road and weight                                (18)
//   moment = -Σ (x_k - c) × f_k + Σ (T - c) × F + p_E × M - Σ (x_k - c) × f_road,k
// so that road and hub agree about all axes: the sections transmit the part of the blocks' moment
// that the nodes do not carry to the rim, from which ψ is measured.
//
// settle() lowers the rim from first touch in equal steps, each an equilibrium (statics.cpp), so
// friction in the contact has the history of a tire pressed down. If the wheel spins, the resulting
// shape is kept in space and the belt flows through it, with velocities and accelerations of steady
// rolling except for the change due to speed.
//   Limits: docs/ring_tire.md, section 9.
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

/// Numbers of the time integration and of the solution of each step.
struct RingSettings {
  double dissipation = 0.05;  // θ, 0 .. 1/3
  /// Tolerance, N (for torsion: N per meter): largest residual force at a node. If a step begins
  /// with a residual above 1 kN, the tolerance grows in proportion. A larger value saves
  /// iterations.
  double tolerance = 0.1;
  double static_tolerance = 1e-3;  // N, norm of all residual forces
  int halvings = 4;                // number of times a step without solution is halved
  int most_iterations = 15;        // largest number of Newton iterations in a step
  int lowerings = 8;               // steps of the rim from first touch in settle()
  double largest_step = 2e-3;      // s; advance() divides longer ones
};

/// Cost of advance() and settle() so far.
struct RingCounts {
  long steps = 0, evaluations = 0, factorizations = 0;  // steps, residuals and factorized matrices
};

/// A trial step: the forces on the rim and the state after it.
struct RingTrial {
  HubForces hub;    // on the rim
  RingState state;  // state after the step
  /// Present if requested and available: MotionSlopes::over().
  std::optional<HubSlopes> slopes;
};

class RingTire final : public Tire {
 public:
  /// Takes the numbers of a ring; they must have no fault.
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
  /// Returns everything from which advance() continues. A step that fails does not change it.
  RingState state() const;
  /// Continues from the given state. Contacts and footprint belong to a step, so there are none
  /// until the next step.
  void restore(const RingState& state);
  /// Computes a step from `from` to `motion` with this tire's memory. restore() of the returned
  /// state accepts the step; otherwise it is discarded. The result does not depend on what was
  /// computed before, to the last bit. With slopes it also has the derivatives of the hub's forces
  /// with respect to `motion`, motion_slopes.h, but no footprint.
  Result<RingTrial> trial(const RingState& from,
                          const WheelMotion& motion,
                          const road::Road& road,
                          double time,
                          double step,
                          bool with_slopes = false);
  std::optional<Footprint> footprint() const override;
  Eigen::Matrix3Xd outline() const override;
  std::unique_ptr<Tire> clone() const override { return std::make_unique<RingTire>(*this); }

  /// The parameters it was made from.
  const RingParameters& parameters() const { return parameters_; }
  /// Position, axes and rates of the rim.
  const RimFrame& rim() const { return rim_; }
  /// Bending of the sections across the belt.
  const SectionBending& section() const { return section_; }
  /// Positions of the nodes, one column each: x, y, z (inertial, m) and torsion of the section
  /// (rad).
  const NodeValues& positions() const { return q_; }
  /// Rates of positions(), per s.
  const NodeValues& velocities() const { return v_; }
  /// Returns the blocks on the road.
  std::vector<BlockContact> contacts() const { return tread_.contacts(q_); }
  /// Forces and moments of the blocks on the nodes in the last step, N, N m.
  NodeValues road_forces() const;
  /// Cost of all steps so far.
  const RingCounts& counts() const { return counts_; }
  /// Kinetic energy and that of all springs, J.
  double energy() const;
  /// Energy without the blocks' springs, J. It changes by the road's work on the nodes.
  double inner_energy() const;
  /// Linearization of the tire in its present state for small vibrations: friction of the road and
  /// in the sidewall sticks. `maxwell` is the stiffness of the Maxwell elements, which have one
  /// time constant. See standing_stiffness.cpp.
  struct Linearized {
    CyclicBand mass, stiffness, damping, maxwell;  // matrices over the nodes, SI
    double time_constant;                          // s, of the Maxwell elements
    /// Contribution of the bending of sections: SectionBending::border().
    Eigen::MatrixXd section_border, section_stiffness;
  };
  /// Returns mass, stiffness and damping for small vibrations about the present state.
  Linearized linearized() const;
  /// Tangent stiffness of belt, sidewall and contact in the present state, and the mass of a knot
  /// (m, m, m, J).
  CyclicBand stiffness();
  /// Mass of one node (kg, three times) and its moment of inertia about the belt (kg m^2).
  Eigen::Vector4d knot_mass() const { return mass_; }

 private:
  friend class MotionSlopes;

  static constexpr const char* kNoRoad =
      "the road has no height under the tread, or none that is finite";

  /// Evaluates f of (15) at q, v with the present rim: inner forces, then those of the road.
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
  /// Replaces residual_ and the section's residual by Newton's step.
  void solve();
  /// Returns the largest residual force, N, including the section's unknowns and a free wheel.
  double left_at_a_node(double of_nodes);
  /// Returns the norm of all residual forces.
  double left_together() const;
  /// Computes B' m B a of belt_curve.h.
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
  NodeValues q_, v_, force_;  // at the end of the last step; f of (15)
  NodeValues q1_, v1_, a1_, q_predicted_, v_predicted_, a_;
  NodeValues inner_, inertia_, total_, residual_;  // inertia: M a1
  CyclicBandFactor factor_;
  TangentReuse reuse_;
  RepeatedCorrection repeated_;
  WheelMotion last_motion_;
  bool settled_ = false;
  MotionSlopes slopes_;
  std::vector<StepTaken>* taken_ = nullptr;  // set while a caller records the steps of an advance
  FreeRows free_rows_;
  FreeRows* free_ = nullptr;  // while the wheel is free
  RingCounts counts_;
};

}  // namespace latsch::ring_tire
