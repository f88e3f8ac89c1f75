// SPDX-License-Identifier: Apache-2.0
// Rigid kinematics of the two wheels of an axle with a common rack, in which the chassis is fixed
// and the ground moves. The right wheel is the mirror image of the left one. With contact points L
// and R, and heights h_i(y) = z_i + v_yi / v_zi (y_i - y) of the normals to their paths, both in
// the chassis' axes:
//   roll = -atan2(z_L - z_R, y_L - y_R)      of the chassis to the ground, its left side up     (1)
//   roll center (kinematic): where both normals meet, above the line through L and R            (2)
//   roll center (force):     Σ s_i h_i(0), s_i the wheels' shares of the lateral force: where the
//                            force that the links carry acts                                    (3)
//   roll_steer = t/2 dtoe/dz,  roll_camber = 1 + t/2 dcamber/dz, t = y_L - y_R                  (4)
//
// (2) describes the motion of the chassis while the contact points stay on the ground. (3)
// describes the force on the chassis, and remains finite if both normals become parallel.
// [Mitchell, Roll Center - Myths and Reality]
//
//   ideal cot δ_o - cot δ_i = t / wheelbase,  ackermann = (δ_i - δ_o) / (δ_ideal(δ_o) - δ_o)    (5)
//
//   anti = share (dx/dz) wheelbase / cg_height, by the path of the contact point if the upright
//   reacts the torque (brakes outboard), of the wheel center if the chassis does; positive if the
//   links carry a part of the load transfer: dx/dz > 0 of a front, < 0 of a rear axle           (6)
//
// [(5), (6) Gillespie, Fundamentals of Vehicle Dynamics, 1992, ch. 7 and 8]
#pragma once

#include "models/suspension/kinematic_outputs.h"

namespace latsch::suspension {

struct AxleKinematics {
  WheelKinematics left, right;
  double roll, track;
  double roll_center_height, roll_center_y, force_roll_center_height;
};

/// `outer_share`: share of the axle's lateral force that acts on the wheel that is higher in the
/// chassis.
AxleKinematics axle_of(const WheelKinematics& left,
                       const WheelKinematics& right,
                       double outer_share);

/// Return the derivatives of a wheel's toe and camber with respect to the roll angle of the
/// chassis, while both contact points stay on the ground.
double roll_steer(const WheelKinematics& wheel, double track);
double roll_camber(const WheelKinematics& wheel, double track);

struct VehicleData {
  double wheelbase, cg_height;  // m
  bool is_front = true;
  // Share of the axle in the braking or driving force, 0 to 1.
  double brake_share = 0.0, drive_share = 0.0;
  bool has_outboard_brakes = true;
};

/// Shares of the longitudinal load transfer that the links carry; 1: all of it.
struct AntiFeatures {
  double braking;  // anti-dive of a front axle, anti-lift of a rear one
  // Anti-lift of a front axle, anti-squat of a rear one; the drive torque is reacted by the
  // chassis.
  double driving;
};
AntiFeatures anti_features(const WheelKinematics& wheel, const VehicleData& vehicle);

/// Returns how closely the steer angles `left` and `right` (rad, positive to the left) fulfill the
/// Ackermann condition. 1: both wheels roll about one point on the line of the rear axle; 0: both
/// have the same angle.
double ackermann(double left, double right, double track, double wheelbase);

/// The kinematics of both wheels of an axle, from the geometry of one corner. The geometry must
/// have no fault() and must outlive this object.
class KinematicAxle {
 public:
  KinematicAxle(const CornerGeometry& geometry, TravelOf of)
      : side_(geometry.linkage.wheel.side), own_(geometry, of), image_(geometry, of) {}

  struct Wheels {
    WheelKinematics left, right;
  };
  Result<Wheels> move_to(double left, double right, double rack);

 private:
  Side side_;
  KinematicCorner own_, image_;
};

}  // namespace latsch::suspension
