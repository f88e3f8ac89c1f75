// SPDX-License-Identifier: Apache-2.0
// The Magic Formula as a rolling tire: one contact point, a vertical spring and damper, and slip
// that lags by relaxation lengths. It is the baseline for handling, valid up to about 8 Hz on roads
// without short obstacles.
//
//   Fz = F(rho; omega, Fx, Fy, gamma, p) + d rho/dt VERTICAL_DAMPING, never a pull. F is that of
//        the formula (3), or the DEFLECTION_LOAD_CURVE of a file; below BOTTOM_OFFST the rim adds
//        its BOTTOM_STIFF
//   Fx, Fy, Mx, My, Mz = Magic Formula(Fz, kappa', alpha', gamma, phit, Vx, p)
//
// The digits of USE_MODE (of the file or of the settings) select the model. Tens digit 0: steady
// state, in which kappa' and alpha' are the slips of the wheel. Tens digit 1: relaxation with sigma
// = K/C at the load (19). Tens digit 2 and above: sigma also depends on the slip, sigma = |F -
// F(0)|/(C slip), because the sliding part of the patch needs no deflection [Pacejka 2012, 7.2.3];
// F(0) is the force that ply steer, conicity, camber and the other slip cause without this slip. A
// step is of order 2 in its length, and exact for constant velocities and load. Speeds below VXLOW,
// rest and turning on the spot are handled by standstill.h, in every mode with relaxation. Units
// digit 0: vertical force alone; 1: with Fx and My; 2: with Fy, Mx, Mz; 3: all, without interaction
// of the slips; 4: all, with interaction; 5: as 4, with turn slip.
#pragma once

#include "models/magic_formula/limits/range_log.h"
#include "models/magic_formula/magic_formula.h"
#include "models/magic_formula/standstill.h"
#include "models/magic_formula/wheel_contact.h"
#include "models/tire/tire.h"

namespace latsch::magic_formula {

/// Settings of the tire in addition to its coefficients.
struct MagicFormulaTireSettings {
  Conventions conventions = {};  // axes and signs of inputs and outputs
  int use_mode = 14;             // USE_MODE of the .tir file: which forces are computed
  double pressure = 0.0;         // Pa, inflation pressure; 0: INFLPRES of the file
  /// Records the inputs of the tire's steps; null: they are not recorded.
  std::shared_ptr<RangeLog> log = {};
};

/// Returns the contact patch of the formula at zero slip, a rectangle of 2 a x 2 b; nullopt if the
/// file has no coefficients for the patch.
std::optional<Footprint> footprint_of(const MagicFormula& formula,
                                      double Fz,
                                      double speed,
                                      double pressure);

class MagicFormulaTire final : public Tire {
 public:
  /// Makes a tire from the coefficients of a .tir file.
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
  std::optional<double> road_load() const override { return forces_.Fz; }
  std::unique_ptr<Tire> clone() const override;

  /// Results of the last step: load, relaxed slips, and forces in the axes W of the contact.
  const SteadyState& contact_forces() const { return forces_; }
  /// Longitudinal slip of the contact patch at the end of the last step, after relaxation.
  double lagged_kappa() const { return patch_.kappa; }
  /// Slip angle of the contact patch at the end of the last step, after relaxation, rad.
  double lagged_alpha() const { return patch_.alpha; }

 private:
  /// State of the contact patch: relaxed slips, the direction r in which it was rolled in
  /// (standstill.h), and its twist psi, rad.
  struct Patch {
    double kappa = 0.0, alpha = 0.0, r = 0.0, psi = 0.0;
  };
  /// Parameters of the carcass that connects the contact patch to the rim.
  struct Carcass {
    double sigma_x, sigma_y;  // m: relaxation lengths
    // Peak forces, N; slip stiffnesses, N per unit of slip.
    double peak_x, peak_y, slope_x, slope_y;
    Pivot pivot;
  };
  /// Velocity of the contact patch relative to the ground, m/s and rad/s, and its load, N.
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
  double friction_ = 1.0;  // friction factor of the road with which formula_ was made
  Patch patch_;
  std::optional<Sliding> before_;  // sliding at the end of the last step; empty in the air
  SteadyState forces_{};
  RangeWatch watch_;
};

/// Returns a Failure if the axle is so low that the rim would penetrate the road.
Status check_rim(const Parameters& parameters, const WheelContact& contact);

/// Returns the coefficients of the tire on a road whose friction differs from that of the
/// measurement by a factor.
Parameters on_road(Parameters parameters, double friction);

}  // namespace latsch::magic_formula
