// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/rolling_transient.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "models/fe_tire/passage/bossak_step.h"
#include "models/fe_tire/passage/halved_step.h"
#include "models/fe_tire/passage/rolling_transient_impl.h"

namespace latsch::fe_tire {
namespace {

constexpr int kMostOfStep = 20;  // iterations
/// Share of the residual before above which the tangent is renewed.
constexpr double kSlowInTime = 0.85;
constexpr int kMostFactors = 4;       // factorizations of one step
constexpr int kMostSharesHalved = 4;  // halvings of an iteration that inverts elements
/// Least load to which residuals are relative, in pressures on a square as wide as the tread: a
/// tire that starts in the air carries none.
constexpr double kLeastLoad = 0.1;
/// Share of the tread that may touch up to which the ground may reach.
constexpr double kReachOfGround = 0.97;
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

/// Computes g at the unknowns of the iterate, and the tangent if asked for.
Status RollingTransient::Impl::evaluate(Iterate& at,
                                        const BossakStep& rule,
                                        const WheelMoment& to,
                                        bool with_tangent) {
  AssembledState state{at.motion.x, at.alpha};
  int worst = 0;
  if (history) history->update_step(unknowns, state);
  const RingElements& by = history ? history->elements() : elements;
  if (!assembly.assemble(by, state, now.pressure, at.f, with_tangent ? &K : nullptr, &worst))
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
  if (!to.turning.isZero(0.0) || !to.turning_rate.isZero(0.0)) a += of_turning(at, to);
  at.inertia = inertia.forces(
      {unknowns.expand(at.motion.x), unknowns.expand(at.motion.v), a, at.spin, at.spin_rate});
  at.g = at.f + unknowns.compress(at.inertia.at_nodes);
}

/// Returns the accelerations of all nodes that follow from the rotation of the wheel's axes, m/s^2,
/// in sector frames.
Eigen::Matrix3Xd RollingTransient::Impl::of_turning(const Iterate& at,
                                                    const WheelMoment& to) const {
  const Mesh& mesh = unknowns.ring().mesh();
  const int n = mesh.nodes_per_sector();
  const Eigen::Matrix3Xd u = unknowns.expand(at.motion.x), v = unknowns.expand(at.motion.v);
  Eigen::Matrix3Xd a(3, u.cols());
  for (int s = 0; s < mesh.sectors; ++s) {
    const Eigen::Matrix3d frame = mesh.frame(s), back = frame.transpose();
    const Eigen::Vector3d w = back * to.turning, rate = back * to.turning_rate;
    const Eigen::Vector3d axle = back * Eigen::Vector3d::UnitY();
    for (int k = 0; k < n; ++k) {
      const Eigen::Vector3d x = mesh.X.col(k) + u.col(s * n + k);
      const Eigen::Vector3d passing = at.spin * axle.cross(x) + v.col(s * n + k);
      a.col(s * n + k) = rate.cross(x) + w.cross(w.cross(x)) + 2.0 * w.cross(passing);
    }
  }
  return a;
}

/// Evaluates the iterate, and factorizes its tangent.
Status RollingTransient::Impl::renew(Iterate& at, const BossakStep& rule, const WheelMoment& to) {
  if (const Status done = evaluate(at, rule, to, true); !done) return done;
  K.add(rule.of_mass(), M);
  K.add(-at.spin * at.spin, W);
  factored.reset();
  if (!linear.factorize(K))
    return Failure{"the tangent of a step is not positive definite: expected a shorter step"};
  factored = std::make_shared<const numerics::SymmetricMatrix>(K);
  factored_step = rule.h;
  return {};
}

/// Makes the factorization with which the present state goes on.
Status RollingTransient::Impl::use_tangent() {
  if (factored && factored == now.tangent) return {};
  forget();
  if (!now.tangent) return {};
  if (!linear.factorize(*now.tangent))
    return Failure{"the tangent of a step is not positive definite: expected a shorter step"};
  factored = now.tangent;
  factored_step = now.factored_step;
  return {};
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
  return wheel.sum(at.spin, -found.forces.drive - at.inertia.moment.y()) / wheel.inertia;
}

TransientForces RollingTransient::Impl::forces(const Iterate& at,
                                               const RollingCase& of,
                                               const RollingForces& ground) const {
  TransientForces found = on_hub(of, ground, at.inertia.force, at.inertia.moment);
  found.spin = at.spin;
  found.spin_rate = at.spin_rate;
  return found;
}

double RollingTransient::Impl::reach() const {
  return kReachOfGround * unknowns.ring().mesh().outer_radius() * std::sin(touching);
}

/// One step of Newton's method after the other, up to the equilibrium at the end of the step.
Result<TransientForces> RollingTransient::Impl::step(const WheelMoment& to, double h) {
  const BossakStep rule(h, settings.rho);
  RollingCase of = case_of(to);
  Iterate at{{rule.predicted(now.motion), {}, {}}, now.alpha, {}, {}, {}, of.spin, 0.0};
  const auto set_spin = [&](double rate) {
    at.spin_rate = rate;
    at.spin = now.spin + 0.5 * h * (now.spin_rate + rate);
  };
  if (to.wheel)
    set_spin(now.spin_rate);
  else
    at.spin_rate = (of.spin - now.spin) / h;
  const auto ground = to.ground ? to.ground->below(to.place) : nullptr;
  const PassingMoment moment{*now.past, h, ground.get(), to.place};
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
                              now.load,
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
    of.height = found->of.height;
    const auto share = move(at, rule, to, *found);
    if (!share) return share.failure();
    const double spin = at.spin;
    if (to.wheel) {
      set_spin(spin_rate_of(at, *to.wheel, *found));
      add_inertia(at, rule, to);
    }
    residual = (at.g - found->c).norm();
    if (*share == 1.0 && residual <= settings.enough * now.load &&
        std::abs(at.spin - spin) <= kSpinSettled * std::abs(spin)) {
      if (const Status within = check_reach(found->patch, reach(), touching); !within)
        return within.failure();
      if (const Status rolls = check_spin(at.spin, now.first_spin); !rolls) return rolls.failure();
      TransientForces reached = forces(at, of, found->forces);
      reached.iterations = work.iterations;
      reached.factors = work.factors;
      reached.passes = work.passes;
      reached.patch = std::move(found->patch);
      if (history) history->end_step();
      now.past->add(std::move(found->instant), h);
      now.motion = std::move(at.motion);
      now.alpha = std::move(at.alpha);
      now.grip = std::move(states);
      now.spin = at.spin;
      now.spin_rate = at.spin_rate;
      now.wheel = to;
      now.wheel.of.height = of.height;
      now.wheel.ground = nullptr;  // it may not outlive this call
      now.tangent = factored;
      now.factored_step = factored_step;
      return reached;
    }
    const double ratio = *share == 1.0 ? shares.ratio(found->d) : 0.0;
    if (ratio > 0.0) {
      at.motion.x -= ratio / (1.0 - ratio) * found->d;
      if (const Status done = evaluate(at, rule, to, false); !done) return done.failure();
    }
    is_old = *share < 1.0 || (before > 0.0 && residual > kSlowInTime * before &&
                              residual > settings.enough * now.load && work.factors < kMostFactors);
    before = ratio > 0.0 ? 0.0 : residual;  // the sum of a series may be far from its last term
  }
  return Failure{fmt::format(
      "a step of {:.3g} ms is not in equilibrium after {} iterations; residual {:.3g} N, accepted "
      "{:.3g} N",
      1e3 * h,
      std::min(work.iterations, kMostOfStep),
      residual,
      settings.enough * now.load)};
}

RollingTransient::RollingTransient(FeTire& tire, double touching)
    : impl_(std::make_unique<Impl>(
          tire, tire.impl_->elements(), tire.impl_->settings.tread_shape(), touching)) {}
RollingTransient::RollingTransient(RollingTransient&&) noexcept = default;
RollingTransient::~RollingTransient() = default;

void RollingTransient::set_history(const LossMaterials& losses, const Inflated& round) {
  impl_->history.reset();
  if (!losses.is_elastic()) impl_->history.emplace(impl_->elements, losses, round);
  impl_->forget();
}

Result<TransientForces> RollingTransient::start(const RollingState& steady,
                                                const RollingTransientSettings& settings) {
  if (!(steady.of.speed > 0.0) || !(steady.of.spin > 0.0))
    return Failure{"a passage begins with a wheel that rolls: expected a speed and a spin above 0"};
  Impl& of = *impl_;
  of.settings = settings;
  of.now = {};
  of.now.pressure = steady.pressure;
  const double width = 2.0 * half_width();
  of.now.load =
      std::max(kLeastLoad * steady.pressure * width * width, std::abs(steady.forces.force.z()));
  of.now.first_spin = steady.of.spin;
  of.forget();
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
  TransientForces begun = of.forces(at, steady.of, steady.forces);
  begun.patch = steady.patch;
  return begun;
}

Result<TransientForces> RollingTransient::advance(const WheelMoment& to) {
  return advance(to, impl_->settings.step);
}

Result<TransientForces> RollingTransient::advance(const WheelMoment& to, double step) {
  Impl& of = *impl_;
  if (const Status done = of.use_tangent(); !done) return done.failure();
  auto whole = of.step(to, step);
  if (whole) return whole;
  TransientState before = state();
  const auto part = [&](const WheelMoment& wheel, double h) { return of.step(wheel, h); };
  auto end = in_halves(part, of.now.wheel, to, step);
  if (!end) resume(std::move(before));
  return end;
}

const TransientState& RollingTransient::state() const {
  if (impl_->history) impl_->now.history = impl_->history->memory();
  return impl_->now;
}

TransientState RollingTransient::take() {
  (void)state();
  return std::exchange(impl_->now, {});
}

void RollingTransient::resume(TransientState state) {
  if (impl_->history) impl_->history->set_memory(std::move(state.history));
  state.history = {};
  impl_->now = std::move(state);
}

double RollingTransient::touching() const { return impl_->touching; }

double RollingTransient::half_width() const {
  double most = 0.0;
  for (const TreadSurface::Place& place : impl_->tread.places())
    most = std::max(most, std::abs(place.X.y()));
  return most;
}

Eigen::Matrix3Xd RollingTransient::displacements() const {
  return impl_->unknowns.expand(impl_->now.motion.x);
}
Eigen::Matrix3Xd RollingTransient::rates() const {
  return impl_->unknowns.expand(impl_->now.motion.v);
}

}  // namespace latsch::fe_tire
