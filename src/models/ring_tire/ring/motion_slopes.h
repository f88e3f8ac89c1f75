// SPDX-License-Identifier: Apache-2.0
// Derivatives of a step's forces on the hub with respect to the wheel's motion m at the end of the
// step. Newton's method has solved r(q1; m) = 0 of (17), so
//   J dq1/dm = dr/dm,  J = -dr/dq1;  dF/dm = dF/dm at q1 + dF/dq1 dq1/dm                     (29)
// with v1 and a1 of (16). The derivatives by the rim's motion are analytical: moving the rim is
// equivalent to moving the belt in the opposite direction and rotating the forces. The frames of
// the tread blocks and the planes of the road depend on the spin axis; their derivatives are finite
// differences of the blocks' forces. A step that was divided into parts is differentiated part by
// part: the motion at the end determines the motions between, and each part begins with the
// derivatives of the state before it.
//
// The derivatives are valid if no block is about to touch, to leave, to slip or to stick, and no
// friction element of the sidewall is about to slip. At such a point they are one-sided, on the
// side of the end of the step.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "models/ring_tire/belt/belt_damping.h"
#include "models/ring_tire/belt/sidewall.h"
#include "models/ring_tire/ring/exact_tangent.h"
#include "models/ring_tire/ring/ring_state.h"
#include "models/ring_tire/step/wheel_motions.h"

namespace latsch::ring_tire {

class RingTire;

/// One step of the ring's time integration, and the state at its end.
struct StepTaken {
  double time, step;  // s
  RingState end;
};

/// Computes derivatives of steps. Its memory is reused from one step to the next.
class MotionSlopes {
 public:
  /// Returns the derivatives of a step from the state `from` to the motion `to`, of length `step`
  /// (s), ending at `time` (s). `taken` holds the parts into which the step was divided. The state
  /// of `tire` is overwritten, so restore() must be called afterwards. Returns nothing if a tangent
  /// is not positive definite, or if the set of blocks that may touch the road changes.
  std::optional<HubSlopes> over(RingTire& tire,
                                const RingState& from,
                                const WheelMotion& to,
                                const road::Road& road,
                                double time,
                                double step,
                                const std::vector<StepTaken>& parts);

 private:
  static constexpr int kPadded = (kMotionColumns + 7) / 8 * 8;
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, kPadded, Eigen::RowMajor>;
  using Vectors = Eigen::Matrix<double, 3, kPadded>;

  WheelMotion part_motion(int column, double by) const;
  bool begin_part(const StepTaken& part);
  bool place(const WheelMotion& motion);
  Eigen::VectorXd tread_forces();
  std::optional<Eigen::VectorXd> tread_slope(const RingState* slope,
                                             const WheelMotion& further,
                                             const WheelMotion& back,
                                             double by);
  void find_tangent();
  void find_rigid_fields();
  void find_rim_motion();
  bool find_tread_slopes();
  void find_held_forces();
  void add_state(int column);
  void find_right_sides();
  void solve();
  void turn_by(const Eigen::Vector3d& omega, const Columns& x, Columns& to) const;
  void damp(const Columns& rate, Columns& force);
  HubSlopes hub_slopes();
  bool follow_state(const StepTaken& part);

  RingTire* tire_ = nullptr;
  const RingState* from_ = nullptr;
  const WheelMotion* to_ = nullptr;
  const road::Road* road_ = nullptr;
  double time_ = 0.0, step_ = 0.0;
  // Derivatives of the state at the beginning, by column; empty: none.
  std::vector<RingState> slopes_;

  // Data of the part of the step that is being differentiated.
  const RingState* begin_ = nullptr;
  double part_time_ = 0.0, part_step_ = 0.0, share_ = 1.0;
  WheelMotion motion_;
  RimFrame rim_;
  StepRule rule_;
  NodeValues q1_, v1_, inner_;
  Eigen::Vector3d moment_on_rim_;
  Eigen::VectorXd gamma_;
  std::vector<Eigen::Matrix4d> dampers_;  // dampers at the belt's knots, in inertial axes
  // Matrices of the belt's own damping, set if it has any: C of (30) and D of (31).
  std::optional<CyclicBand> belt_damping_;
  std::optional<WholeBand> belt_turning_;
  // Unit translations and rotations of all nodes about the center, and the products of the belt's
  // stiffness and of its transpose with them.
  Columns fields_, stiff_, stiff_transposed_;
  // Derivatives of the rim's motion, one column per component of the wheel's motion m: center,
  // rotation with spin, velocity, angular velocity; and rotation of the carrier.
  Vectors center_, turn_, velocity_, rate_, carrier_;
  // Derivatives with the nodes kept in place, by column: forces of belt and sidewall; forces of the
  // tread blocks on nodes and sections with their moment on the rim; velocities and accelerations
  // caused by the state at the beginning.
  Columns held_, tread_, velocities_, accelerations_;
  std::vector<PatchSlopes> blocks_;
  ExactTangent tangent_;
  Columns x_;  // right-hand sides dr/dm, then the solution d(q1, γ)/dm
  Columns rates_, turned_, knots_, more_, next_;  // temporary matrices
};

}  // namespace latsch::ring_tire
