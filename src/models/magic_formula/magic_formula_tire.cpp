// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/magic_formula_tire.h"

#include <algorithm>
#include <cmath>

#include "models/magic_formula/transient_slip.h"

namespace latsch::magic_formula {
namespace {

constexpr double kNoSlip = 1e-4;      // below it the formula is taken as linear
constexpr double kLeastSigma = 0.01;  // m: shorter than any contact patch
constexpr double kMostSlip = 3.0;     // of u/sigma and v/sigma: far in the sliding region

Conventions for_mode(Conventions conventions, int use_mode) {
  conventions.turn_slip = conventions.turn_slip || use_mode % 10 == 5;
  return conventions;
}

bool transient(int use_mode) { return use_mode / 10 % 10 > 0; }

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (at <= 0.0) return 0.0;
  auto i = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  i = std::clamp<std::ptrdiff_t>(i, 1, std::ssize(x) - 1);  // beyond the ends as the last piece
  return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

/// sigma such that the carcass carries, at this slip, the force the formula gives.
double sliding_sigma(double sigma, double force, double stiffness, double slip) {
  if (std::abs(slip) < kNoSlip || stiffness <= 0.0) return sigma;
  return std::clamp(std::abs(force) / (stiffness * std::abs(slip)), kLeastSigma, sigma);
}

}  // namespace

Parameters on_road(Parameters parameters, double friction) {
  parameters.LMUX *= friction;
  parameters.LMUY *= friction;
  return parameters;
}

MagicFormulaTire::MagicFormulaTire(const Parameters& parameters,
                                   const MagicFormulaTireSettings& settings)
    : parameters_(parameters),
      settings_(settings),
      formula_(parameters, for_mode(settings.conventions, settings.use_mode)) {
  if (settings_.pressure <= 0.0) settings_.pressure = parameters.INFLPRES;
}

double MagicFormulaTire::free_radius() const {
  return parameters_.UNLOADED_RADIUS * parameters_.Q_RE0;
}

std::optional<Footprint> MagicFormulaTire::footprint() const {
  if (!(forces_.Fz > 0.0)) return Footprint{};
  const SteadyState patch =
      formula_.evaluate({forces_.Fz, 0.0, 0.0, 0.0, 0.0, parameters_.LONGVL, settings_.pressure});
  if (!(patch.a > 0.0 && patch.b > 0.0)) return std::nullopt;
  return Footprint::rectangle(forces_.Fz, 2.0 * patch.a, 2.0 * patch.b);
}

std::unique_ptr<Tire> MagicFormulaTire::clone() const {
  return std::make_unique<MagicFormulaTire>(*this);
}

void MagicFormulaTire::take_friction(double friction) {
  if (friction == friction_) return;
  friction_ = friction;
  formula_ = MagicFormula(on_road(parameters_, friction), formula_.conventions());
}

double MagicFormulaTire::vertical_force(const WheelContact& contact, double spin_rate) const {
  const Parameters& p = parameters_;
  const double speed = spin_rate * p.UNLOADED_RADIUS / p.LONGVL;
  const double R_omega = p.UNLOADED_RADIUS * (p.Q_RE0 + p.Q_V1 * speed * speed);  // (1)
  const double rho = R_omega - contact.height;
  if (rho <= 0.0) return 0.0;
  double Fz = p.curve_deflection.empty()
                  ? formula_.vertical_force(
                        rho, spin_rate, contact.gamma, settings_.pressure, forces_.Fx, forces_.Fy)
                  : interpolated(p.curve_deflection, p.curve_force, rho);
  const double bottomed = p.RIM_RADIUS + p.BOTTOM_OFFST - contact.height;
  if (bottomed > 0.0) Fz += p.BOTTOM_STIFF * bottomed;
  return std::max(Fz + p.VERTICAL_DAMPING * contact.approach, 0.0);
}

SteadyState MagicFormulaTire::evaluate(const WheelContact& contact, double Fz) const {
  const bool lags = transient(settings_.use_mode);
  const double Vx = lags ? formula_speed(contact.Vx, parameters_.VXLOW) : contact.Vx;
  const double phit = std::abs(Vx) > 0.0 ? -contact.yaw_rate / std::abs(Vx) : 0.0;
  // The formula's kappa is (omega R_e - Vx)/Vx, which changes sign backwards.
  State state{
      Fz, std::copysign(1.0, Vx) * kappa_, alpha_, contact.gamma, phit, Vx, settings_.pressure};
  const int forces = settings_.use_mode % 10;
  if (forces == 1) state.alpha = 0.0;
  if (forces == 2) state.kappa = 0.0;
  SteadyState s = formula_.evaluate(state);
  if (forces == 3) {
    State straight = state;
    straight.alpha = 0.0;
    const SteadyState x = formula_.evaluate(straight);
    state.kappa = 0.0;
    s = formula_.evaluate(state);
    s.Fx = x.Fx;
    s.My = x.My;
  }
  if (lags) s.My *= rolling_share(contact.Vx, parameters_.VXLOW);
  if (forces == 0 || forces == 2) s.Fx = s.My = 0.0;
  if (forces == 0 || forces == 1) s.Fy = s.Mx = s.Mz = 0.0;
  return s;
}

void MagicFormulaTire::lag(const WheelContact& contact, double Fz, double spin_rate, double step) {
  const double V = std::max(std::abs(contact.Vx), 1e-9);
  SteadyState here = evaluate(contact, Fz);
  const double Vsx = contact.Vx - spin_rate * here.R_e, Vsy = contact.Vy;
  if (!transient(settings_.use_mode)) {
    const double floor = std::max(V, parameters_.VXLOW);
    kappa_ = std::clamp(-Vsx / floor, -kMostSlip, kMostSlip);
    alpha_ = std::atan(Vsy / floor);
    return;
  }
  double sigma_x = std::max(here.sigma_x, kLeastSigma);
  double sigma_y = std::max(here.sigma_y, kLeastSigma);
  if (settings_.use_mode / 10 % 10 >= 2) {
    sigma_x = sliding_sigma(sigma_x, here.Fx, here.Cx, kappa_);
    sigma_y = sliding_sigma(sigma_y, here.Fy, here.Cy, std::tan(alpha_));
  }
  // The states are slips: a relaxation length that changes with the load moves no force by itself.
  const double u = relaxed(kappa_ * sigma_x, -Vsx, contact.Vx, sigma_x, kMostSlip * sigma_x, step);
  const double v =
      relaxed(std::tan(alpha_) * sigma_y, Vsy, contact.Vx, sigma_y, kMostSlip * sigma_y, step);
  kappa_ = u / sigma_x;
  alpha_ = std::atan(v / sigma_y);
}

HubForces MagicFormulaTire::hub_forces(const WheelMotion& motion,
                                       const WheelContact& contact) const {
  return at_hub(
      motion, contact, {forces_.Fx, forces_.Fy, forces_.Fz}, {forces_.Mx, forces_.My, forces_.Mz});
}

Result<HubForces> MagicFormulaTire::settle(const WheelMotion& motion,
                                           const road::Road& road,
                                           double time) {
  kappa_ = alpha_ = 0.0;
  forces_ = {};
  const RoadPlane plane = tangent_plane(motion, road, time);
  auto contact = touch(motion, plane);
  if (!contact) return Failure{"the wheel lies flat: its spin axis stands on the road"};
  take_friction(contact->friction);
  contact->approach = 0.0;
  // At rest nothing slips: the load alone, through the contact point.
  forces_.Fz = vertical_force(*contact, 0.0);
  return hub_forces(motion, *contact);
}

Result<HubForces> MagicFormulaTire::advance(const WheelMotion& motion,
                                            const road::Road& road,
                                            double time,
                                            double step) {
  const RoadPlane plane = tangent_plane(motion, road, time);
  const auto contact = touch(motion, plane);
  if (!contact) return Failure{"the wheel lies flat: its spin axis stands on the road"};
  take_friction(contact->friction);
  const double Fz = vertical_force(*contact, motion.spin_rate);
  if (Fz <= 0.0) {
    kappa_ = alpha_ = 0.0;
    forces_ = {};
    return HubForces{};
  }
  lag(*contact, Fz, motion.spin_rate, step);
  forces_ = evaluate(*contact, Fz);
  forces_.Fz = Fz;  // also beyond FZMAX, where the formula's is limited
  const HubForces hub = hub_forces(motion, *contact);
  if (!hub.force.allFinite() || !hub.moment.allFinite())
    return Failure{"the Magic Formula gives no finite force: check the tire's coefficients"};
  return hub;
}

}  // namespace latsch::magic_formula
