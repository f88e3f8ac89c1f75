// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/cleat_rig.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "experiment/rigs/fe_rolling/ground_friction.h"
#include "experiment/rigs/fe_rolling/patch_limits.h"
#include "experiment/rigs/fe_tire/deflection_for_load.h"
#include "experiment/rigs/hub_frame.h"
#include "models/fe_tire/grip/passing_bar.h"
#include "models/fe_tire/passage/reduced_states.h"
#include "models/fe_tire/passage/tire_in_time.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::experiment {
namespace {

using fe_tire::RollingCase;
using fe_tire::RollingState;

/// First guess of the deflection under a load, relative to the radius.
constexpr double kGuess = 0.05;
/// Share of the deflection by which the effective radius of a first guess is below the free one.
constexpr double kEffectiveShare = 1.0 / 3.0;
/// Speed, m/s, that is so low that a rolling tire is in the state of the standing one.
constexpr double kCreeping = 1e-3;
/// Steps before the cleat is in reach from which a simulation begins.
constexpr long kAhead = 3;
/// Change of the height by which a reduced tire is compared if there is no cleat, m.
constexpr double kOtherHeight = 5e-3;
/// Samples that are passed on together.
constexpr std::size_t kBlock = 20;

/// Returns the length of an element around the tread at the ground, m.
double element_length(const fe_tire::Mesh& mesh) { return mesh.outer_radius() * mesh.angle(1); }

fe_tire::PassingBar::Size bar_of(const fe_tire::Mesh& mesh, const Cleat& cleat) {
  return {.height = cleat.height,
          .length = cleat.length,
          .bevel = cleat.bevel,
          .angle = cleat.angle,
          .smooth = std::max(element_length(mesh), cleat.height)};
}

/// Returns the steady state of the wheel that rolls freely on the smooth drum.
Result<RollingState> steady(TireRig& rig, const fe_tire::Inflated& inflated, const DrumTest& test) {
  const fe_tire::FeTire::Poses any = fe_tire::FeTire::Poses::any;
  fe_tire::RollingTire rolling(rig.tire());
  rolling.set_history(rig.losses(), inflated);
  RollingCase of;
  of.curvature = 2.0 / test.diameter;
  of.camber = test.camber;
  of.friction.at_rest = 0.0;
  of.speed = kCreeping;
  of.spin = kCreeping / inflated.radius;
  std::optional<RollingState> start;
  if (test.load) {
    const auto pressed = load_to_force(
        rig.tire(), inflated, *test.load, kGuess * inflated.radius, {}, {test.camber, any});
    if (!pressed) return pressed.failure();
    start = rolling.start(*pressed);
    of.load = test.load;
  } else {
    const auto pressed =
        press_down(rig.tire(), inflated, {}, {test.camber, any}, {*test.deflection});
    if (!pressed) return pressed.failure();
    start = rolling.start(pressed->back());
    of.height = start->of.height;
  }
  const auto standing = rolling.roll(*start, of);
  if (!standing) return Failure{"at rest on the drum: " + standing.failure().reason};
  RollingCase free = standing->of;
  free.load.reset();
  free.speed = test.speed;
  free.spin =
      test.speed / (inflated.radius - kEffectiveShare * (inflated.radius - standing->of.height));
  free.drive = 0.0;
  free.friction = stable_friction(rig, friction_of(rig, {}), inflated.pressure, test.speed);
  auto rolls = rolling.roll(*start, free);
  if (!rolls) return Failure{"before the cleat: " + rolls.failure().reason};
  if (const Status fits = check_drum(*rolls, 0.5 * test.diameter); !fits) return fits.failure();
  return rolls;
}

/// Returns how much the load of a reduced tire changes beside that of the full one, if the wheel is
/// lower or higher by a length, m, or why this is not known.
std::string error_in_words(TireRig& rig,
                           const fe_tire::Inflated& inflated,
                           const RollingState& steady,
                           const fe_tire::ReducedTire& tire,
                           double length) {
  fe_tire::RollingTire full(rig.tire());
  full.set_history(rig.losses(), inflated);
  const std::string reduced = fmt::format(
      "the tire is reduced to {} shapes about its steady state before the cleat", tire.shapes());
  const auto errors = reduced_errors(full, steady, tire, {length, -length});
  if (!errors)
    return fmt::format(
        "{}; how far it is from the full tire is not known: {}", reduced, errors.failure().reason);
  const auto& lower = (*errors)[0];
  const auto& higher = (*errors)[1];
  return fmt::format(
      "{}: on a wheel that rolls {:.3g} mm lower its load rises by {:.4g} N, that of the full tire "
      "by {:.4g} N ({:+.1f} %), and {:.3g} mm higher it falls by {:.4g} N and {:.4g} N ({:+.1f} %)",
      reduced,
      1e3 * length,
      lower.reduced,
      lower.full,
      100.0 * lower.error(),
      1e3 * length,
      -higher.reduced,
      -higher.full,
      100.0 * higher.error());
}

/// Samples that are known and not yet passed on.
class Samples {
 public:
  Samples(const DrumTest& test, const std::function<void(const Channels&)>& tell)
      : test_(test), tell_(tell), forces_(test.frames) {}

  void add(double time, const fe_tire::TransientForces& found, const WheelMotion& motion) {
    times_.push_back(time);
    forces_.add({found.force, found.moment}, motion);
    spins_.push_back(found.spin);
    if (times_.size() >= kBlock) pass_on();
  }
  void pass_on() {
    if (times_.empty()) return;
    Channels block;
    const std::vector<double> speeds(times_.size(), test_.speed);
    block.add({"time", "s", std::move(times_)});
    forces_.add_to(block);
    block.add({"speed", "m/s", speeds});
    block.add({"wheel_speed", "rad/s", std::move(spins_)});
    tell_(block);
    times_.clear();
    spins_.clear();
    forces_ = ForceRecord(test_.frames);
  }

 private:
  const DrumTest& test_;
  const std::function<void(const Channels&)>& tell_;
  ForceRecord forces_;
  std::vector<double> times_, spins_;
};

Status check_cleat(const fe_tire::Mesh& mesh, const DrumTest& test) {
  if (!test.cleat) return {};
  double rim = mesh.outer_radius();
  for (const int node : mesh.clamped)
    rim = std::min(rim, std::hypot(mesh.X(0, node), mesh.X(2, node)));
  const double section = mesh.outer_radius() - rim;
  if (test.cleat->height < section) return {};
  return Failure{fmt::format(
      "the cleat is {:.4g} mm high and the tire's section {:.4g} mm: the rim would hit it",
      1e3 * test.cleat->height,
      1e3 * section)};
}

}  // namespace

Status cross_cleat(TireRig& rig,
                   const DrumTest& test,
                   const std::function<void(const Channels&)>& tell,
                   std::vector<std::string>& remarks) {
  const fe_tire::Mesh& mesh = rig.tire().mesh();
  if (const Status done = check_cleat(mesh, test); !done) return done;
  const double pressure = test.pressure.value_or(rig.own_pressure());
  if (const auto spins = rig.spinning(pressure, {test.speed, true}); !spins) return spins.failure();
  const auto& inflated = rig.inflated(pressure);
  if (!inflated) return inflated.failure();
  const auto rolls = steady(rig, *inflated, test);
  if (!rolls) return rolls.failure();

  std::optional<fe_tire::ReductionSettings> reduction;
  if (rig.reduced_to()) reduction = {.highest = *rig.reduced_to()};
  fe_tire::TireInTime passage(rig.tire(), fe_tire::kTouchingAngle, reduction);
  passage.set_history(rig.losses(), *inflated);
  fe_tire::RollingTransientSettings settings;
  settings.step = test.step;
  std::optional<fe_tire::GroundWithBar> ground;
  if (test.cleat) ground.emplace(bar_of(mesh, *test.cleat));
  auto now = passage.start(*rolls, settings);
  if (!now) return now.failure();
  if (const fe_tire::ReducedTire* reduced = passage.reduced_tire())
    remarks.push_back(error_in_words(
        rig, *inflated, *rolls, *reduced, test.cleat ? test.cleat->height : kOtherHeight));

  WheelMotion motion;
  motion.center.z() = rolls->of.height;
  motion.carrier = Eigen::AngleAxisd(test.camber, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const double reach = reach_of_cleat(test, inflated->radius, mesh.X.row(1).maxCoeff());
  const auto steps = [&](double time) { return std::lround(time / test.step); };
  const long every = steps(test.sample_step), lead = steps(test.lead);
  const long last = steps(test.duration - test.lead);
  const long first = -std::max(lead, steps(reach / test.speed) + kAhead);
  Samples samples(test, tell);
  fe_tire::WheelMoment wheel;
  wheel.of = rolls->of;
  wheel.ground = ground ? &*ground : nullptr;
  wheel.wheel = fe_tire::SpinningWheel{.inertia = test.wheel_inertia};
  for (long i = first + 1; i <= last; ++i) {
    const double time = static_cast<double>(i) * test.step;
    wheel.place.way.x() = test.speed * time;
    now = passage.advance(wheel, test.step);
    if (!now)
      return Failure{fmt::format("{:.4g} ms {} the cleat is below the axle: {}",
                                 1e3 * std::abs(time),
                                 time < 0.0 ? "before" : "after",
                                 now.failure().reason)};
    motion.spin_rate = now->spin;
    if (i > -lead && (i + lead) % every == 0) samples.add(time, *now, motion);
  }
  samples.pass_on();
  return {};
}

Result<Channels> cross_cleat(TireRig& rig,
                             const DrumTest& test,
                             std::vector<std::string>& remarks) {
  std::vector<Channel> all;
  const auto collect = [&](const Channels& block) {
    if (all.empty()) {
      all = block.all();
      return;
    }
    for (Channel& channel : all) {
      const std::vector<double>& more = block[channel.name];
      channel.values.insert(channel.values.end(), more.begin(), more.end());
    }
  };
  const Status done = cross_cleat(rig, test, collect, remarks);
  if (!done) return done.failure();
  Channels record;
  for (Channel& channel : all) record.add(std::move(channel));
  return record;
}

std::vector<std::string> remarks_on_cleat(const TireRig& rig, const DrumTest& test) {
  const double pressure = test.pressure.value_or(rig.own_pressure());
  std::vector<std::string> remarks = {friction_in_words(rig, pressure, test.speed)};
  if (rig.losses().is_elastic())
    remarks.emplace_back(
        "the tire has no Prony terms and no loss factor, so nothing but friction damps its "
        "vibration after the cleat");
  if (test.cleat) {
    const fe_tire::Mesh& mesh = rig.tire().mesh();
    remarks.push_back(fmt::format(
        "the tread feels the cleat through means over {:.3g} mm to both sides, {}, so its flanks "
        "are slopes of {:.3g} mm; forces depend on this length and on the step (--convergence)",
        1e3 * bar_of(mesh, *test.cleat).smooth,
        test.cleat->height > element_length(mesh)
            ? "the height of the cleat, which is more than an element's length"
            : "the length of an element",
        2e3 * bar_of(mesh, *test.cleat).smooth));
  }
  if (test.passages > 1 || test.wheel_start != 0.0 || test.wheel_step != 0.0)
    remarks.emplace_back(
        "the tire is the same all around, so passages, wheel_start and wheel_step have no effect");
  return remarks;
}

}  // namespace latsch::experiment
