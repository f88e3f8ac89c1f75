// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/rolling_transient.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/motion/moving_inertia.h"
#include "models/fe_tire/motion/spin.h"
#include "models/fe_tire/passage/bossak_step.h"
#include "models/fe_tire/passage/transient_history.h"
#include "models/fe_tire/rolling/linear_roller.h"

namespace latsch::fe_tire {
namespace {

constexpr int kMostOfStep = 20;  // iterations
/// Share of the residual before above which the tangent is renewed.
constexpr double kSlowInTime = 0.85;
constexpr int kMostFactors = 4;       // factorizations of one step
constexpr int kMostSharesHalved = 4;  // halvings of an iteration that inverts elements
constexpr int kMostStepsHalved = 4;
/// Share of the first spin below which the wheel's is not kept in memory any more.
constexpr double kSlowest = 4.0;
/// Change of the spin in an iteration, relative, at which it has settled.
constexpr double kSpinSettled = 5e-6;
/// Accepted error of the contact in an iteration, relative to the load.
constexpr double kContact = 1e-4;

/// Finds the ratio of successive steps of an iteration that converges linearly by one ratio. The
/// history of stresses that vary within a sector is not in the tangent (rolling_history.h), and
/// lets iterations converge so.
class GeometricSteps {
 public:
  /// Returns the ratio, 0 if it is not known or if a sum of such steps would be no better.
  double ratio(const Eigen::VectorXd& step) {
    double ratio = 0.0;
    if (before_.size() > 0) ratio = step.dot(before_) / before_.squaredNorm();
    if (ratio > kLeast && ratio < kMost) {
      before_.resize(0);  // the step that follows is another one
      return ratio;
    }
    before_ = step;
    return 0.0;
  }

 private:
  static constexpr double kLeast = 0.4, kMost = 0.95;
  Eigen::VectorXd before_;
};

}  // namespace

struct RollingTransient::Impl {
  FeTire& tire;
  const RingElements& elements;
  RingUnknowns unknowns;
  TreadSurface tread;
  RingAssembly assembly;
  TreadLines lines;
  MovingInertia inertia;
  numerics::SymmetricMatrix K, M, W;
  LinearRoller linear;
  std::optional<TransientHistory> history;  // none: the tire is elastic
  double factored_step = 0.0;               // s, of the factorization
  RollingTransientSettings settings;
  std::optional<PassingBar> bar;
  double pressure = 0.0, load = 1.0;

  /// The tire at the end of a step.
  struct State {
    BossakStep::Motion motion;
    Eigen::VectorXd alpha;
    GripState grip{0};
    std::optional<TreadPast> past;
    double spin = 0.0, spin_rate = 0.0;
    WheelMoment wheel;
    TransientHistory::Deviations deviations;  // only of states that are kept
  };
  State now;

  Impl(FeTire& of, const RingElements& with, TreadShape shape)
      : tire(of),
        elements(with),
        unknowns(with.ring(), RingSymmetry::none, {}),
        tread(unknowns, shape, kTouchingAngle),
        assembly(unknowns),
        lines(tread, with.ring().mesh()),
        inertia(with),
        K(*assembly.pattern()),
        M(assembly.mass(with)),
        W(flow_stiffness(assembly, with)),
        linear(assembly, tread, lines) {}

  /// An iterate of a step.
  struct Iterate {
    BossakStep::Motion motion;
    Eigen::VectorXd alpha;
    Eigen::VectorXd f;  // N, internal forces
    Eigen::VectorXd g;  // N, forces of (V.5) without the ground
    MovingInertia::Forces inertia;
    double spin = 0.0, spin_rate = 0.0;
  };
  Status evaluate(Iterate& at, const BossakStep& rule, const WheelMoment& to, bool with_tangent);
  void add_inertia(Iterate& at, const BossakStep& rule, const WheelMoment& to) const;
  Status renew(Iterate& at, const BossakStep& rule, const WheelMoment& to);
  Result<double> move(Iterate& at,
                      const BossakStep& rule,
                      const WheelMoment& to,
                      const LinearRoller::Found& found);
  double spin_rate_of(const Iterate& at,
                      const SpinningWheel& wheel,
                      const LinearRoller::Found& found) const;
  TransientForces forces(const Iterate& at,
                         const RollingCase& of,
                         const RollingForces& ground) const;
  Result<TransientForces> step(const WheelMoment& to, double h);
  Result<TransientForces> halves(const WheelMoment& to, double h, int halvings);
};

/// Computes g at the unknowns of the iterate, and the tangent if asked for.
Status RollingTransient::Impl::evaluate(Iterate& at,
                                        const BossakStep& rule,
                                        const WheelMoment& to,
                                        bool with_tangent) {
  AssembledState state{at.motion.x, at.alpha};
  int worst = 0;
  if (history) history->update_step(unknowns, state);
  const RingElements& by = history ? history->elements() : elements;
  if (!assembly.assemble(by, state, pressure, at.f, with_tangent ? &K : nullptr, &worst))
    return Failure{"an element is inverted, " + unknowns.ring().place(worst)};
  at.alpha = std::move(state.alpha);
  at.motion = rule.at(now.motion, at.motion.x);
  add_inertia(at, rule, to);
  return {};
}

/// Computes g from the internal forces and the motion of the iterate.
void RollingTransient::Impl::add_inertia(Iterate& at,
                                         const BossakStep& rule,
                                         const WheelMoment& to) const {
  Eigen::Matrix3Xd a = unknowns.expand(rule.mean_acceleration(now.motion, at.motion));
  if (!to.acceleration.isZero(0.0)) {
    const Mesh& mesh = unknowns.ring().mesh();
    const int n = mesh.nodes_per_sector();
    for (int s = 0; s < mesh.sectors; ++s)
      a.middleCols(s * n, n).colwise() += mesh.frame(s).transpose() * to.acceleration;
  }
  at.inertia = inertia.forces(
      {unknowns.expand(at.motion.x), unknowns.expand(at.motion.v), a, at.spin, at.spin_rate});
  at.g = at.f + unknowns.compress(at.inertia.at_nodes);
}

/// Evaluates the iterate, and factorizes its tangent.
Status RollingTransient::Impl::renew(Iterate& at, const BossakStep& rule, const WheelMoment& to) {
  if (const Status done = evaluate(at, rule, to, true); !done) return done;
  K.add(rule.of_mass(), M);
  K.add(-at.spin * at.spin, W);
  factored_step = rule.h;
  if (linear.factorize(K)) return {};
  return Failure{"the tangent of a step is not positive definite: expected a shorter step"};
}

/// Moves to the state found on the linear tire, or a part of the way if elements are inverted
/// there. Returns the part.
Result<double> RollingTransient::Impl::move(Iterate& at,
                                            const BossakStep& rule,
                                            const WheelMoment& to,
                                            const LinearRoller::Found& found) {
  double share = 1.0;
  for (int halving = 0;; ++halving, share *= 0.5) {
    Iterate trial = at;
    trial.motion.x -= share * found.d;
    const Status done = evaluate(trial, rule, to, false);
    if (!done && halving < kMostSharesHalved) continue;
    if (!done) return done.failure();
    at = std::move(trial);
    return share;
  }
}

/// Returns the change of the spin, rad/s^2, that follows from the moments of an iterate. Within a
/// step the belt hardly follows the rim, so iterations converge by about the bead's share of the
/// inertia.
double RollingTransient::Impl::spin_rate_of(const Iterate& at,
                                            const SpinningWheel& wheel,
                                            const LinearRoller::Found& found) const {
  const double moment = -found.forces.drive - at.inertia.moment.y() + wheel.moment;
  return moment / wheel.inertia;
}

TransientForces RollingTransient::Impl::forces(const Iterate& at,
                                               const RollingCase& of,
                                               const RollingForces& ground) const {
  TransientForces found;
  found.ground = ground;
  found.spin = at.spin;
  const PosedGround posed({}, {.height = of.height, .camber = of.camber});
  const Eigen::Vector3d hub = posed.in_ground(Eigen::Vector3d::Zero());
  const Eigen::Vector3d down = posed.in_ground(-Eigen::Vector3d::UnitZ()) - hub;
  const Eigen::Vector3d arm = hub.z() / -down.z() * down;  // to the contact center
  const Eigen::Vector3d about_hub = ground.moment + arm.cross(ground.force);
  found.force = posed.to_wheel(ground.force) - at.inertia.force;
  found.moment = posed.to_wheel(about_hub) - at.inertia.moment;
  return found;
}

/// One step of Newton's method after the other, up to the equilibrium at the end of the step.
Result<TransientForces> RollingTransient::Impl::step(const WheelMoment& to, double h) {
  const BossakStep rule(h, settings.rho);
  RollingCase of = to.of;
  of.load.reset();
  of.drive.reset();
  Iterate at{{rule.predicted(now.motion), {}, {}}, now.alpha, {}, {}, {}, of.spin, 0.0};
  const auto set_spin = [&](double rate) {
    at.spin_rate = rate;
    at.spin = now.spin + 0.5 * h * (now.spin_rate + rate);
  };
  if (to.wheel)
    set_spin(now.spin_rate);
  else
    at.spin_rate = (of.spin - now.spin) / h;
  const PassingMoment moment{*now.past, h, bar ? &*bar : nullptr, to.bar_at};
  GripState states = now.grip;
  TransientForces work;
  linear.begin();
  if (history) history->begin_step(h, at.spin);
  if (const Status done = evaluate(at, rule, to, false); !done) return done.failure();
  GeometricSteps shares;
  double before = 0.0, residual = 0.0;
  bool is_old = !linear.has_factor() || factored_step != h;
  for (work.iterations = 1; work.iterations <= kMostOfStep; ++work.iterations) {
    if (is_old) {
      if (++work.factors > kMostFactors) break;
      if (const Status done = renew(at, rule, to); !done) return done.failure();
      is_old = false;
    }
    of.spin = at.spin;
    auto found = linear.solve(of,
                              at.motion.x,
                              at.g,
                              load,
                              std::min(kContact, settings.enough),
                              states,
                              work.passes,
                              &moment);
    if (!found) {
      if (work.factors >= kMostFactors) return found.failure();
      is_old = true;
      states = now.grip;
      continue;
    }
    const auto share = move(at, rule, to, *found);
    if (!share) return share.failure();
    const double spin = at.spin;
    if (to.wheel) {
      set_spin(spin_rate_of(at, *to.wheel, *found));
      add_inertia(at, rule, to);
    }
    residual = (at.g - found->c).norm();
    if (*share == 1.0 && residual <= settings.enough * load &&
        std::abs(at.spin - spin) <= kSpinSettled * std::abs(spin)) {
      TransientForces reached = forces(at, of, found->forces);
      reached.iterations = work.iterations;
      reached.factors = work.factors;
      reached.passes = work.passes;
      if (history) history->end_step();
      now.past->add(std::move(found->instant), h);
      now.motion = std::move(at.motion);
      now.alpha = std::move(at.alpha);
      now.grip = std::move(states);
      now.spin = at.spin;
      now.spin_rate = at.spin_rate;
      now.wheel = to;
      return reached;
    }
    const double ratio = *share == 1.0 ? shares.ratio(found->d) : 0.0;
    if (ratio > 0.0) {
      at.motion.x -= ratio / (1.0 - ratio) * found->d;
      if (const Status done = evaluate(at, rule, to, false); !done) return done.failure();
    }
    is_old = *share < 1.0 || (before > 0.0 && residual > kSlowInTime * before &&
                              residual > settings.enough * load && work.factors < kMostFactors);
    before = ratio > 0.0 ? 0.0 : residual;  // the sum of a series may be far from its last term
  }
  return Failure{fmt::format(
      "a step of {:.3g} ms is not in equilibrium after {} iterations; residual {:.3g} N, accepted "
      "{:.3g} N",
      1e3 * h,
      std::min(work.iterations, kMostOfStep),
      residual,
      settings.enough * load)};
}

/// Makes two half steps, each of which is halved again if it does not succeed.
Result<TransientForces> RollingTransient::Impl::halves(const WheelMoment& to,
                                                       double h,
                                                       int halvings) {
  const auto make = [&](const WheelMoment& wheel) {
    auto half = step(wheel, 0.5 * h);
    return half || halvings == 1 ? half : halves(wheel, 0.5 * h, halvings - 1);
  };
  const WheelMoment from = now.wheel;
  WheelMoment middle = to;
  middle.of = between(from.of, to.of, 0.5);
  middle.bar_at = 0.5 * (from.bar_at + to.bar_at);
  const auto half = make(middle);
  if (!half) return half;
  auto end = make(to);
  if (!end) return end;
  end->iterations += half->iterations;
  end->factors += half->factors;
  end->passes += half->passes;
  return end;
}

RollingTransient::RollingTransient(FeTire& tire)
    : impl_(std::make_unique<Impl>(
          tire, tire.impl_->elements(), tire.impl_->settings.tread_shape())) {}
RollingTransient::RollingTransient(RollingTransient&&) noexcept = default;
RollingTransient::~RollingTransient() = default;

void RollingTransient::set_history(const LossMaterials& losses, const Inflated& round) {
  impl_->history.reset();
  if (!losses.is_elastic()) impl_->history.emplace(impl_->elements, losses, round);
  impl_->linear.forget();
}

Result<TransientForces> RollingTransient::start(const RollingState& steady,
                                                const RollingTransientSettings& settings) {
  if (!(steady.of.speed > 0.0) || !(steady.of.spin > 0.0))
    return Failure{"a passage begins with a wheel that rolls: expected a speed and a spin above 0"};
  if (steady.of.turn_slip != 0.0)
    return Failure{"a wheel that turns does not roll in time: expected turn slip 0"};
  Impl& of = *impl_;
  of.settings = settings;
  of.bar.reset();
  if (settings.bar) of.bar.emplace(*settings.bar);
  of.pressure = steady.pressure;
  of.load = std::max(1.0, std::abs(steady.forces.force.z()));
  of.linear.forget();
  const Eigen::VectorXd x = of.unknowns.compress(steady.u), still = 0.0 * x;
  of.now.motion = {x, still, still};
  of.now.alpha = steady.alpha;
  of.now.grip = steady.grip;
  of.now.spin = steady.of.spin;
  of.now.spin_rate = 0.0;
  of.now.wheel = {.of = steady.of};
  double longest = 0.0;  // rad, between points of a line
  for (const std::vector<int>& line : of.lines.lines)
    for (std::size_t k = 1; k < line.size(); ++k)
      longest = std::max(longest, of.lines.theta[line[k - 1]] - of.lines.theta[line[k]]);
  of.now.past.emplace(of.linear.instant(steady.of, x), kSlowest * longest / of.now.spin);
  Impl::Iterate at{of.now.motion, of.now.alpha, {}, {}, {}, of.now.spin, 0.0};
  const BossakStep rule(settings.step, settings.rho);
  if (of.history) {
    of.history->start(of.unknowns, {x, of.now.alpha}, of.now.spin);
    of.history->begin_step(settings.step, of.now.spin);
  }
  if (const Status done = of.evaluate(at, rule, of.now.wheel, false); !done) return done.failure();
  return of.forces(at, steady.of, steady.forces);
}

Result<TransientForces> RollingTransient::advance(const WheelMoment& to) {
  Impl& of = *impl_;
  auto whole = of.step(to, of.settings.step);
  if (whole) return whole;
  Impl::State before = of.now;
  if (of.history) before.deviations = of.history->deviations();
  auto end = of.halves(to, of.settings.step, kMostStepsHalved);
  if (end) return end;
  if (of.history) of.history->set_deviations(std::move(before.deviations));
  of.now = std::move(before);
  return end;
}

Eigen::Matrix3Xd RollingTransient::displacements() const {
  return impl_->unknowns.expand(impl_->now.motion.x);
}
Eigen::Matrix3Xd RollingTransient::rates() const {
  return impl_->unknowns.expand(impl_->now.motion.v);
}

}  // namespace latsch::fe_tire
