// SPDX-License-Identifier: Apache-2.0
#include "models/rigid_ring/rigid_ring_tire.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/magic_formula/vertical/load_curve.h"
#include "models/rigid_ring/ring_doubts.h"
#include "models/tire/free_trials.h"

namespace latsch::rigid_ring {

using Eigen::Vector3d;
using magic_formula::kMostSlip;
using magic_formula::MagicFormula;
using magic_formula::MagicFormulaTireSettings;
using magic_formula::Parameters;
using magic_formula::SteadyState;
using magic_formula::WheelContact;

namespace {

constexpr double kLeastSigma = 0.01;  // m
constexpr double kLeastShare = 0.05;  // share of the nominal load: a patch about to lift off has
                                      // the length at this load

/// Returns the loaded radius at the nominal load at rest.
double nominal_radius(const Parameters& p) {
  return MagicFormula(p).evaluate({p.FNOMIN, 0.0, 0.0, 0.0, 0.0, p.LONGVL, p.NOMPRES}).R_l;
}

/// Stops a deflection that has reached its bound.
double bounded_rate(double u, double rate, double bound) {
  return (u >= bound && rate > 0.0) || (u <= -bound && rate < 0.0) ? 0.0 : rate;
}

}  // namespace

Result<std::unique_ptr<RigidRingTire>> RigidRingTire::make(
    const Parameters& parameters, const MagicFormulaTireSettings& settings) {
  if (const Status cams = check_cams(parameters); !cams) return cams.failure();
  const Result<RingConstants> ring = ring_constants(parameters, nominal_radius(parameters));
  if (!ring) return ring.failure();
  return std::unique_ptr<RigidRingTire>(new RigidRingTire(parameters, settings, *ring));
}

RigidRingTire::RigidRingTire(const Parameters& parameters,
                             const MagicFormulaTireSettings& settings,
                             const RingConstants& ring)
    : parameters_(parameters),
      settings_(settings),
      formula_(parameters, settings.conventions),
      ring_(ring),
      cams_(parameters),
      watch_(settings.log) {
  if (settings_.pressure <= 0.0) settings_.pressure = parameters.INFLPRES;
}

double RigidRingTire::free_radius() const {
  return parameters_.UNLOADED_RADIUS * parameters_.Q_RE0;
}

std::optional<Footprint> RigidRingTire::footprint() const {
  return footprint_of(formula_, forces_.Fz, parameters_.LONGVL, settings_.pressure);
}

std::unique_ptr<Tire> RigidRingTire::clone() const {
  return std::unique_ptr<Tire>(new RigidRingTire(*this));
}

WheelMotion RigidRingTire::belt_motion(const State& y, const WheelMotion& rim) const {
  const Vector3d d = y.segment<3>(0), phi = y.segment<3>(3);
  const Vector3d d_rate = y.segment<3>(6), phi_rate = y.segment<3>(9);
  const Vector3d tilt(phi.x(), 0.0, phi.z());
  WheelMotion belt = rim;
  belt.center = rim.center + rim.carrier * d;
  belt.carrier = rim.carrier * (Eigen::AngleAxisd(tilt.x(), Vector3d::UnitX()) *
                                Eigen::AngleAxisd(tilt.z(), Vector3d::UnitZ()))
                                   .toRotationMatrix();
  belt.velocity = rim.velocity + rim.angular_velocity.cross(rim.carrier * d) + rim.carrier * d_rate;
  belt.angular_velocity =
      rim.angular_velocity + rim.carrier * Vector3d(phi_rate.x(), 0.0, phi_rate.z());
  belt.spin_rate = rim.spin_rate + phi_rate.y();
  return belt;
}

/// Solves Fz = F_static(rho + Fz/k_bz), with the file's own curve of rim and road, by the secant
/// method.
double RigidRingTire::load(double rho, double approach, double spin_rate, double gamma) const {
  const auto surplus = [&](double Fz) {
    return Fz -
           formula_.vertical_force(
               rho + Fz / ring_.k_bx, spin_rate, gamma, settings_.pressure, forces_.Fx, forces_.Fy);
  };
  const double damped = parameters_.DAMP_RESIDUAL * ring_.c_rz * approach;
  if (rho <= 0.0) return 0.0;
  if (magic_formula::has_load_curve(parameters_))
    return std::max(
        magic_formula::force_on_curve_with_spring(parameters_, rho, ring_.k_bx) + damped, 0.0);
  double before = 0.0, f_before = surplus(0.0);
  double Fz = -f_before * ring_.c_rz / parameters_.VERTICAL_STIFFNESS;
  for (int i = 0; i < 20; ++i) {
    const double f = surplus(Fz);
    if (f == f_before || std::abs(f) < 1e-10 * parameters_.FNOMIN) break;
    const double next = Fz - f * (Fz - before) / (f - f_before);
    before = Fz;
    f_before = f;
    Fz = next;
  }
  return std::max(Fz + damped, 0.0);
}

/// Computes slips and their rates. `turning`: w_c - w_y, rad/s.
void RigidRingTire::slip(
    const WheelContact& wheel, double spin_rate, double turning, Contact& c, const State& y) {
  using namespace magic_formula;
  const Parameters& p = parameters_;
  const double Fz = forces_.Fz, low = low_speed(p), q = awake(wheel.Vx, low);
  const double phit = q * (-wheel.yaw_rate / std::max(std::abs(wheel.Vx), low));
  magic_formula::State state{Fz, 0.0, 0.0, wheel.gamma, phit, wheel.Vx, settings_.pressure};
  const SteadyState still = at_any_speed(formula_, state, y[14]);
  const double sigma_x = std::max(std::abs(still.Kxk) / ring_.c_rx, kLeastSigma);
  const double sigma_y = std::max(std::abs(still.Kya) / ring_.c_ry, kLeastSigma);
  const double Vsx = wheel.Vx - spin_rate * still.R_e - (wheel.height - still.R_e) * turning;
  const double Vsy = wheel.Vy;
  const double k = standing_damping(wheel.Vx, p);
  state.kappa = std::clamp((y[12] - k * Vsx) / sigma_x, -kMostSlip, kMostSlip);
  state.alpha = std::atan(std::clamp((y[13] + k * Vsy) / sigma_y, -kMostSlip, kMostSlip));
  forces_ = at_any_speed(formula_, state, y[14]);
  forces_.Fz = Fz;
  input_ = state;
  Pivot pivot = pivot_of(p, still);
  if (ring_.c_rpsi > 0.0) pivot.stiffness = ring_.c_rpsi;
  forces_.Mz -= (1.0 - q) * pivot.stiffness * y[15];

  const double V_r = wheel.Vx - (1.0 - q) * Vsx, V = std::abs(V_r);
  const double speed = std::max(std::abs(wheel.Vx), std::hypot(Vsx, Vsy));
  const double most_x = most_slip(speed, low, still.mux * Fz, still.Kxk) * sigma_x;
  const double most_y = most_slip(speed, low, still.muy * Fz, still.Kya) * sigma_y;
  c.rate = {bounded_rate(y[12], -Vsx - V / sigma_x * y[12], most_x),
            bounded_rate(y[13], Vsy - V / sigma_y * y[13], most_y),
            (V_r - V * y[14]) / sigma_y,
            pivot.twist_rate(y[15], wheel.yaw_rate, V_r)};
  if (speed < low) c.most = {most_x, most_y};
}

RigidRingTire::Contact RigidRingTire::contact(const State& y, const Rim& at, bool rolling) {
  const Parameters& p = parameters_;
  const WheelMotion& rim = at.motion;
  const WheelMotion belt = belt_motion(y, rim);
  const auto wheel = touch(belt, at.plane);
  Contact c;
  if (!wheel) return c;
  const double speed = belt.spin_rate * p.UNLOADED_RADIUS / p.LONGVL;
  const double R_omega = p.UNLOADED_RADIUS * (p.Q_RE0 + p.Q_V1 * speed * speed);
  const double turning =
      at.normal_rate.dot(wheel->axes.col(0)) - rim.angular_velocity.dot(wheel->axes.col(1));
  // If forces along the road lower the load, load and forces are iterated.
  const bool coupled = rolling && (p.Q_FCX != 0.0 || p.Q_FCY != 0.0);
  constexpr int kMost = 20;
  constexpr double kClose = 1e-9;  // share of the load
  for (int i = 0; i < (coupled ? kMost : 1); ++i) {
    const double Fz = load(
        R_omega - wheel->height, rolling ? wheel->approach : 0.0, belt.spin_rate, wheel->gamma);
    if (Fz <= 0.0) {
      forces_ = {};
      c.rate = -y.tail<4>() / 1e-3;  // the residual springs relax within a millisecond
      return c;
    }
    const bool settled = i > 0 && std::abs(Fz - forces_.Fz) <= kClose * Fz;
    if (!rolling) forces_ = {};
    forces_.Fz = Fz;
    if (rolling) slip(*wheel, belt.spin_rate, turning, c, y);
    if (settled) break;
  }
  const Vector3d force = wheel->axes * Vector3d(forces_.Fx, forces_.Fy, forces_.Fz);
  const Vector3d moment = wheel->axes * Vector3d(forces_.Mx, forces_.My, forces_.Mz) +
                          (wheel->point - belt.center).cross(force);
  c.force = rim.carrier.transpose() * force;
  c.moment = rim.carrier.transpose() * moment;
  return c;
}

/// Computes force and moment of springs and dampers on the rim, in C.
void RigidRingTire::springs(const State& y,
                            double spin_rate,
                            Vector3d& force,
                            Vector3d& moment) const {
  const Vector3d d = y.segment<3>(0), phi = y.segment<3>(3);
  const Vector3d turning = spin_rate * Vector3d::UnitY();
  const Vector3d v_rel = y.segment<3>(6) - turning.cross(d);
  const Vector3d w_rel = y.segment<3>(9) - turning.cross(Vector3d(phi.x(), 0.0, phi.z()));
  force = Vector3d(ring_.k_bx, ring_.k_by, ring_.k_bx).cwiseProduct(d) +
          Vector3d(ring_.c_bx, ring_.c_by, ring_.c_bx).cwiseProduct(v_rel);
  moment = Vector3d(ring_.k_bgamma, ring_.k_btheta, ring_.k_bgamma).cwiseProduct(phi) +
           Vector3d(ring_.c_bgamma, ring_.c_btheta, ring_.c_bgamma).cwiseProduct(w_rel);
}

RigidRingTire::State RigidRingTire::rate(const State& y, const Rim& rim) {
  const Contact c = contact(y, rim, true);
  const double spin_rate = rim.motion.spin_rate;
  Vector3d force, moment;
  springs(y, spin_rate, force, moment);
  const Eigen::Matrix3d to_C = rim.motion.carrier.transpose();
  const Vector3d turning = to_C * rim.motion.angular_velocity + y.segment<3>(9);
  const double H = ring_.I_yy * (spin_rate + y[10]);  // spin momentum
  const Vector3d gyroscopic(H * turning.z(), 0.0, -H * turning.x());
  State rate;
  rate.segment<6>(0) = y.segment<6>(6);
  rate.segment<3>(6) = (c.force - force) / ring_.m_b +
                       to_C * (Vector3d(0.0, 0.0, parameters_.GRAVITY) - rim.acceleration);
  rate.segment<3>(9) =
      (c.moment - moment + gyroscopic).cwiseQuotient(Vector3d(ring_.I_xx, ring_.I_yy, ring_.I_xx));
  rate[10] -= rim.spin_acceleration;
  rate.tail<4>() = c.rate;
  most_ = c.most;
  return rate;
}

HubForces RigidRingTire::hub_forces(const State& y, double spin_rate) const {
  HubForces hub;
  springs(y, spin_rate, hub.force, hub.moment);
  hub.moment += Vector3d(y.segment<3>(0)).cross(hub.force);
  return hub;
}

/// Returns the effective plane under the wheel at `motion`, with the belt and the load extrapolated
/// by `ahead` s.
magic_formula::RoadPlane RigidRingTire::plane_ahead(const WheelMotion& motion,
                                                    double ahead,
                                                    const road::Road& road,
                                                    double time) const {
  State then = state_;
  then.head<6>() += ahead * state_.segment<6>(6);
  const WheelMotion belt = belt_motion(then, motion);
  const Vector3d forward = belt.carrier.col(1).cross(Vector3d::UnitZ());
  if (forward.norm() < 1e-3) return plane_;  // the belt lies flat; `touch` reports it
  const double Fz = std::max(forces_.Fz + ahead * load_rate_, kLeastShare * parameters_.FNOMIN);
  const SteadyState patch =
      formula_.evaluate({Fz, 0.0, 0.0, 0.0, 0.0, parameters_.LONGVL, settings_.pressure});
  return cams_.plane(belt.center, forward, patch.a, patch.b, road, time);
}

void RigidRingTire::take_friction(double friction) {
  if (friction != formula_.parameters().LMUY / parameters_.LMUY)
    formula_ = MagicFormula(magic_formula::on_road(parameters_, friction), formula_.conventions());
}

int RigidRingTire::substeps(double step, double Vx) const {
  const double R2 = parameters_.UNLOADED_RADIUS * parameters_.UNLOADED_RADIUS;
  const double fastest = std::sqrt(std::max({(ring_.k_bx + ring_.c_rx + ring_.c_rz) / ring_.m_b,
                                             (ring_.k_by + ring_.c_ry) / ring_.m_b,
                                             (ring_.k_bgamma + ring_.c_ry * R2) / ring_.I_xx,
                                             (ring_.k_btheta + ring_.c_rx * R2) / ring_.I_yy})) +
                         std::abs(Vx) / kLeastSigma * 0.2;
  constexpr double kAngle = 0.5;  // rad per substep: an error of 1e-4 of the amplitude per period
  return std::clamp(static_cast<int>(std::ceil(step * fastest / kAngle)), 1, 1000);
}

Result<HubForces> RigidRingTire::settle(const WheelMotion& motion,
                                        const road::Road& road,
                                        double time) {
  if (const Status fit = check_motion(motion); !fit) return fit.failure();
  WheelMotion rest = motion;
  rest.velocity.setZero();
  rest.angular_velocity.setZero();
  rest.spin_rate = 0.0;
  state_.setZero();
  forces_ = {};
  load_rate_ = 0.0;
  constexpr int kRounds = 80;  // each leaves a third of the error at most
  for (int round = 0; round < kRounds; ++round) {
    plane_ = plane_ahead(rest, 0.0, road, time);
    take_friction(plane_.friction);
    const Contact c = contact(state_, {.motion = rest, .plane = plane_}, false);
    const Vector3d weight =
        rest.carrier.transpose() * Vector3d(0.0, 0.0, ring_.m_b * parameters_.GRAVITY);
    state_.segment<3>(0) =
        (c.force + weight).cwiseQuotient(Vector3d(ring_.k_bx, ring_.k_by, ring_.k_bx));
    state_.segment<3>(3) =
        c.moment.cwiseQuotient(Vector3d(ring_.k_bgamma, ring_.k_btheta, ring_.k_bgamma));
  }
  before_ = motion;
  moving_ = true;
  if (!state_.allFinite()) return Failure{"the ring finds no equilibrium on this road"};
  if (const auto wheel = touch(motion, plane_))
    if (const Status above = check_rim(parameters_, *wheel); !above) return above.failure();
  return hub_forces(state_, 0.0);
}

/// Returns rim and plane at an intermediate time, all linear from the last step's end to this
/// one's.
RigidRingTire::Rim RigidRingTire::between(const WheelMotion& motion,
                                          const magic_formula::RoadPlane& plane,
                                          double step,
                                          double share) const {
  Rim rim;
  rim.acceleration = (motion.velocity - before_.velocity) / step;
  rim.spin_acceleration = (motion.spin_rate - before_.spin_rate) / step;
  rim.motion = motion;
  const auto mix = [share](const auto& from, const auto& to) {
    return (from + share * (to - from)).eval();
  };
  rim.motion.center = mix(before_.center, motion.center);
  rim.motion.velocity = mix(before_.velocity, motion.velocity);
  rim.motion.angular_velocity = mix(before_.angular_velocity, motion.angular_velocity);
  rim.motion.carrier = Eigen::Quaterniond(before_.carrier)
                           .slerp(share, Eigen::Quaterniond(motion.carrier))
                           .toRotationMatrix();
  rim.motion.spin_rate = before_.spin_rate + share * (motion.spin_rate - before_.spin_rate);
  rim.plane = plane;
  rim.normal_rate = (plane.normal - plane_.normal) / step;
  rim.plane.point = mix(plane_.point, plane.point);
  rim.plane.normal = mix(plane_.normal, plane.normal).normalized();
  rim.plane.velocity = mix(plane_.velocity, plane.velocity);
  return rim;
}

Result<HubForces> RigidRingTire::advance(const WheelMotion& motion,
                                         const road::Road& road,
                                         double time,
                                         double step) {
  if (const Status fit = check_motion(motion, step); !fit) return fit.failure();
  if (!moving_) {
    before_ = motion;
    plane_ = plane_ahead(motion, 0.0, road, time);
  }
  moving_ = true;
  const magic_formula::RoadPlane plane = plane_ahead(motion, step, road, time);
  const auto wheel = touch(belt_motion(state_, motion), plane);
  if (!wheel) return Failure{"the wheel lies flat: its spin axis is perpendicular to the road"};
  if (const auto rim = touch(motion, plane))
    if (const Status above = check_rim(parameters_, *rim); !above) return above.failure();
  take_friction(plane.friction);
  if (step == 0.0) return hub_forces(state_, motion.spin_rate);
  const int n = substeps(step, wheel->Vx);
  const double h = step / n, load_before = forces_.Fz;
  const auto at = [&](double share) { return between(motion, plane, step, share); };
  for (int i = 0; i < n; ++i) {
    const Rim begin = at(double(i) / n), middle = at((i + 0.5) / n), end = at((i + 1.0) / n);
    const State k1 = rate(state_, begin);
    const State k2 = rate(state_ + 0.5 * h * k1, middle);
    const State k3 = rate(state_ + 0.5 * h * k2, middle);
    const State k4 = rate(state_ + h * k3, end);
    state_ += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    state_.segment<2>(12) = state_.segment<2>(12).cwiseMax(-most_).cwiseMin(most_);
  }
  before_ = motion;
  plane_ = plane;
  load_rate_ = (forces_.Fz - load_before) / step;
  if (forces_.Fz > 0.0) watch_.see(input_);
  if (!state_.allFinite()) return Failure{"the ring left its springs: take smaller steps"};
  return hub_forces(state_, motion.spin_rate);
}

Result<HubForces> RigidRingTire::advance_free(
    WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double step) {
  return advance_by_trials(*this, motion, wheel, road, time, step);
}

}  // namespace latsch::rigid_ring
