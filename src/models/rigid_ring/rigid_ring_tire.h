// SPDX-License-Identifier: Apache-2.0
// The tire as a rigid ring on springs: belt with six degrees of freedom, enveloping cams, residual
// springs, contact patch slip, Magic Formula. Good to some 60-100 Hz and over short obstacles.
//
//   m_b (d.. + a) = F_c + m_b g - k_b d - c_b v_rel           d: belt center, in C, from the rim's
//   I phi.. + gyroscopic  = M_c - k_phi phi - c_phi w_rel     phi = (gamma, theta, psi)
//   du/dt + |Vx|/sigma_c u = -Vsx                             u, v: deflections of the residual
//   dv/dt + |Vx|/sigma_c v = Vsy                              springs, sigma_c = K/c_r
//   kappa' = u/sigma_c,  alpha' = atan(v/sigma_c)
//   Vsx = Vx - Omega R_e(Fz) - (R_l - R_e) (w_c - w_y)        w_c, w_y: rates of pitch, of the
//                                                             effective plane and of the rim
//   Fz(rho_r):  Fz = F_static(rho_r + Fz/k_bz) + DAMP_RESIDUAL c_rz d rho_r/dt
//
// so that at rest and in steady rolling the ring in series with the residual springs is the overall
// stiffness and the Magic Formula of the file. Springs and dampers turn with the rim: v_rel = d. -
// Omega y x d, of which the dampers' part is kept. Slips, camber and height are those of the belt
// over the effective plane of tandem_cams.h. Integrated by the classical Runge-Kutta method in
// substeps short for the ring's springs and for the way the patch rolls over the road; rim and
// plane go straight on in a step, which makes it of order 2. [Zegelaar 1998; Maurice 2000; Schmeitz
// 2004; Pacejka 2012, ch. 9 and 10]
//
// The three ways in which a road changes the effective rolling radius [Zegelaar 1998; Schmeitz
// 2004]: the load of the moment in R_e (7); the slope, along which Vx is taken; the curvature. In
// axes that turn with the plane the belt turns with Omega + w_y - w_c over ground that comes with
// Vx - R_l (w_c - w_y): so Vsx. A disc, R_l = R_e, feels no curvature.
//
// Below VXLOW, at rest and on the spot as in standstill.h, the yaw stiffness there being the
// residual one.
//
// Limits: the twist of the patch is felt below VXLOW alone; the moment of Fx about the axle has the
// arm R_l (what makes it R_e is in QSY2 of the file, if anywhere); small rotations of the belt;
// Q_BVX and Q_BVT (stiffness over speed) are not used.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "models/magic_formula/magic_formula_tire.h"
#include "models/magic_formula/standstill.h"
#include "models/rigid_ring/ring_constants.h"
#include "models/rigid_ring/tandem_cams.h"

namespace latsch::rigid_ring {

class RigidRingTire final : public Tire {
 public:
  /// A Failure where the parameters do not make a ring (ring_constants.h).
  static Result<std::unique_ptr<RigidRingTire>> make(
      const magic_formula::Parameters& parameters,
      const magic_formula::MagicFormulaTireSettings& settings = {});

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

  const RingConstants& constants() const { return ring_; }
  /// Of the last step.
  const magic_formula::SteadyState& contact_forces() const { return forces_; }
  Eigen::Vector3d belt_displacement() const { return state_.segment<3>(0); }  // m, C
  const magic_formula::RoadPlane& effective_plane() const { return plane_; }

 private:
  /// d, phi, their rates, u, v, the way the patch was rolled in, its twist.
  using State = Eigen::Matrix<double, 16, 1>;
  /// Rim and effective plane at a time of the step.
  struct Rim {
    WheelMotion motion;
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // m/s^2, inertial
    double spin_acceleration = 0.0;
    magic_formula::RoadPlane plane;
    Eigen::Vector3d normal_rate = Eigen::Vector3d::Zero();  // 1/s, of the plane's
  };
  struct Contact {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   // on the belt, C
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // about the belt's center, C
    Eigen::Vector4d rate = Eigen::Vector4d::Zero();    // of the state from u on
    Eigen::Vector2d most{INFINITY, INFINITY};          // m: |u|, |v| of a patch that stands
  };

  RigidRingTire(const magic_formula::Parameters& parameters,
                const magic_formula::MagicFormulaTireSettings& settings,
                const RingConstants& ring);

  WheelMotion belt_motion(const State& y, const WheelMotion& rim) const;
  double load(double rho, double approach, double spin_rate, double gamma) const;
  Contact contact(const State& y, const Rim& rim, bool rolling);
  void slip(const magic_formula::WheelContact& wheel,
            double spin_rate,
            double turning,
            Contact& c,
            const State& y);
  State rate(const State& y, const Rim& rim);
  void springs(const State& y,
               double spin_rate,
               Eigen::Vector3d& force,
               Eigen::Vector3d& moment) const;
  HubForces hub_forces(const State& y, double spin_rate) const;
  magic_formula::RoadPlane plane_ahead(const WheelMotion& motion,
                                       double ahead,
                                       const road::Road& road,
                                       double time) const;
  void take_friction(double friction);
  Rim between(const WheelMotion& motion,
              const magic_formula::RoadPlane& plane,
              double step,
              double share) const;
  int substeps(double step, double Vx) const;

  magic_formula::Parameters parameters_;
  magic_formula::MagicFormulaTireSettings settings_;
  magic_formula::MagicFormula formula_;
  RingConstants ring_;
  TandemCams cams_;
  State state_ = State::Zero();
  WheelMotion before_;
  bool moving_ = false;             // before_ is known
  magic_formula::RoadPlane plane_;  // at the end of the last step
  double load_rate_ = 0.0;          // N/s, over the last step
  Eigen::Vector2d most_;            // m: of |u|, |v|, as the last rate had it
  magic_formula::SteadyState forces_{};
};

}  // namespace latsch::rigid_ring
