// SPDX-License-Identifier: Apache-2.0
// Friction of a surface that rolls over rigid ground, in the frame that travels with the wheel.
//
// Points of the surface lie on lines around. Along each, in the order of flow from the leading
// edge, the traction starts with t = 0 where the line comes down, and
//   t'_k = t_{k-1} - epsilon_t [(x_k - x_{k-1}) - V_g Delta t_k],
//   t_k = t'_k if |t'_k| <= mu p_k, else mu p_k t'_k/|t'_k|                                   (F.1)
// t is the traction on the surface, x the position along the ground, V_g the ground's velocity in
// this frame. This is the steady limit of penalty contact in time, (C.2) and (C.3) of contact.h,
// for any step. A point that comes down between two places is anchored where it touched: its step
// counts by the share that lies in contact, as (C.4). Nothing depends on a threshold of velocity,
// and a steady state does not depend on the path to it. A point slides over the ground with
//   w = [(x_k - x_{k-1}) - V_g Delta t_k + (t_k - t_{k-1})/epsilon_t]/Delta t_k.
// If mu depends on the speed, |w| of this very step enters it: with w along t, the traction of a
// sliding point solves
//   |t_k| = mu(p_k, w) p_k,   |t_k| + epsilon_t Delta t_k w = |t'_k|                          (F.2)
// and sticking ends at mu of w = 0. No speed of an earlier iteration is needed.
//
// The penalty epsilon_t acts in series with the surface's own shear. It has to be some hundred
// times the surface's shear stiffness per length; there is no other limit, as rolling_contact.h
// solves (F.1) by an active set. [Kalker, Wear 113 (1986) 61-77; Carter 1926]
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "models/fe_tire/description/rolling_friction.h"

namespace latsch::fe_tire {

enum class Grip : std::uint8_t { none, sticks, slides };

/// The points, line after line, each in the order of flow.
struct RollingLines {
  /// Points of each line, [first, last).
  struct Line {
    int first, last;
  };
  std::vector<Line> lines;
  Eigen::VectorXd time;  // s, Delta t from the point before; unused at the first point of a line
  int points() const { return static_cast<int>(time.size()); }
};

/// The state of point k - 1 of a line when the material of point k passed there, if that is not its
/// present one (tread_past.h): its present state by the weight `now`, and an earlier part.
struct Upstream {
  Eigen::VectorXd now;        // empty: the state is steady, and all weights are 1
  Eigen::Matrix3Xd x;         // m, earlier part of the place along the ground and over it
  Eigen::Matrix2Xd t;         // Pa, earlier part of the traction
  std::vector<char> touched;  // true: the point before was in contact
  bool is_past() const { return now.size() > 0; }
};

/// Positions and pressures of the points.
struct RollingInput {
  Eigen::Matrix2Xd x;  // m, along the ground
  Eigen::VectorXd p;   // Pa; 0: not in contact
  /// Part of the step to a point that lies in contact, 0 to 1; used where a line comes down.
  Eigen::VectorXd share;
  Eigen::Matrix2Xd V_g;  // m/s
  Upstream upstream = {};

  /// True if the traction of the point before comes along to point k.
  bool carries(int k) const {
    return upstream.is_past() ? upstream.touched[k] != 0 : p[k - 1] > 0.0;
  }
};

/// State of the points between iterations.
struct GripState {
  std::vector<Grip> grip;
  Eigen::Matrix2Xd direction;  // unit vectors of the tractions of sliding points
  explicit GripState(int points)
      : grip(points, Grip::sticks), direction(Eigen::Matrix2Xd::Zero(2, points)) {}
};

/// Derivative of a point's traction, given that of the point before it on its line:
///   dt_k = by_before dt_{k-1} + by_step (dx_k - now dx_{k-1}) + by_share dshare_k + by_p dp_k.
struct GripLink {
  double now = 1.0;  // weight of the present state of the point before (Upstream)
  Eigen::Matrix2d by_before = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d by_step = Eigen::Matrix2d::Zero();   // Pa/m
  Eigen::Vector2d by_share = Eigen::Vector2d::Zero();  // Pa
  Eigen::Vector2d by_p = Eigen::Vector2d::Zero();
};

/// Tractions by (F.1) for given states of the points.
struct GripTractions {
  Eigen::Matrix2Xd t;           // Pa
  Eigen::Matrix2Xd trial;       // t' of (F.1), Pa
  Eigen::VectorXd limit;        // mu p, Pa, at the speed of a sliding point
  Eigen::Matrix2Xd w;           // m/s; 0 of points that stick
  std::vector<GripLink> links;  // one for each point; empty if not asked for
};

class RollingGrip {
 public:
  /// `stiffness`: epsilon_t, Pa/m.
  RollingGrip(RollingLines lines, RollingFriction friction, double stiffness);

  const RollingLines& lines() const { return lines_; }
  double stiffness() const { return stiffness_; }
  const RollingFriction& friction() const { return friction_; }

  /// Directions of sliding points: kept, or those of t'.
  enum class Directions { kept, of_trial };
  /// Returns the tractions if points are in these states. Points without pressure have none, and
  /// states do not matter for them.
  GripTractions tractions(const RollingInput& input,
                          const GripState& state,
                          Directions directions,
                          bool with_derivatives) const;
  /// Lets points without a state, which have come down, stick or slide as (F.1) says, given the
  /// states of the points before them; points without pressure lose theirs.
  void admit(const RollingInput& input, GripState& state) const;
  /// Returns the tractions of (F.1), point by point from the leading edge: solves for a surface
  /// whose positions are known. `state` receives the states.
  GripTractions explicit_tractions(const RollingInput& input, GripState& state) const;

 private:
  struct Step;
  struct Slide;
  /// Solves (F.2) at the pressure p, Pa, where `along`, Pa, is the trial traction in the direction
  /// of sliding and `time`, s, that of the step.
  Slide slide(double p, double along, double time) const;
  Step step_to(const RollingInput& input, const RollingLines::Line& line, int k) const;
  void find_slip(const RollingInput& input, const GripState& state, GripTractions& found) const;

  RollingLines lines_;
  RollingFriction friction_;
  double stiffness_;
};

}  // namespace latsch::fe_tire
