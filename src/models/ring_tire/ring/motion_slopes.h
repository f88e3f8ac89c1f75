// SPDX-License-Identifier: Apache-2.0
// Derivatives of a step's forces on the hub with respect to the wheel's motion m at its end.
// Newton's method has solved r(q1; m) = 0 of (17), so
//   J dq1/dm = dr/dm,  J = -dr/dq1;  dF/dm = dF/dm at q1 + dF/dq1 dq1/dm                     (29)
// with v1 and a1 of (16). The rim's part of dr/dm is analytical: moving the rim is equivalent to
// moving the belt in the opposite direction and rotating forces. Frames of the blocks and planes of
// the road follow the spin axis, so this part uses differences of the blocks' forces. A step
// divided into parts is differentiated part by part: the motion at the end determines those
// between, and each part begins with the derivatives of the state before it.
//   Valid: if no block is about to touch, to leave, to slip or to stick, and no friction element
//   of the sidewall is about to slip. At such a point the derivatives are one-sided, on the side
//   of the end of the step.
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

/// One step of a ring's advance and the state at its end.
struct StepTaken {
  double time, step;  // s
  RingState end;
};

/// Computes derivatives of steps and keeps its memory from one step to the next.
class MotionSlopes {
 public:
  /// Returns the derivatives of a step from `from` to `to` of length `step` that ends at `time`,
  /// from the steps taken to its end. It overwrites the tire's memory, so restore() has to follow.
  /// Returns nothing if a tangent is not definite, or if the blocks that may touch the road change.
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
  std::vector<RingState> slopes_;  // derivatives of the first state by column; empty: none

  // Data of the current part.
  const RingState* begin_ = nullptr;
  double part_time_ = 0.0, part_step_ = 0.0, share_ = 1.0;
  WheelMotion motion_;
  RimFrame rim_;
  StepRule rule_;
  NodeValues q1_, v1_, inner_;
  Eigen::Vector3d moment_on_rim_;
  Eigen::VectorXd gamma_;
  std::vector<Eigen::Matrix4d> dampers_;  // dampers of the knots, in inertial axes
  // The belt's own damping if it has any: C of (30), D of (31).
  std::optional<CyclicBand> belt_damping_;
  std::optional<WholeBand> belt_turning_;
  // Unit translations and rotations about the center, and the belt's stiffness and its transpose
  // times these.
  Columns fields_, stiff_, stiff_transposed_;
  // Columns of the rim's motion: its center, rotation with spin, velocity, angular velocity; and
  // the rotation of the carrier.
  Vectors center_, turn_, velocity_, rate_, carrier_;
  // Columns with the nodes held: forces of belt and sidewall; forces of the blocks on nodes and
  // sections, and their moment on the rim; velocities and accelerations from the state at the
  // beginning.
  Columns held_, tread_, velocities_, accelerations_;
  std::vector<PatchSlopes> blocks_;
  ExactTangent tangent_;
  Columns x_;                                     // dr/dm, then d(q1, γ)/dm
  Columns rates_, turned_, knots_, more_, next_;  // work memory
};

}  // namespace latsch::ring_tire
