// SPDX-License-Identifier: Apache-2.0
// Response of a rolling tire's forces to slips that change harmonically, without the inertia of
// this change: relaxation.
//
//   auto response = RollingResponse::about(tire, free);
//   auto lateral  = response->by(SlipInput::angle, 2.0);     // Hz
//   lateral.force.y(), relaxation_length(lateral.force.y(), 2.0, speed)
//
// About a steady state with the equilibrium (R.1), motions of the tread's nodes q obey
//   (T - C(omega)) q = C(omega) moved - e x c,                                                (F.4)
// with the tire T condensed to the nodes below which the ground is, centrifugal forces included,
// and the contact (F.3). `moved` is what a slip moves the tread over the ground by:
//   slip angle   the wheel moves to the side with the velocity V_x/cos^2(alpha) dalpha; its heading
//                and its speed along it stay,
//   spin         material passes faster: the ground comes less far toward it by V_g dOmega/Omega;
//                centrifugal forces are those of the new spin,
//   turn slip    the ground turns below the wheel center with V dphi,
//   camber       the wheel leans about the line through the contact center along its heading, with
//                which the forces c that act on the tread would turn; e x c takes this back.
// The wheel keeps its spin, except as an input, and either its height or its load. At 0 Hz these
// are the slopes of steady forces of an elastic tire. Inertia of the vibration is left out, which
// holds far below the lowest mode, and so are losses of rubber, and how friction at a sliding speed
// changes with the time that material takes between two points. On flat ground.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/rolling/linear_patch.h"
#include "models/fe_tire/rolling/rolling_case.h"

namespace latsch::fe_tire {

/// The axle: held at its height, or following the load, which then does not change.
enum class Axle { held, follows };

/// Returns -(V/omega) Im F/Re F, m: the relaxation length sigma of F = C/(1 + i omega sigma/V),
/// which is a slip that lags. `frequency` in Hz, above 0; `speed` in m/s.
double relaxation_length(const std::complex<double>& force, double frequency, double speed);

class RollingResponse {
 public:
  /// Evaluates the tire about a state that RollingTire found with it; the tire has to stay where
  /// it is. A Failure says that an element is inverted, that the state is on a drum or without
  /// friction, or that the tire buckles.
  static Result<RollingResponse> about(const FeTire& tire, const RollingState& state);
  /// Evaluates a tire whose rubber and cords relax in the state (RollingTire::set_history()): the
  /// change is that of a tire stiffened by the storage modulus of two waves around
  /// (rolling_history.h), without losses.
  static Result<RollingResponse> about(const FeTire& tire,
                                       const RollingState& state,
                                       const LossMaterials& losses,
                                       const Inflated& round);
  /// Returns the patch of either tire about a state, which may be off the ground and without
  /// friction. A Failure says that an element is inverted, that the state is on a drum, or that the
  /// tire buckles.
  static Result<std::unique_ptr<LinearPatch>> patch_about(const FeTire& tire,
                                                          const RollingState& state,
                                                          const LossMaterials& losses,
                                                          const Inflated& round);
  RollingResponse(RollingResponse&&) noexcept;
  ~RollingResponse();

  /// Returns the responses to several slips at a frequency, Hz, 0 or more.
  std::vector<SlipResponse> at(double frequency,
                               const std::vector<SlipInput>& inputs,
                               Axle axle = Axle::held) const;
  SlipResponse by(SlipInput input, double frequency, Axle axle = Axle::held) const {
    return at(frequency, {input}, axle).front();
  }

  /// Number of the patch's unknowns.
  int size() const;

 private:
  explicit RollingResponse(std::unique_ptr<const LinearPatch> patch);
  std::unique_ptr<const LinearPatch> patch_;
};

}  // namespace latsch::fe_tire
