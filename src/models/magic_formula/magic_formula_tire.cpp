// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/magic_formula_tire.h"

#include <algorithm>
#include <cmath>

#include "models/magic_formula/transient_slip.h"

namespace latsch::magic_formula {
namespace {

constexpr double kNoSlip = 1e-4;      // below it the formula is straight
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

std::optional<Footprint> footprint_of(const MagicFormula& formula,
                                      double Fz,
                                      double speed,
                                      double pressure) {
  if (!(Fz > 0.0)) return Footprint{};
  const SteadyState patch = formula.evaluate({Fz, 0.0, 0.0, 0.0, 0.0, speed, pressure});
  if (!(patch.a > 0.0 && patch.b > 0.0)) return std::nullopt;
  return Footprint::rectangle(Fz, 2.0 * patch.a, 2.0 * patch.b);
}

double MagicFormulaTire::free_radius() const {
  return parameters_.UNLOADED_RADIUS * parameters_.Q_RE0;
}

std::optional<Footprint> MagicFormulaTire::footprint() const {
  return footprint_of(formula_, forces_.Fz, parameters_.LONGVL, settings_.pressure);
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

SteadyState MagicFormulaTire::evaluate(const WheelContact& contact,
                                       double Fz,
                                       const Slips& slips) const {
  const bool lags = transient(settings_.use_mode);
  const double Vx = lags ? formula_speed(contact.Vx, parameters_.VXLOW) : contact.Vx;
  const double phit = std::abs(Vx) > 0.0 ? -contact.yaw_rate / std::abs(Vx) : 0.0;
  // The formula's kappa is (omega R_e - Vx)/Vx, which changes sign backwards.
  State state{Fz,
              std::copysign(1.0, Vx) * slips.kappa,
              slips.alpha,
              contact.gamma,
              phit,
              Vx,
              settings_.pressure};
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

/// Relaxation lengths at these slips: that of the secant from no slip, where ply steer, conicity
/// and camber leave a force that needs no deflection. Of the tangent where the slip is next to
/// none.
MagicFormulaTire::Lengths MagicFormulaTire::lengths(const WheelContact& contact,
                                                    double Fz,
                                                    const Slips& slips) const {
  const SteadyState here = evaluate(contact, Fz, slips);
  Lengths sigma{std::max(here.sigma_x, kLeastSigma), std::max(here.sigma_y, kLeastSigma)};
  if (settings_.use_mode / 10 % 10 < 2) return sigma;
  const auto secant = [&](double slip, double longest, double stiffness, auto force_at) {
    if (stiffness <= 0.0) return longest;
    const double far = std::abs(slip) < kNoSlip ? std::copysign(kNoSlip, slip) : slip;
    const double length = std::abs((force_at(far) - force_at(0.0)) / (stiffness * far));
    return std::clamp(length, kLeastSigma, longest);
  };
  sigma.x = secant(slips.kappa, sigma.x, here.Cx, [&](double kappa) {
    return evaluate(contact, Fz, {kappa, slips.alpha}).Fx;
  });
  sigma.y = secant(std::tan(slips.alpha), sigma.y, here.Cy, [&](double tan_alpha) {
    return evaluate(contact, Fz, {slips.kappa, std::atan(tan_alpha)}).Fy;
  });
  return sigma;
}

/// The slips `step` later where the patch slides with `at`; exact for constant velocities.
MagicFormulaTire::Slips MagicFormulaTire::relaxed_slips(const Sliding& at,
                                                        const Lengths& sigma,
                                                        double step) const {
  // The states are slips: a relaxation length that changes with the load moves no force by itself.
  const double u =
      relaxed(slips_.kappa * sigma.x, -at.Vsx, at.Vx, sigma.x, kMostSlip * sigma.x, step);
  const double v =
      relaxed(std::tan(slips_.alpha) * sigma.y, at.Vsy, at.Vx, sigma.y, kMostSlip * sigma.y, step);
  return {u / sigma.x, std::atan(v / sigma.y)};
}

/// The exponential midpoint rule: velocities and relaxation lengths of the middle of the step.
MagicFormulaTire::Slips MagicFormulaTire::lag(const WheelContact& contact,
                                              const Sliding& now,
                                              double step) const {
  if (!transient(settings_.use_mode)) {
    const double floor = std::max(std::abs(contact.Vx), parameters_.VXLOW);
    return {std::clamp(-now.Vsx / floor, -kMostSlip, kMostSlip), std::atan(now.Vsy / floor)};
  }
  const Sliding& before = before_ ? *before_ : now;
  const Sliding middle{0.5 * (before.Vx + now.Vx),
                       0.5 * (before.Vsx + now.Vsx),
                       0.5 * (before.Vsy + now.Vsy),
                       0.5 * (before.Fz + now.Fz)};
  const Slips half = relaxed_slips(before, lengths(contact, before.Fz, slips_), 0.5 * step);
  return relaxed_slips(middle, lengths(contact, middle.Fz, half), step);
}

/// Load and slips at the end of a step; where forces along the road lower the load, the ones there.
void MagicFormulaTire::roll(const WheelContact& contact, double spin_rate, double step) {
  constexpr int kMost = 20;
  constexpr double kClose = 1e-9;  // of the load
  const bool coupled = parameters_.Q_FCX != 0.0 || parameters_.Q_FCY != 0.0;
  Slips slips = slips_;
  Sliding now;
  for (int i = 0; i < kMost; ++i) {
    const double Fz = vertical_force(contact, spin_rate);
    if (Fz <= 0.0) {
      slips_ = {};
      before_.reset();
      forces_ = {};
      return;
    }
    const bool settled = std::abs(Fz - now.Fz) <= kClose * Fz;
    const double R_e = evaluate(contact, Fz, slips_).R_e;
    now = {contact.Vx, contact.Vx - spin_rate * R_e, contact.Vy, Fz};
    slips = lag(contact, now, step);
    forces_ = evaluate(contact, Fz, slips);
    forces_.Fz = Fz;  // also beyond FZMAX, where the formula's is limited
    if (settled || !coupled) break;
  }
  slips_ = slips;
  before_ = now;
}

HubForces MagicFormulaTire::hub_forces(const WheelMotion& motion,
                                       const WheelContact& contact) const {
  return at_hub(
      motion, contact, {forces_.Fx, forces_.Fy, forces_.Fz}, {forces_.Mx, forces_.My, forces_.Mz});
}

Result<HubForces> MagicFormulaTire::settle(const WheelMotion& motion,
                                           const road::Road& road,
                                           double time) {
  slips_ = {};
  before_.reset();
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
  roll(*contact, motion.spin_rate, step);
  if (forces_.Fz <= 0.0) return HubForces{};
  const HubForces hub = hub_forces(motion, *contact);
  if (!hub.force.allFinite() || !hub.moment.allFinite())
    return Failure{"the Magic Formula gives no finite force: check the tire's coefficients"};
  return hub;
}

}  // namespace latsch::magic_formula
