// SPDX-License-Identifier: Apache-2.0
#include "models/magic_formula/magic_formula_tire.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/magic_formula/transient_slip.h"
#include "models/tire/free_trials.h"

namespace latsch::magic_formula {
namespace {

constexpr double kNoSlip = 1e-4;  // slip below which the force counts as linear in the slip
// Lower limit of the relaxation length, m: shorter than any contact patch.
constexpr double kLeastSigma = 0.01;

Conventions for_mode(Conventions conventions, int use_mode) {
  conventions.turn_slip = conventions.turn_slip || use_mode % 10 == 5;
  return conventions;
}

bool transient(int use_mode) { return use_mode / 10 % 10 > 0; }

}  // namespace

Parameters on_road(Parameters parameters, double friction) {
  parameters.LMUX *= friction;
  parameters.LMUY *= friction;
  return parameters;
}

Status check_rim(const Parameters& p, const WheelContact& contact) {
  // Smallest height of the axle above the road, as a share of the rim radius, or of the free radius
  // if the file states no rim. A rim that bottoms may compress its own stiffness a little.
  constexpr double kBottomed = 0.9, kNoRim = 0.4;
  const double lowest = p.RIM_RADIUS > 0.0 ? (p.BOTTOM_STIFF > 0.0 ? kBottomed : 1.0) * p.RIM_RADIUS
                                           : kNoRim * p.UNLOADED_RADIUS;
  if (!(contact.height < lowest)) return {};
  return Failure{
      fmt::format("the axle is {:.4g} mm above the road, but the rim {} {:.4g} mm: the tire is "
                  "pressed by more than its section",
                  1e3 * contact.height,
                  p.RIM_RADIUS > 0.0 ? "has a radius of" : "of a tire of this size has at least",
                  1e3 * (p.RIM_RADIUS > 0.0 ? p.RIM_RADIUS : lowest))};
}

MagicFormulaTire::MagicFormulaTire(const Parameters& parameters,
                                   const MagicFormulaTireSettings& settings)
    : parameters_(parameters),
      settings_(settings),
      formula_(parameters, for_mode(settings.conventions, settings.use_mode)),
      watch_(settings.log) {
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
  double Fz = formula_.vertical_force(
      rho, spin_rate, contact.gamma, settings_.pressure, forces_.Fx, forces_.Fy);
  const double bottomed = p.RIM_RADIUS + p.BOTTOM_OFFST - contact.height;
  if (bottomed > 0.0) Fz += p.BOTTOM_STIFF * bottomed;
  return std::max(Fz + p.VERTICAL_DAMPING * contact.approach, 0.0);
}

SteadyState MagicFormulaTire::evaluate(const WheelContact& contact,
                                       double Fz,
                                       const Patch& patch) const {
  const bool lags = transient(settings_.use_mode);
  const double low = low_speed(parameters_);
  const double V = lags ? std::max(std::abs(contact.Vx), low) : std::abs(contact.Vx);
  const double phit = V > 0.0 ? -contact.yaw_rate / V : 0.0;
  State state{Fz,
              patch.kappa,
              patch.alpha,
              contact.gamma,
              lags ? awake(contact.Vx, low) * phit : phit,
              contact.Vx,
              settings_.pressure};
  const auto ask = [&](State s) {
    if (lags) return at_any_speed(formula_, s, patch.r);
    // The formula defines kappa as (omega R_e - Vx)/Vx, which has the opposite sign for backward
    // motion.
    s.kappa = std::copysign(1.0, s.Vx) * s.kappa;
    return formula_.evaluate(s);
  };
  const int forces = settings_.use_mode % 10;
  if (forces == 1) state.alpha = 0.0;
  if (forces == 2) state.kappa = 0.0;
  SteadyState s = ask(state);
  if (forces == 3) {
    State straight = state;
    straight.alpha = 0.0;
    const SteadyState x = ask(straight);
    state.kappa = 0.0;
    s = ask(state);
    s.Fx = x.Fx;
    s.My = x.My;
  }
  if (forces == 0 || forces == 2) s.Fx = s.My = 0.0;
  if (forces == 0 || forces == 1) s.Fy = s.Mx = s.Mz = 0.0;
  return s;
}

/// Returns the relaxation lengths at these slips from the secant of the force between zero slip and
/// this slip. The force at zero slip, by ply steer, conicity and camber, needs no deflection of the
/// carcass. If the slip is almost zero, the tangent is used.
MagicFormulaTire::Carcass MagicFormulaTire::carcass(const WheelContact& contact,
                                                    double Fz,
                                                    const Patch& patch) const {
  const SteadyState here = evaluate(contact, Fz, patch);
  Carcass c{std::max(here.sigma_x, kLeastSigma),
            std::max(here.sigma_y, kLeastSigma),
            here.mux * Fz,
            here.muy * Fz,
            here.Kxk,
            here.Kya,
            pivot_of(parameters_, here)};
  if (settings_.use_mode / 10 % 10 < 2) return c;
  const auto secant = [&](double slip, double longest, double stiffness, auto force_at) {
    if (stiffness <= 0.0) return longest;
    const double far = std::abs(slip) < kNoSlip ? std::copysign(kNoSlip, slip) : slip;
    const double length = std::abs((force_at(far) - force_at(0.0)) / (stiffness * far));
    return std::clamp(length, kLeastSigma, longest);
  };
  c.sigma_x = secant(patch.kappa, c.sigma_x, here.Cx, [&](double kappa) {
    return evaluate(contact, Fz, {kappa, patch.alpha, patch.r}).Fx;
  });
  c.sigma_y = secant(std::tan(patch.alpha), c.sigma_y, here.Cy, [&](double tan_alpha) {
    return evaluate(contact, Fz, {patch.kappa, std::atan(tan_alpha), patch.r}).Fy;
  });
  return c;
}

/// Returns the state of the contact patch after `step` (s) if its sliding velocities remain those
/// of `at`. The relaxation equation is solved exactly for constant velocities.
MagicFormulaTire::Patch MagicFormulaTire::relaxed_patch(const Sliding& at,
                                                        const Carcass& c,
                                                        double step) const {
  const double low = low_speed(parameters_);
  const double V_r = at.Vx - (1.0 - awake(at.Vx, low)) * at.Vsx;
  const double speed = std::max(std::abs(at.Vx), std::hypot(at.Vsx, at.Vsy));
  const double x = c.sigma_x, y = c.sigma_y;
  const double most_x = most_slip(speed, low, c.peak_x, c.slope_x) * x;
  const double most_y = most_slip(speed, low, c.peak_y, c.slope_y) * y;
  // The stored states are slips u/sigma, so that a change of the relaxation length with the load
  // alone does not change a force.
  const double u = relaxed(patch_.kappa * x, -at.Vsx, std::abs(V_r) / x, most_x, step);
  const double v = relaxed(std::tan(patch_.alpha) * y, at.Vsy, std::abs(V_r) / y, most_y, step);
  return {u / x,
          std::atan(v / y),
          relaxed(patch_.r, V_r / y, std::abs(V_r) / y, 1.0, step),
          c.pivot.twisted(patch_.psi, at.yaw_rate, V_r, step)};
}

/// Integrates the slips by the exponential midpoint rule, with the velocities and relaxation
/// lengths in the middle of the step.
MagicFormulaTire::Patch MagicFormulaTire::lag(const WheelContact& contact,
                                              const Sliding& now,
                                              double step) const {
  if (!transient(settings_.use_mode)) {
    const double floor = std::max(std::abs(contact.Vx), low_speed(parameters_));
    return {std::clamp(-now.Vsx / floor, -kMostSlip, kMostSlip), std::atan(now.Vsy / floor)};
  }
  const Sliding& before = before_ ? *before_ : now;
  const Sliding middle{0.5 * (before.Vx + now.Vx),
                       0.5 * (before.Vsx + now.Vsx),
                       0.5 * (before.Vsy + now.Vsy),
                       0.5 * (before.yaw_rate + now.yaw_rate),
                       0.5 * (before.Fz + now.Fz)};
  const Patch half = relaxed_patch(before, carcass(contact, before.Fz, patch_), 0.5 * step);
  return relaxed_patch(middle, carcass(contact, middle.Fz, half), step);
}

/// Returns the forces of the contact patch with the sliding velocities `now`. At speeds below VXLOW
/// they include the carcass's damping and the moment of its twist.
SteadyState MagicFormulaTire::answer(const WheelContact& contact,
                                     const Sliding& now,
                                     Patch patch) const {
  const double k = standing_damping(contact.Vx, parameters_);
  if (!transient(settings_.use_mode) || k == 0.0) return evaluate(contact, now.Fz, patch);
  const Carcass c = carcass(contact, now.Fz, patch);
  const auto bounded = [](double slip) { return std::clamp(slip, -kMostSlip, kMostSlip); };
  patch.kappa = bounded(patch.kappa - k * now.Vsx / c.sigma_x);
  patch.alpha = std::atan(bounded(std::tan(patch.alpha) + k * now.Vsy / c.sigma_y));
  SteadyState s = evaluate(contact, now.Fz, patch);
  const double still = 1.0 - awake(contact.Vx, low_speed(parameters_));
  if (settings_.use_mode % 10 > 1) s.Mz -= still * c.pivot.stiffness * patch.psi;
  return s;
}

/// Finds the load and the slips at the end of a step, by iteration if the horizontal forces reduce
/// the load.
void MagicFormulaTire::roll(const WheelContact& contact, double spin_rate, double step) {
  constexpr int kMost = 20;
  constexpr double kClose = 1e-9;  // convergence tolerance relative to the load
  const bool coupled = parameters_.Q_FCX != 0.0 || parameters_.Q_FCY != 0.0;
  Patch patch = patch_;
  Sliding now;
  for (int i = 0; i < kMost; ++i) {
    const double Fz = vertical_force(contact, spin_rate);
    if (Fz <= 0.0) {
      patch_ = {};
      before_.reset();
      forces_ = {};
      return;
    }
    const bool settled = std::abs(Fz - now.Fz) <= kClose * Fz;
    const double R_e = evaluate(contact, Fz, patch_).R_e;
    now = {contact.Vx, contact.Vx - spin_rate * R_e, contact.Vy, contact.yaw_rate, Fz};
    patch = lag(contact, now, step);
    forces_ = answer(contact, now, patch);
    forces_.Fz = Fz;  // the actual load, even above FZMAX, to which the formula's load is limited
    if (settled || !coupled) break;
  }
  patch_ = patch;
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
  if (const Status fit = check_motion(motion); !fit) return fit.failure();
  patch_ = {};
  before_.reset();
  forces_ = {};
  const RoadPlane plane = tangent_plane(motion, road, time);
  auto contact = touch(motion, plane);
  if (!contact) return Failure{"the wheel lies flat: its spin axis is perpendicular to the road"};
  take_friction(contact->friction);
  if (const Status above = check_rim(parameters_, *contact); !above) return above.failure();
  contact->approach = contact->Vx = contact->Vy = contact->yaw_rate = 0.0;
  const double Fz = vertical_force(*contact, 0.0);
  if (Fz > 0.0) forces_ = answer(*contact, {.Fz = Fz}, patch_);
  forces_.Fz = Fz;
  return hub_forces(motion, *contact);
}

Result<HubForces> MagicFormulaTire::advance(const WheelMotion& motion,
                                            const road::Road& road,
                                            double time,
                                            double step) {
  if (const Status fit = check_motion(motion, step); !fit) return fit.failure();
  const RoadPlane plane = tangent_plane(motion, road, time);
  const auto contact = touch(motion, plane);
  if (!contact) return Failure{"the wheel lies flat: its spin axis is perpendicular to the road"};
  if (const Status above = check_rim(parameters_, *contact); !above) return above.failure();
  take_friction(contact->friction);
  roll(*contact, motion.spin_rate, step);
  watch_.see({.Fz = forces_.Fz,
              .kappa = patch_.kappa,
              .alpha = patch_.alpha,
              .gamma = contact->gamma,
              .phit = 0.0,
              .Vx = contact->Vx,
              .p = settings_.pressure});
  if (forces_.Fz <= 0.0) return HubForces{};
  const HubForces hub = hub_forces(motion, *contact);
  if (!hub.force.allFinite() || !hub.moment.allFinite())
    return Failure{"the Magic Formula gives no finite force: check the tire's coefficients"};
  return hub;
}

Result<HubForces> MagicFormulaTire::advance_free(
    WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double step) {
  return advance_by_trials(*this, motion, wheel, road, time, step);
}

}  // namespace latsch::magic_formula
