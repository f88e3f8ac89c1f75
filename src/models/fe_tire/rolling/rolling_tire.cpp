// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_tire.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "models/fe_tire/motion/spin.h"
#include "models/fe_tire/rolling/rolling_tire_impl.h"

namespace latsch::fe_tire {
namespace {

/// Residual of a state, relative to the ground's load.
constexpr double kAccepted = 1e-6;
constexpr int kMostIterations = 25;
/// Share of the residual before above which the tangent is renewed, and above which the iteration
/// is given up. Renewing costs some ten passes over the elements.
constexpr double kSlow = 0.2, kDiverging = 4.0;
/// The former where a history lets Newton's method converge linearly (rolling_history.h): a share
/// that the tangent's age does not explain.
constexpr double kSlowWithHistory = 0.9;
constexpr int kMostWithHistory = 80;
/// Residual, relative to the load, with which the residual of the first iteration is compared in
/// place of the residual before. With a larger value the kept tangent is still used after larger
/// changes of the case.
constexpr double kNearby = 0.1;
/// Most halvings of a step that inverts elements.
constexpr int kMostHalvings = 4;
/// Longest motion of a step, relative to the section height. A longer one turns elements so far
/// that cords, which hardly stretch, spoil the next residual.
constexpr double kLongest = 0.04;
/// Accepted error of load and drive (linear_roller.h) of a state, and of the iterations before.
constexpr double kBalanced = 1e-7, kRoughly = 1e-2;
/// Shortest part of a path, and the longest one that is searched for carefully.
constexpr double kShortestPart = 1.0 / 128.0, kCareful = 1.0 / 8.0;
/// Largest ratio of a step to the one before that is predicted from it, and the largest share of
/// the step that points elsewhere.
constexpr double kFarthest = 2.0, kAside = 0.1;

/// Returns the distance of the tread from the rim, m.
double section_height(const Mesh& mesh) {
  double rim = mesh.outer_radius();
  for (const int node : mesh.clamped)
    rim = std::min(rim, std::hypot(mesh.X(0, node), mesh.X(2, node)));
  return mesh.outer_radius() - rim;
}

/// Returns the numbers of a case that a step changes, of similar effect.
Eigen::Vector<double, 7> numbers(const RollingCase& of, double spin, double load) {
  return {of.slip_angle,
          spin * of.height / of.speed,
          of.camber,
          of.turn_slip * of.height,
          of.curvature * of.height,
          of.speed * of.speed / (9.81 * of.height) * 1e-3,
          load};
}

/// Returns the ratio of the step to a case to the step before; 0 if they differ in direction.
double ratio_of_steps(const RollingState& from, const RollingCase& to) {
  if (from.u_before.size() == 0) return 0.0;
  const auto load = [&](const RollingCase& of) {
    return to.load && of.load && from.of.load ? *of.load / *from.of.load : 1.0;
  };
  const auto at = [&](const RollingCase& of) {
    return numbers(of, to.drive ? 0.0 : of.spin, load(of));
  };
  const Eigen::Vector<double, 7> before = at(from.of) - at(from.of_before),
                                 now = at(to) - at(from.of);
  const double ratio = before.dot(now) / before.squaredNorm();
  const bool is_along = (now - ratio * before).norm() <= kAside * now.norm();
  return is_along && ratio > 0.0 && ratio <= kFarthest ? ratio : 0.0;
}

}  // namespace

RollingTire::Impl::Impl(FeTire& of, const RingElements& with, TreadShape shape, double touching)
    : tire(of),
      elements(with),
      unknowns(with.ring(), RingSymmetry::none, {}),
      tread(unknowns, shape, touching),
      assembly(unknowns),
      lines(tread, with.ring().mesh()),
      K(*assembly.pattern()),
      W(flow_stiffness(assembly, with)),
      w_0(flow_forces(unknowns, with, Eigen::Matrix3Xd::Zero(3, with.ring().mesh().nodes()))),
      linear(assembly, tread, lines),
      longest(kLongest * section_height(with.ring().mesh())) {}

/// Computes g, and renews the tangent if asked for.
Status RollingTire::Impl::evaluate(Iterate& at, double pressure, double spin, bool with_tangent) {
  int worst = 0;
  if (history) history->update(unknowns, at.state, spin);
  const RingElements& by = history ? history->elements() : elements;
  if (!assembly.assemble(by, at.state, pressure, at.g, with_tangent ? &K : nullptr, &worst))
    return Failure{"an element is inverted, " + unknowns.ring().place(worst)};
  Eigen::VectorXd Wu(at.state.x.size());
  W.multiply(at.state.x.data(), Wu.data());
  at.g -= spin * spin * (w_0 + Wu);
  if (!with_tangent) return {};
  K.add(-spin * spin, W);
  if (linear.factorize(K)) return {};
  if (spin == 0.0)
    return Failure{"the tangent of the tire is not positive definite: the tire buckles"};
  return Failure{
      fmt::format("nothing holds the tire that turns at {:.5g} rad/s: a standing wave grows on it, "
                  "or it buckles under its load; expected a lower speed or more pressure",
                  spin)};
}

/// Returns the state from which a case is found: that before, moved on as far as the case is. The
/// height of a case that asks for a load moves along.
Result<RollingTire::Impl::Iterate> RollingTire::Impl::begin(const RollingState& from,
                                                            RollingCase& of) {
  Iterate now{{unknowns.compress(from.u), from.alpha}, {}};
  if (double ratio = ratio_of_steps(from, of); ratio > 0.0) {
    const Eigen::VectorXd step = now.state.x - unknowns.compress(from.u_before);
    ratio = std::min(ratio, longest / std::max(step.cwiseAbs().maxCoeff(), 1e-300));
    Iterate moved{{now.state.x + ratio * step, from.alpha}, {}};
    if (evaluate(moved, from.pressure, of.spin, false).ok()) {
      if (of.load) of.height += ratio * (from.of.height - from.of_before.height);
      return moved;
    }
  }
  if (const Status done = evaluate(now, from.pressure, of.spin, false); !done)
    return done.failure();
  return now;
}

/// Moves to the state found on the linear tire, or a part of the way to it. Returns the part.
Result<double> RollingTire::Impl::advance(Iterate& now,
                                          const LinearRoller::Found& found,
                                          double pressure) {
  double share = std::min(1.0, longest / found.d.cwiseAbs().maxCoeff());
  for (int halving = 0;; ++halving, share *= 0.5) {
    Iterate trial{{now.state.x - share * found.d, now.state.alpha}, {}};
    const Status done = evaluate(trial, pressure, found.of.spin, false);
    if (!done && halving < kMostHalvings) continue;
    if (!done) return done.failure();
    now = std::move(trial);
    return share;
  }
}

/// Solves the linear tire on its ground. If it has no solution with an old tangent, that is
/// renewed.
Result<LinearRoller::Found> RollingTire::Impl::step(
    Iterate& now, const RollingCase& of, double load, double enough, RollingState& state) {
  const bool is_old = linear.has_factor();
  const auto renew = [&] {
    ++state.factors;
    return evaluate(now, state.pressure, of.spin, true);
  };
  if (!is_old)
    if (const Status done = renew(); !done) return done.failure();
  GripState grip = state.grip;
  auto found = linear.solve(of, now.state.x, now.g, load, enough, grip, state.passes);
  if (!found && is_old) {
    if (const Status done = renew(); !done) return done.failure();
    grip = state.grip;
    found = linear.solve(of, now.state.x, now.g, load, enough, grip, state.passes);
  }
  if (found) state.grip = std::move(grip);
  return found;
}

/// True if an equilibrium is one of the history of its own enhanced strains, too: evaluate() takes
/// the history from those of the iterate before.
bool RollingTire::Impl::is_settled(Iterate& now,
                                   const LinearRoller::Found& found,
                                   double accepted,
                                   RollingState& state) {
  if (!history) return true;
  if (!evaluate(now, state.pressure, found.of.spin, false)) return false;
  state.residual = (now.g - found.c).norm();
  return state.residual <= accepted;
}

/// Newton's method for one part of a path.
Result<RollingState> RollingTire::Impl::part(const RollingState& from, const RollingCase& of) {
  RollingState state = from;
  state.iterations = state.factors = state.passes = 0;
  const double load = std::max(of.load.value_or(std::abs(from.forces.force.z())), 1.0);
  RollingCase at = of;
  auto begun = begin(from, at);
  if (!begun) return begun.failure();
  Iterate now = *std::move(begun);
  double before = 0.0, enough = kRoughly;
  for (state.iterations = 1; state.iterations <= (history ? kMostWithHistory : kMostIterations);
       ++state.iterations) {
    const auto found = step(now, at, load, enough, state);
    if (!found) return found.failure();
    const auto share = advance(now, *found, state.pressure);
    if (!share) return share.failure();
    at = between(at, found->of, *share);
    if (*share < 1.0) {
      linear.forget();
      before = 0.0;
      continue;
    }
    state.residual = (now.g - found->c).norm();
    if (state.residual <= kAccepted * load && enough <= kBalanced &&
        is_settled(now, *found, kAccepted * load, state)) {
      state.of = at;
      state.forces = found->forces;
      state.patch = found->patch;
      state.u_before = from.u;
      state.of_before = from.of;
      state.u = unknowns.expand(now.state.x);
      state.alpha = now.state.alpha;
      return state;
    }
    if (before > 0.0 && state.residual > kDiverging * before) break;
    const double slow = history ? kSlowWithHistory : kSlow;
    if (state.residual > slow * (before > 0.0 ? before : kNearby * load)) linear.forget();
    before = state.residual;
    enough = std::clamp(kRoughly * state.residual / load, kBalanced, kRoughly);
  }
  return Failure{
      fmt::format("not in equilibrium after {} iterations; residual {:.3g} N, accepted "
                  "{:.3g} N",
                  std::min(state.iterations, kMostIterations),
                  state.residual,
                  kAccepted * load)};
}

namespace {

Status check(const RollingCase& of) {
  if (!(of.speed > 0.0) || !std::isfinite(of.speed))
    return Failure{fmt::format(
        "the wheel has a speed of {:.4g} m/s: expected one above 0; a tire at rest is pressed",
        of.speed)};
  if (!(of.spin >= 0.0) || !std::isfinite(of.spin))
    return Failure{fmt::format(
        "the wheel turns at {:.4g} rad/s: expected forward rotation or a locked wheel", of.spin)};
  if (!(std::abs(of.slip_angle) < 0.5 * std::numbers::pi))
    return Failure{fmt::format("the slip angle is {:.4g} rad: expected less than a right angle",
                               of.slip_angle)};
  if (!(of.curvature >= 0.0) || !std::isfinite(of.curvature))
    return Failure{
        fmt::format("the drum has a curvature of {:.4g} 1/m: expected one above 0, or 0 "
                    "for flat ground",
                    of.curvature)};
  if (of.curvature > 0.0 && of.turn_slip != 0.0)
    return Failure{"a wheel that turns on a drum has no steady state: expected turn slip 0"};
  if (of.friction.at_rest == 0.0 && of.drive.value_or(0.0) != 0.0)
    return Failure{"frictionless ground carries no torque: expected friction, or a free wheel"};
  return {};
}

/// Fails if the drive asks for a torque that no friction with the ground carries.
Status check_drive(const RollingCase& of, double height) {
  const RollingFriction& friction = of.friction;
  if (!of.drive || !of.load || friction.a > 0.0) return {};
  const double most = friction.at_rest * std::max(1.0, friction.peak) * *of.load * height;
  if (std::abs(*of.drive) <= most) return {};
  return Failure{
      fmt::format("a torque of {:.5g} N m is asked for, and the ground carries at most the largest "
                  "friction times load and height, {:.4g} x {:.5g} N x {:.4g} m = {:.5g} N m: "
                  "expected a smaller one, or a slip in its place",
                  *of.drive,
                  friction.at_rest * std::max(1.0, friction.peak),
                  *of.load,
                  height,
                  most)};
}

/// Says which state of a path was not reached.
Failure not_reached(const RollingCase& at, const std::string& why) {
  return Failure{fmt::format(
      "rolling at {:.5g} m/s, {:.5g} rad/s, slip angle {:.4g} deg, camber {:.4g} deg: {}",
      at.speed,
      at.spin,
      at.slip_angle * 180.0 / std::numbers::pi,
      at.camber * 180.0 / std::numbers::pi,
      why)};
}

}  // namespace

RollingTire::RollingTire(FeTire& tire, double touching)
    : impl_(std::make_unique<Impl>(
          tire, tire.impl_->elements(), tire.impl_->settings.tread_shape(), touching)) {}
RollingTire::~RollingTire() = default;

void RollingTire::set_history(const LossMaterials& losses, const Inflated& round) {
  impl_->history.reset();
  if (!losses.is_elastic()) impl_->history.emplace(impl_->elements, losses, round);
  impl_->linear.forget();
}

void RollingTire::forget() { impl_->linear.forget(); }

RollingState RollingTire::start(const TireState& pressed) {
  assert(!pressed.is_halved);
  RollingState state;
  state.of.height = pressed.pose.height;
  state.of.camber = pressed.pose.camber;
  state.of.friction.at_rest = 0.0;
  state.pressure = pressed.inflated->pressure;
  state.u = pressed.u;
  state.alpha = pressed.alpha;
  state.grip = GripState(static_cast<int>(std::ssize(impl_->tread.points())));
  state.forces.force = impl_->tire.stand(pressed).force;
  return state;
}

Result<RollingState> RollingTire::roll(const RollingState& from, const RollingCase& of) {
  if (const Status done = check(of); !done) return done.failure();
  if (const Status done = check_drive(of, from.of.height); !done) return done.failure();
  RollingState state = from;
  RollingCase start = from.of;
  if (!(start.speed > 0.0)) {  // a tire at rest begins to roll with the speed and the spin at once
    start.speed = of.speed;
    start.spin = of.spin;
  }
  start.load = from.forces.force.z();
  start.drive = from.forces.drive;
  RollingCase end = of;
  if (of.load) end.height = start.height;
  if (of.drive && !(end.spin > 0.0)) end.spin = start.spin;
  // Points that slid without friction have no direction in which they could begin to slide.
  if (from.of.friction.at_rest == 0.0)
    state.grip = GripState(static_cast<int>(std::ssize(impl_->tread.points())));
  impl_->linear.begin();
  int iterations = 0, factors = 0, passes = 0, parts = 0;
  for (double share = 0.0, step = 1.0; share < 1.0;) {
    const double next = std::min(1.0, share + step);
    RollingCase there = between(start, end, next);
    if (share > 0.0 && of.load) there.height = state.of.height;
    if (share > 0.0 && of.drive) there.spin = state.of.spin;
    impl_->linear.be_careful(step <= kCareful);
    auto found = impl_->part(state, there);
    if (!found) {
      impl_->linear.forget();
      step *= 0.5;
      if (step < kShortestPart || impl_->linear.is_spent())
        return not_reached(there, found.failure().reason);
      continue;
    }
    iterations += found->iterations;
    factors += found->factors;
    passes += found->passes;
    ++parts;
    state = *std::move(found);
    share = next;
    step = std::min(2.0 * step, 1.0 - share);
  }
  state.iterations = iterations;
  state.factors = factors;
  state.passes = passes;
  state.parts = parts;
  state.of.load = of.load;
  state.of.drive = of.drive;
  return state;
}

}  // namespace latsch::fe_tire
