// SPDX-License-Identifier: Apache-2.0
// The Magic Formula as a rolling tire: one contact point, a vertical spring and damper, slip that
// lags by relaxation lengths. The baseline of handling; good to some 8 Hz on roads without short
// obstacles.
//
//   Fz = F(rho; omega, Fx, Fy, gamma, p) + d rho/dt VERTICAL_DAMPING, never a pull; F the formula's
//        own (3), of a file with DEFLECTION_LOAD_CURVE that curve; below BOTTOM_OFFST the rim's
//        BOTTOM_STIFF comes in addition
//   Fx, Fy, Mx, My, Mz = Magic Formula(Fz, kappa', alpha', gamma, phit, Vx, p)
//
// USE_MODE of the file (or of the settings), tens: 0 steady state, kappa' and alpha' those of the
// wheel; 1 relaxation with sigma = K/C at the load (19); 2 and above also with the slip,
// sigma = |F - F(0)|/(C slip), as the sliding part of the patch needs no deflection
// [Pacejka 2012, 7.2.3]; F(0) is the force that ply steer, conicity, camber and the other slip
// leave without this slip. A step is of order 2 in its length, and exact where velocities and load
// stand. Below VXLOW, at rest and on the spot: standstill.h, of every mode with relaxation.
// Units: 0 vertical force alone, 1 Fx and My, 2 Fy, Mx, Mz, 3 all without interaction of the slips,
// 4 and 5 all (5: with turn slip).
#pragma once

#include "models/magic_formula/magic_formula.h"
#include "models/magic_formula/standstill.h"
#include "models/magic_formula/wheel_contact.h"
#include "models/tire/tire.h"

namespace latsch::magic_formula {

struct MagicFormulaTireSettings {
  Conventions conventions = {};
  int use_mode = 14;
  double pressure = 0.0;  // Pa; 0: INFLPRES
};

/// The rectangle 2 a x 2 b of the formula without slip; nullopt where it has no coefficients of it.
std::optional<Footprint> footprint_of(const MagicFormula& formula,
                                      double Fz,
                                      double speed,
                                      double pressure);

class MagicFormulaTire final : public Tire {
 public:
  explicit MagicFormulaTire(const Parameters& parameters,
                            const MagicFormulaTireSettings& settings = {});

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
  std::optional<Footprint> footprint() const override;
  std::unique_ptr<Tire> clone() const override;

  /// Of the last step: load, lagged slips, forces in W.
  const SteadyState& contact_forces() const { return forces_; }
  double lagged_kappa() const { return patch_.kappa; }
  double lagged_alpha() const { return patch_.alpha; }

 private:
  /// What the tire remembers: lagged slips, the way it was rolled in, rad of twist.
  struct Patch {
    double kappa = 0.0, alpha = 0.0, r = 0.0, psi = 0.0;
  };
  /// How the patch hangs on the carcass.
  struct Carcass {
    double sigma_x, sigma_y;                  // m: relaxation lengths
    double peak_x, peak_y, slope_x, slope_y;  // N, over the slip
    Pivot pivot;
  };
  /// The patch over the ground, m/s and rad/s, and its load, N.
  struct Sliding {
    double Vx = 0.0, Vsx = 0.0, Vsy = 0.0, yaw_rate = 0.0, Fz = 0.0;
  };

  double vertical_force(const WheelContact& contact, double spin_rate) const;
  SteadyState evaluate(const WheelContact& contact, double Fz, const Patch& patch) const;
  Carcass carcass(const WheelContact& contact, double Fz, const Patch& patch) const;
  Patch relaxed_patch(const Sliding& at, const Carcass& carcass, double step) const;
  Patch lag(const WheelContact& contact, const Sliding& now, double step) const;
  SteadyState answer(const WheelContact& contact, const Sliding& now, Patch patch) const;
  void roll(const WheelContact& contact, double spin_rate, double step);
  HubForces hub_forces(const WheelMotion& motion, const WheelContact& contact) const;
  void take_friction(double friction);

  Parameters parameters_;
  MagicFormulaTireSettings settings_;
  MagicFormula formula_;
  double friction_ = 1.0;  // of the road, in formula_
  Patch patch_;
  std::optional<Sliding> before_;  // at the end of the last step; nothing in the air
  SteadyState forces_{};
};

/// The coefficients on a road whose friction is a factor off.
Parameters on_road(Parameters parameters, double friction);

}  // namespace latsch::magic_formula
