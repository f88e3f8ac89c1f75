// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/fe_rolling_tire.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::fe_tire {
namespace {

/// Speed over the ground below which a wheel stands, m/s.
constexpr double kStands = 0.1;
/// Length of a part of the way down to the road, m.
constexpr double kWayOfPart = 5e-3;
/// Depth to which a tire is pressed from which it begins to roll in the air, and the height over
/// first touch at which it then rolls, m.
constexpr double kBarelyPressed = 1e-4, kLifted = 1e-3;
/// Share of the deflection by which the effective radius of a first guess is below the free one.
constexpr double kEffectiveShare = 1.0 / 3.0;
/// Half of the place below the axle over which the road's friction is a mean, m.
constexpr double kAhead = 0.06, kBeside = 0.04;
/// Accepted error of the force of a free height, relative to the force, and most trials.
constexpr double kBalancedHeight = 2e-4;
constexpr int kMostTrials = 12;

/// The ground below a wheel as a whole.
struct BelowWheel {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // m/s, inertial
  double curvature = 0.0;                              // 1/m, of a smooth drum
  double friction = 1.0;                               // factor
};

/// Returns the velocity of the ground, its friction and the curvature of a smooth drum.
Result<BelowWheel> ground_below(const road::Road& road,
                                const Eigen::Vector3d& center,
                                double radius,
                                double time) {
  constexpr double kBelowAxis = 1e-3;  // m, from the top line of a drum
  BelowWheel below;
  const road::GroundPoint middle = road.at(center.x(), center.y(), time);
  below.velocity = middle.velocity;
  below.friction = 0.0;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      below.friction +=
          road.at(center.x() + i * kAhead, center.y() + j * kBeside, time).friction / 9.0;
  const double half = 0.5 * radius;
  const auto drum =
      road.bounds({center.x() - half, center.x() + half, center.y() - half, center.y() + half},
                  time)
          .cylinder;
  if (drum && drum->up > 0.0)
    return Failure{"a finite-element tire does not roll inside a drum: expected a drum below it"};
  if (drum && std::abs(center.x() - drum->x) > kBelowAxis)
    return Failure{fmt::format(
        "the axle is {:.3g} mm ahead of the drum's: a finite-element tire rolls above it",
        1e3 * (center.x() - drum->x))};
  if (drum)
    below.curvature = 1.0 / drum->radius;
  else if (!middle.turning.isZero(1e-12))
    return Failure{
        "the ground turns below the tire and is not a smooth drum: a finite-element tire crosses "
        "the cleat of a drum in the test drum_cleat"};
  return below;
}

/// Returns the plane that touches the top line of a drum, or the plane of the road.
ReferencePlane reference_plane(const road::Road& road,
                               const Eigen::Vector3d& center,
                               double curvature,
                               double time) {
  if (curvature == 0.0) return plane_below(road, center, time);
  return ReferencePlane::through(
      {center.x(), center.y(), road.height(center.x(), center.y(), time)},
      Eigen::Vector3d::UnitZ());
}

HubForces in_carrier(const WheelMotion& motion,
                     const Eigen::Matrix3d& axes,
                     const Eigen::Vector3d& force,
                     const Eigen::Vector3d& moment) {
  const Eigen::Matrix3d turn = motion.carrier.transpose() * axes;
  return {turn * force, turn * moment};
}

/// Returns the footprint of points in contact.
Footprint footprint_of(const std::vector<RollingPatchPoint>& patch, double load) {
  Footprint print;
  print.load = load;
  double x_least = 1e300, x_most = -1e300, y_least = 1e300, y_most = -1e300;
  for (const RollingPatchPoint& point : patch) {
    FootprintElement element;
    element.x = point.x;
    element.y = point.y;
    element.length = point.length;
    element.width = point.length > 0.0 ? point.area / point.length : 0.0;
    element.pressure = point.pressure;
    element.shear_x = point.shear_x;
    element.shear_y = point.shear_y;
    element.friction = point.pressure > 0.0 ? point.limit / point.pressure : 0.0;
    print.area += point.area;
    x_least = std::min(x_least, element.x - 0.5 * element.length);
    x_most = std::max(x_most, element.x + 0.5 * element.length);
    y_least = std::min(y_least, element.y - 0.5 * element.width);
    y_most = std::max(y_most, element.y + 0.5 * element.width);
    print.elements.push_back(element);
  }
  if (patch.empty()) return print;
  print.length = x_most - x_least;
  print.width = y_most - y_least;
  return print;
}

/// Returns the moment or force besides the tire's on a free motion at a time and a rate.
Push push_of(const FreeRate& free, double time, double rate) {
  return free.push ? free.push(time, rate) : Push{};
}

}  // namespace

/// Everything that takes long to make, and the tire whose state it holds.
struct FeRollingTire::Workspace {
  std::mutex mutex;
  FeTire tire;
  Inflated inflated;
  LossMaterials losses;
  Friction friction;
  FeRollingSettings settings;
  std::unique_ptr<RollingTire> steady;
  std::unique_ptr<TireInTime> transient;
  FeRollingTire* holder = nullptr;

  Workspace(const FeTire& of,
            const SolverSettings& with,
            const Inflated& inflated_tire,
            LossMaterials with_losses,
            Friction with_friction,
            const FeRollingSettings& set)
      : tire(of.mesh(), of.materials(), with),
        inflated(inflated_tire),
        losses(std::move(with_losses)),
        friction(std::move(with_friction)),
        settings(set) {
    if (!(settings.smooth > 0.0))
      settings.smooth = tire.mesh().outer_radius() * tire.mesh().angle(1);
  }

  /// Returns the solver of steady states as new, so that a state does not depend on those before.
  RollingTire& new_steady() {
    if (!steady) steady = std::make_unique<RollingTire>(tire, settings.touching);
    steady->set_history(losses, inflated);
    steady->forget();
    return *steady;
  }
  TireInTime& in_time() {
    if (transient) return *transient;
    transient = std::make_unique<TireInTime>(tire, settings.touching, settings.reduction);
    transient->set_history(losses, inflated);
    return *transient;
  }
  Result<TireState> press(const GroundPose& pose);
};

struct FeRollingTire::Memory {
  enum class Phase { unused, stands, rolls };
  Phase phase = Phase::unused;
  ReferencePlane plane;
  std::optional<TireState> standing;  // none: it stands in the air
  WheelOnPlane wheel;                 // the last one, if it rolls
  RollingFriction friction;           // on a road with the factor 1, of the speed at the start
  double stiffness = 0.0;             // N/m, of the last step at a free height; 0: not known
  TireInTime::State state;            // if the workspace does not hold it
};

/// Presses the tire down from over the road.
Result<TireState> FeRollingTire::Workspace::press(const GroundPose& pose) {
  TireState start = tire.over(inflated, {}, FeTire::Poses::any);
  start.pose.camber = pose.camber;
  // If a shoulder is lower than the crown, the tire would begin inside the ground.
  start.pose.height += inflated.radius * std::abs(std::sin(pose.camber));
  const double way = start.pose.height - pose.height;
  const int parts = std::max(1, static_cast<int>(std::ceil(way / kWayOfPart)));
  std::vector<GroundPose> poses;
  for (int k = 1; k <= parts; ++k)
    poses.push_back(between(start.pose, pose, static_cast<double>(k) / parts));
  auto states = tire.advance(start, poses);
  if (!states) return states.failure();
  return std::move(states->back());
}

FeRollingTire::FeRollingTire(const FeTire& tire,
                             const Inflated& inflated,
                             LossMaterials losses,
                             Friction friction,
                             const FeRollingSettings& settings)
    : workspace_(std::make_shared<Workspace>(
          tire, tire.impl_->settings, inflated, std::move(losses), std::move(friction), settings)),
      memory_(std::make_unique<Memory>()) {}

FeRollingTire::FeRollingTire(const FeRollingTire& other)
    : workspace_(other.workspace_), print_(other.print_) {
  const std::lock_guard lock(workspace_->mutex);
  memory_ = std::make_unique<Memory>(*other.memory_);
  if (workspace_->holder == &other) memory_->state = workspace_->transient->state();
}

FeRollingTire::~FeRollingTire() {
  const std::lock_guard lock(workspace_->mutex);
  if (workspace_->holder == this) workspace_->holder = nullptr;
}

std::unique_ptr<Tire> FeRollingTire::clone() const {
  return std::unique_ptr<Tire>(new FeRollingTire(*this));
}

double FeRollingTire::free_radius() const { return workspace_->inflated.radius; }

/// Lets the workspace hold this tire's state, and gives that of another tire back to it.
void FeRollingTire::hold() {
  Workspace& of = *workspace_;
  if (of.holder == this) return;
  if (of.holder != nullptr) of.holder->memory_->state = of.transient->take();
  of.holder = this;
  if (memory_->phase == Memory::Phase::rolls) of.in_time().resume(std::move(memory_->state));
}

Result<HubForces> FeRollingTire::settle(const WheelMotion& motion,
                                        const road::Road& road,
                                        double time) {
  if (const Status possible = check_motion(motion); !possible) return possible.failure();
  Workspace& of = *workspace_;
  const std::lock_guard lock(of.mutex);
  const auto below = ground_below(road, motion.center, of.inflated.radius, time);
  if (!below) return below.failure();
  const ReferencePlane plane = reference_plane(road, motion.center, below->curvature, time);
  const auto wheel = WheelOnPlane::of_motion(motion, plane, below->velocity, time);
  if (!wheel) return wheel.failure();
  const GroundPose pose{.height = wheel->of.height, .camber = wheel->of.camber};
  Memory next;
  next.phase = Memory::Phase::stands;
  next.plane = plane;
  HubForces hub;
  Footprint print;
  if (pose.height < of.inflated.radius * (1.0 + std::abs(std::sin(pose.camber)))) {
    auto pressed = of.press(pose);
    if (!pressed) return Failure{"pressed on the road: " + pressed.failure().reason};
    const Standing standing = of.tire.stand(*pressed);
    const PosedGround posed({}, pose);
    hub = in_carrier(
        motion, wheel->axes, posed.to_wheel(standing.force), posed.to_wheel(standing.moment));
    print.length = standing.patch.length;
    print.width = standing.patch.width;
    print.area = standing.patch.area;
    print.load = standing.force.z();
    next.standing = std::move(*pressed);
  }
  *memory_ = std::move(next);
  print_ = print;
  if (of.holder == this) of.holder = nullptr;
  return hub;
}

Result<HubForces> FeRollingTire::advance(const WheelMotion& motion,
                                         const road::Road& road,
                                         double time,
                                         double step) {
  WheelMotion there = motion;
  FreeWheel none;
  return advance_free(there, none, road, time, step);
}

Result<HubForces> FeRollingTire::advance_free(
    WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double step) {
  if (const Status possible = check_motion(motion, step); !possible) return possible.failure();
  if (!(step > 0.0))
    return Failure{"a finite-element tire rolls in steps of time: expected a step above 0"};
  for (const auto* free : {&wheel.spin, &wheel.height})
    if (*free && !((*free)->inertia >= 0.0)) return Failure{"a free wheel needs an inertia"};
  if (wheel.spin && !(wheel.spin->inertia > 0.0))
    return Failure{"a finite-element tire needs a wheel with an inertia about its spin axis"};
  const std::lock_guard lock(workspace_->mutex);
  if (memory_->phase == Memory::Phase::unused)
    return Failure{"the tire has not settled: expected settle() before the first step"};
  WheelMotion there = motion;
  FreeWheel next = wheel;
  const auto hub = memory_->phase == Memory::Phase::stands ? begin(there, next, road, time)
                   : wheel.height ? go_on_at_free_height(there, next, road, time, step)
                                  : go_on(there, next, road, time, step);
  if (!hub) return hub;
  motion = there;
  wheel = next;
  return hub;
}

namespace {

Status check_rolls(const WheelOnPlane& wheel) {
  const double ahead = wheel.of.speed * std::cos(wheel.of.slip_angle);
  if (!(ahead > kStands))
    return Failure{fmt::format(
        "the wheel moves forward over the ground at {:.3g} m/s: a finite-element tire rolls in "
        "time above {:g} m/s only; it neither stands in time nor moves backward",
        ahead,
        kStands)};
  if (!(wheel.of.spin > 0.0))
    return Failure{fmt::format(
        "the wheel turns at {:.3g} rad/s: a finite-element tire rolls in time with a spin above 0 "
        "only; a locked wheel has steady states",
        wheel.of.spin)};
  return {};
}

}  // namespace

/// Finds the steady state of the first motion.
Result<HubForces> FeRollingTire::begin(WheelMotion& motion,
                                       FreeWheel& wheel,
                                       const road::Road& road,
                                       double time) {
  Workspace& with = *workspace_;
  const auto below = ground_below(road, motion.center, with.inflated.radius, time);
  if (!below) return below.failure();
  auto at = WheelOnPlane::of_motion(motion, memory_->plane, below->velocity, time);
  if (!at) return at.failure();
  const double free_radius = with.inflated.radius;
  if (wheel.spin) {  // a first guess, if the caller has none
    const double deflection = std::max(0.0, free_radius - at->of.height);
    if (!(at->of.spin > 0.0))
      at->of.spin = at->of.speed / (free_radius - kEffectiveShare * deflection);
  }
  if (const Status rolls = check_rolls(*at); !rolls) return rolls.failure();
  RollingTire& rolling = with.new_steady();
  RollingCase of = at->of;
  of.curvature = below->curvature;
  const RollingFriction friction = with.friction(of.speed);
  of.friction = friction;
  of.friction.at_rest *= below->friction;
  const bool flies =
      !wheel.height && of.height > free_radius * (1.0 + std::abs(std::sin(of.camber)));
  if (wheel.height) {
    const double load = -push_of(*wheel.height, time, 0.0).value;
    if (!(load > 0.0))
      return Failure{fmt::format(
          "the axle's height is free and no load presses it down ({:.4g} N): expected one", load)};
    of.load = load;
  } else if (flies) {
    of.height = free_radius * (1.0 + std::abs(std::sin(of.camber))) + kLifted;
  }
  if (wheel.spin && !flies) {
    const double moment = push_of(*wheel.spin, time, wheel.spin->rate).value;
    of.drive = moment - (of.spin > 0.0 ? wheel.brake : 0.0);
  }
  std::optional<TireState> standing = memory_->standing;
  if (!standing) {
    auto touching = with.press({.height = free_radius - kBarelyPressed});
    if (!touching) return touching.failure();
    standing = std::move(*touching);
  }
  // A wheel that rolls straight ahead and freely comes first, because it is found from rest.
  RollingCase free = of;
  free.slip_angle = free.turn_slip = free.camber = 0.0;
  free.curvature = 0.0;
  if (free.friction.at_rest > 0.0 && !flies) {
    free.drive = 0.0;
    const double deflection = std::max(0.0, free_radius - free.height);
    free.spin = free.speed / (free_radius - kEffectiveShare * deflection);
  } else {
    free.drive.reset();
  }
  if (free.friction.at_rest == 0.0) of.drive.reset();
  auto first = rolling.roll(rolling.start(*standing), free);
  if (!first)
    return Failure{"the steady state from which the tire rolls, straight ahead: " +
                   first.failure().reason};
  auto steady = rolling.roll(*first, of);
  if (!steady)
    return Failure{"the steady state from which the tire rolls: " + steady.failure().reason};
  TireInTime& passage = with.in_time();
  if (with.holder != nullptr && with.holder != this) with.holder->memory_->state = passage.take();
  with.holder = nullptr;
  auto found = passage.begin(*steady, with.settings.transient);
  if (!found) return found.failure();
  with.holder = this;
  if (wheel.height) {
    at->of.height = steady->of.height;
    const Eigen::Vector3d center =
        memory_->plane.point(at->place.way) + steady->of.height * memory_->plane.axes.col(2);
    motion.center.z() = center.z();
    motion.velocity.z() = at->velocity.z() = 0.0;
    wheel.height->place = center.z();
    wheel.height->rate = wheel.height->acceleration = 0.0;
  }
  if (wheel.spin) {
    at->of.spin = steady->of.spin;
    motion.spin_rate = steady->of.spin - at->more_spin;
    wheel.spin->rate = motion.spin_rate;
    wheel.spin->acceleration = 0.0;
  }
  at->of.curvature = below->curvature;
  at->of.friction = of.friction;
  memory_->phase = Memory::Phase::rolls;
  memory_->standing.reset();
  memory_->friction = friction;
  memory_->wheel = *at;
  take(*found);
  return in_carrier(motion, at->axes, found->force, found->moment);
}

void FeRollingTire::take(const TransientForces& found) {
  print_ = footprint_of(found.patch, found.ground.force.z());
  memory_->wheel.of.spin = found.spin;
}

/// Moves on by one step, in parts that are no longer than those of the settings.
Result<HubForces> FeRollingTire::go_on(
    WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double step) {
  Workspace& with = *workspace_;
  const auto below = ground_below(road, motion.center, with.inflated.radius, time);
  if (!below) return below.failure();
  auto to = WheelOnPlane::of_motion(motion, memory_->plane, below->velocity, time);
  if (!to) return to.failure();
  WheelOnPlane from = memory_->wheel;
  if (wheel.spin) to->of.spin = from.of.spin;
  if (const Status rolls = check_rolls(*to); !rolls) return rolls.failure();
  to->of.curvature = below->curvature;
  to->of.friction = memory_->friction;
  to->of.friction.at_rest *= below->friction;
  hold();
  TireInTime& passage = with.in_time();
  const RoadGround ground(road,
                          memory_->plane,
                          {.along = with.inflated.radius * std::sin(passage.touching()),
                           .across = passage.half_width() + with.settings.smooth,
                           .smooth = with.settings.smooth});
  const int parts =
      std::max(1, static_cast<int>(std::ceil(step / with.settings.transient.step - 1e-6)));
  const double h = step / parts;
  std::optional<TireInTime::State> kept;
  if (parts > 1) kept = passage.state();
  Result<TransientForces> found = Failure{""};
  double rate = wheel.spin ? wheel.spin->rate : 0.0;
  double place = wheel.spin ? wheel.spin->place : 0.0;
  const double more_rate = (to->more_spin - from.more_spin) / step;
  for (int part = 1; part <= parts; ++part) {
    const double share = static_cast<double>(part) / parts;
    WheelMoment moment = moment_between(from, *to, share, step);
    moment.ground = below->curvature == 0.0 ? &ground : nullptr;
    if (wheel.spin) {
      const double now = time - (parts - part) * h, guess = rate;
      const Push push = push_of(*wheel.spin, now, guess);
      const double I = wheel.spin->inertia;
      const double more = from.more_spin + share * (to->more_spin - from.more_spin);
      moment.wheel = SpinningWheel{.inertia = I,
                                   .moment = push.value + I * more_rate,
                                   .by_spin = push.by_rate,
                                   .by_spin_at = guess + more,
                                   .brake = wheel.brake};
    }
    found = passage.advance(moment, h);
    if (!found) {
      if (kept) passage.resume(std::move(*kept));
      return found.failure();
    }
    if (wheel.spin) {
      const double more = from.more_spin + share * (to->more_spin - from.more_spin);
      const double next = found->spin - more;
      place += 0.5 * h * (rate + next);
      rate = next;
    }
  }
  if (wheel.spin) {
    to->of.spin = found->spin;
    motion.spin_rate = rate;
    motion.spin = place;
    wheel.spin->rate = rate;
    wheel.spin->place = place;
    wheel.spin->acceleration = found->spin_rate - more_rate;
  }
  memory_->wheel = *to;
  take(*found);
  return in_carrier(motion, to->axes, found->force, found->moment);
}

/// Finds the height of an axle at which the step ends in balance, by the secant method.
Result<HubForces> FeRollingTire::go_on_at_free_height(
    WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double step) {
  hold();
  TireInTime& passage = workspace_->in_time();
  const TireInTime::State kept = passage.state();
  const WheelOnPlane from = memory_->wheel;
  const auto print = print_;
  FreeWheel axle;
  axle.height = wheel.height;
  FreeWheel::Pair rates = axle.guess(step), last_rates = rates, last = FreeWheel::Pair::Zero();
  for (int trial = 0; trial < kMostTrials; ++trial) {
    if (trial > 0) passage.resume(kept);
    memory_->wheel = from;
    WheelMotion there = axle.moved(motion, step, rates);
    FreeWheel spins = wheel;
    const auto hub = go_on(there, spins, road, time, step);
    if (!hub) {
      passage.resume(kept);
      memory_->wheel = from;
      print_ = print;
      return hub;
    }
    const FreeWheel::Pair of_tire = FreeWheel::forces(*hub, there);
    const double left = axle.left(time, step, rates, of_tire)[1];
    if (std::abs(left) <= kBalancedHeight * (1.0 + hub->force.norm())) {
      const FreeWheel after = axle.after(time, step, rates, of_tire);
      wheel.spin = spins.spin;
      wheel.height = after.height;
      motion = there;
      return hub;
    }
    const double way = 0.5 * step * (rates[1] - last_rates[1]);
    if (trial > 0 && way != 0.0) memory_->stiffness = -(of_tire[1] - last[1]) / way;
    last_rates = rates;
    last = of_tire;
    FreeWheel::Matrix stiffness = FreeWheel::Matrix::Zero();
    stiffness(1, 1) = std::max(0.0, memory_->stiffness);
    const auto next = axle.balanced(time, step, rates, of_tire, stiffness);
    if (!next || !next->allFinite()) break;
    rates = *next;
  }
  passage.resume(kept);
  memory_->wheel = from;
  print_ = print;
  return Failure{fmt::format(
      "no height of the free axle was found in the step to {:.5f} s; a shorter step may help",
      time)};
}

}  // namespace latsch::fe_tire
