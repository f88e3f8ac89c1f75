// SPDX-License-Identifier: Apache-2.0
// Response of a rolling tire's forces to slip angles that change harmonically, without the inertia
// of this change: relaxation.
//
//   auto response = RollingResponse::about(tire.mesh(), tire.materials(), settings, free);
//   auto lateral  = response->by_slip_angle(2.0);     // Hz
//   lateral.Fy, lateral.relaxation
//
// About a steady state with the equilibrium (R.1), motions of the tread's nodes q obey
//   (T - C(omega)) q = C(omega) moved,                                                        (F.4)
// with the tire T condensed to the nodes below which the ground is, centrifugal forces included,
// and the contact (F.3). A slip angle of the size alpha is a motion of the wheel to the side, y = V
// alpha/(i omega). Inertia of the vibration is left out, which holds far below the lowest mode, and
// so is what relaxes in rubber. The wheel keeps its height and its spin. On flat ground, elastic.
#pragma once

#include <complex>
#include <memory>

#include "base/result.h"
#include "models/fe_tire/analysis/solver_settings.h"
#include "models/fe_tire/mesh/materials.h"
#include "models/fe_tire/mesh/mesh.h"
#include "models/fe_tire/rolling/rolling_case.h"

namespace latsch::fe_tire {

/// Forces of the ground on the tire by a slip angle of 1 rad, for e^(+i omega t), in the axes of
/// RollingForces.
struct SlipResponse {
  std::complex<double> Fx, Fy;  // N/rad
  std::complex<double> Mz;      // N m/rad, about the contact center
  /// m, -(V/omega) Im Fy/Re Fy: the relaxation length sigma of Fy = C/(1 + i omega sigma/V) C,
  /// which is what a slip that lags has.
  double relaxation = 0.0;
};

class RollingResponse {
 public:
  /// Evaluates the tire about a state that RollingTire found. A Failure says that an element is
  /// inverted, that the state is on a drum, or that the tire buckles.
  static Result<RollingResponse> about(const Mesh& mesh,
                                       const Materials& materials,
                                       const SolverSettings& settings,
                                       const RollingState& state);
  RollingResponse(RollingResponse&&) noexcept;
  ~RollingResponse();

  /// Returns the response at a frequency above 0, Hz.
  SlipResponse by_slip_angle(double frequency) const;

 private:
  struct Impl;
  explicit RollingResponse(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
