// SPDX-License-Identifier: Apache-2.0
// The tire as a rigid ring on springs: a belt with six degrees of freedom, enveloping cams,
// residual springs, contact patch slip, Magic Formula. Valid up to some 60-100 Hz and over short
// obstacles.
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
// At rest and in steady rolling the ring in series with the residual springs thus has the overall
// stiffness and the Magic Formula of the file. Springs and dampers turn with the rim: v_rel = d. -
// Omega y x d, whose effect in the dampers is included. Slips, camber and height are those of the
// belt over the effective plane of tandem_cams.h. Integration is by the classical Runge-Kutta
// method in substeps that are short for the ring's springs and for the distance that the patch
// rolls over the road. Rim and plane move linearly in a step, so the order is 2. [Zegelaar 1998;
// Maurice 2000; Schmeitz 2004; Pacejka 2012, ch. 9 and 10]
//
// A road changes the effective rolling radius in three ways [Zegelaar 1998; Schmeitz 2004]: the
// instantaneous load in R_e (7); the slope, along which Vx is taken; the curvature. In axes that
// turn with the plane the belt turns with Omega + w_y - w_c over ground that moves at Vx - R_l (w_c
// - w_y), which gives Vsx. A rigid disk, R_l = R_e, is not affected by curvature.
//
// Below VXLOW, at rest and when turned on the spot it behaves as in standstill.h, with the residual
// stiffness as yaw stiffness.
//
// Limits: the twist of the patch acts only below VXLOW. The moment of Fx about the axle has the arm
// R_l (the difference to R_e is in QSY2 of the file, if anywhere). Rotations of the belt are small.
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
  /// Returns a Failure if the parameters do not define a ring (ring_constants.h).
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
  std::optional<double> road_load() const override { return forces_.Fz; }
  std::unique_ptr<Tire> clone() const override;

  /// Stiffnesses and damping of the belt against the rim, and its mass.
  const RingConstants& constants() const { return ring_; }
  /// Contact forces of the last step.
  const magic_formula::SteadyState& contact_forces() const { return forces_; }
  Eigen::Vector3d belt_displacement() const { return state_.segment<3>(0); }  // m, C
  /// The plane that the cams found in the last step.
  const magic_formula::RoadPlane& effective_plane() const { return plane_; }

 private:
  /// State: d, phi, their rates, u, v, the distance over which the patch was rolled in, its twist.
  using State = Eigen::Matrix<double, 16, 1>;
  /// Rim and effective plane at a time within the step.
  struct Rim {
    WheelMotion motion;
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // m/s^2, inertial
    double spin_acceleration = 0.0;
    magic_formula::RoadPlane plane;
    Eigen::Vector3d normal_rate = Eigen::Vector3d::Zero();  // 1/s, of the plane's normal
  };
  struct Contact {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   // on the belt, C
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // about the belt's center, C
    Eigen::Vector4d rate = Eigen::Vector4d::Zero();    // derivatives of the state from u on
    Eigen::Vector2d most{INFINITY, INFINITY};          // m: largest |u|, |v| of a patch at rest
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
  bool moving_ = false;             // before_ is valid
  magic_formula::RoadPlane plane_;  // at the end of the last step
  double load_rate_ = 0.0;          // N/s, over the last step
  Eigen::Vector2d most_;            // m: largest |u|, |v|, from the last rate
  magic_formula::SteadyState forces_{};
  magic_formula::State input_{};  // input of the last forces
  magic_formula::RangeWatch watch_;
};

}  // namespace latsch::rigid_ring
