// SPDX-License-Identifier: Apache-2.0
// Vibration of a rolling tire about a steady state: the response (R.1) of patch and hub to slips
// and to motions of the wheel and the ground that change harmonically, with inertia.
//
//   auto vibration = RollingVibration::about(tire, state, {.highest = 100.0});
//   auto side      = vibration->at(20.0, {{.of = VibrationInput::Of::angle}}).front();
//   side.patch.force.y(), side.hub_force.y()
//
// A tire moves by u = T q_w + v with the wheel's motion q_w, which every node follows as a rigid
// body, and the motion v relative to the rim. With the inertia (W.1) of spin.h in axes that do not
// spin, K_Omega = K - Omega^2 W, and the contact C(omega) of harmonic_contact.h on the rows B v of
// the patch,
//   [K_Omega + i omega Omega G - omega^2 M] v = B'(C B v + C moved - e x c)
//                                              - (i omega Omega G - omega^2 M) T q_w          (R.4)
// since K_Omega T = e x c: a wheel that turns takes its forces along. A spin that changes adds the
// inertia i omega dOmega G' x - 2 Omega dOmega (w_0 + W u), (V.3).
//
// The compliance of the tire on springs C_s, with which the points in contact stick, is
//   (A - omega^2 M + i omega Omega G)^-1 = A^-1 + Phi (Z_r^-1 - K_r^-1) Phi',
//   A = K_Omega + B' C_s B
// with the shapes Phi: modes of (A, M) up to a multiple of the highest frequency, and the static
// displacements, and those under their inertia, by all loads that occur and by tractions that vary
// smoothly in the patch. So the response is exact at 0 Hz, however the real contact differs from
// the springs, and dynamic forces need only what the shapes span. The mass is the consistent one,
// as that of G.
//
// Points that stick go on to stick, and sliding ones to slide. Rubber and cords are elastic, with
// the moduli of RollingResponse. On flat ground, or off it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/rolling/linear_patch.h"
#include "models/fe_tire/rolling/rolling_case.h"

namespace latsch::fe_tire {

/// An input, of which a unit drives the tire.
struct VibrationInput {
  enum class Of {
    angle,   // slip angle, rad: the wheel moves to the side
    spin,    // relative change of the spin
    camber,  // rad, about the line through the contact center along the heading
    wheel,   // motion of the wheel along `axis`, m
    ground,  // motion of the ground along the vertical, m
    point,   // force on a point, N
  };
  Of of = Of::angle;
  int axis = 2;   // 0 to 2: x, y, z of the ground's axes
  int point = 0;  // index into VibrationSettings::points
};

/// A node of the tire, counted section plane by section plane, and a direction in the wheel frame.
struct VibrationPoint {
  int node;
  Eigen::Vector3d axis;
};

struct VibrationSettings {
  double highest = 100.0;  // Hz, the highest frequency that will be asked for
  double beyond = 2.5;     // modes are taken up to this multiple of it
  std::vector<VibrationPoint> points = {};
};

/// Changes by a unit of the input, for e^(+i omega t), in axes that stay with the ground.
struct VibrationResponse {
  SlipResponse patch;           // the ground on the tire; 0 off the ground
  Eigen::Vector3cd hub_force;   // N, the tire on the rim
  Eigen::Vector3cd hub_moment;  // N m, about the wheel center
  Eigen::VectorXcd points;      // m, displacements of the points in space
};

class RollingVibration {
 public:
  /// Computes the shapes and their equations about a state that RollingTire found with the tire,
  /// which has to stay where it is. With losses the tire is that of RollingResponse. A Failure says
  /// that an element is inverted, that the state is on a drum, that the tire buckles, or why there
  /// are no modes.
  static Result<RollingVibration> about(const FeTire& tire,
                                        const RollingState& state,
                                        const VibrationSettings& settings,
                                        const LossMaterials& losses = {},
                                        const Inflated& round = {});
  RollingVibration(RollingVibration&&) noexcept;
  ~RollingVibration();

  /// Returns the responses to several inputs at a frequency, Hz, 0 or more. The axle and the spin
  /// are held, except as inputs.
  std::vector<VibrationResponse> at(double frequency,
                                    const std::vector<VibrationInput>& inputs) const;
  int shapes() const;

 private:
  struct Impl;
  explicit RollingVibration(std::unique_ptr<const Impl> impl);
  std::unique_ptr<const Impl> impl_;
};

}  // namespace latsch::fe_tire
