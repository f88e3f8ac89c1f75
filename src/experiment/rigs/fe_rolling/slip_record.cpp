// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/slip_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "experiment/rigs/fe_rolling/free_radii.h"
#include "experiment/rigs/fe_rolling/patch_limits.h"
#include "experiment/rigs/fe_rolling/rolling_table.h"
#include "experiment/rigs/fe_rolling/steady_table.h"
#include "experiment/rigs/slip/slip_lag.h"
#include "experiment/rigs/slip/slip_states.h"
#include "models/fe_tire/passage/reduced_states.h"
#include "models/fe_tire/passage/tire_in_time.h"

namespace latsch::experiment {
namespace {

/// Share of vibrations that is left after each step.
constexpr double kLeftOfVibration = 0.3;
/// Largest difference of a sample's pressure from the mean, relative.
constexpr double kPressureVaries = 0.05;
/// Samples that are passed on together.
constexpr std::size_t kSamplesTogether = 20;
/// CPU time of a step for each unknown of a full tire, s, and of a reduced one; measured on tire B
/// (22,194 unknowns).
constexpr double kCostOfUnknown = 1e-5, kCostOfReduced = 0.08;
/// Distance of samples, m of road, above which the remarks say how they are joined.
constexpr double kSparse = 0.3;
/// Change of the height by which a reduced tire is compared, m.
constexpr double kComparedHeight = 2e-3;
/// Accepted difference of a time from that of a step, relative to the step.
constexpr double kSameTime = 1e-6;

/// A table in time as the rig drives it.
struct SlipRecord {
  std::vector<double> times;  // s
  std::vector<RollingRow> rows;
  std::vector<bool> begins;  // true for the first sample of a stretch
  double pressure = 0.0;     // Pa
  double step = 0.0;         // s, of time
  double spacing = 0.0;      // s, median distance of samples
  long steps = 0;            // in all stretches together
  double speed = 0.0;        // m/s, the fastest
};

double median_step(const std::vector<double>& times, const std::vector<bool>& begins) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!begins[i]) steps.push_back(times[i] - times[i - 1]);
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + std::ssize(steps) / 2;
  std::ranges::nth_element(steps, middle);
  return *middle;
}

/// Returns the mean pressure, Pa. Throws InputError for a sample far from it.
double mean_pressure(const formats::CsvTable& table,
                     const std::vector<RollingRow>& rows,
                     double own) {
  if (!rows.front().pressure) return own;
  double mean = 0.0;
  for (const RollingRow& row : rows) mean += *row.pressure / static_cast<double>(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::abs(*rows[i].pressure / mean - 1.0) > kPressureVaries)
      throw InputError(
          table.place(static_cast<int>(i)),
          fmt::format("p is {}, and the mean of the record is {}: a tire that rolls in time keeps "
                      "one pressure; expected records of one pressure each",
                      format_quantity(*rows[i].pressure, "bar", 4),
                      format_quantity(mean, "bar", 4)));
  return mean;
}

SlipRecord read_record(const formats::CsvTable& table,
                       const SlipHistoryConditions& conditions,
                       double own_pressure) {
  if (conditions.friction == 0.0)
    throw InputError(
        "the friction of a slip_history is 0: no force follows a slip on frictionless ground; "
        "expected friction above 0");
  TableReading reading;
  if (values_of(table, "Vx").empty()) reading.speed = kAssumedSpeed;
  reading.takes_turn_slip = false;
  reading.is_free_without_kappa = false;
  reading.is_record = true;
  SlipRecord record;
  record.times = table.numbers("time", "s");
  record.rows = rows_of(table, reading);
  record.begins = gaps_of(record.times);
  record.pressure = mean_pressure(table, record.rows, own_pressure);
  record.speed = fastest(record.rows);
  record.spacing = median_step(record.times, record.begins);
  const double longest = conditions.step.value_or(kWayOfStep / record.speed);
  const double parts = std::max(1.0, std::ceil(record.spacing / longest - kSameTime));
  record.step = record.spacing > 0.0 ? record.spacing / parts : longest;
  for (std::size_t i = 1; i < record.times.size(); ++i)
    if (!record.begins[i])
      record.steps +=
          std::lround(std::ceil((record.times[i] - record.times[i - 1]) / record.step - kSameTime));
  if (record.steps > kMostRecordSteps)
    throw InputError(
        table.header_place(),
        fmt::format("the record takes {} steps of {:.3g} ms ({:.3g} mm of road at {:.4g} km/h), "
                    "expected at most {}, because a finite-element tire takes tenths of a second "
                    "for each: roll through a part of the record, or state a longer `step`",
                    record.steps,
                    1e3 * record.step,
                    1e3 * record.step * record.speed,
                    3.6 * record.speed,
                    kMostRecordSteps));
  return record;
}

/// The drive of the rig at one moment: load N, speed m/s.
struct Drive {
  double load, speed, kappa, tan_alpha, tan_camber;
};

Drive drive_at(const RollingRow& row) {
  return {row.load, row.speed, row.kappa.value_or(0.0), std::tan(row.alpha), std::tan(row.camber)};
}

/// Returns the drive at a time between two samples; behind the later one it stays.
Drive drive_between(const SlipRecord& record, std::size_t later, double time) {
  const double from = record.times[later - 1], to = record.times[later];
  const double share = std::clamp((time - from) / (to - from), 0.0, 1.0);
  const Drive a = drive_at(record.rows[later - 1]), b = drive_at(record.rows[later]);
  const auto mean = [share](double x, double y) { return x + share * (y - x); };
  return {mean(a.load, b.load),
          mean(a.speed, b.speed),
          mean(a.kappa, b.kappa),
          mean(a.tan_alpha, b.tan_alpha),
          mean(a.tan_camber, b.tan_camber)};
}

constexpr std::size_t kRecorded = 11;
constexpr std::pair<const char*, const char*> kChannels[kRecorded] = {{"Fx", "N"},
                                                                      {"Fy", "N"},
                                                                      {"Fz", "N"},
                                                                      {"Mx", "N m"},
                                                                      {"My", "N m"},
                                                                      {"Mz", "N m"},
                                                                      {"R_e", "m"},
                                                                      {"R_l", "m"},
                                                                      {"length", "m"},
                                                                      {"width", "m"},
                                                                      {"omega", "rad/s"}};
/// Values of the channels at one moment.
using Moment = std::array<double, kRecorded>;

Moment moment_of(const fe_tire::RollingForces& forces,
                 const RollingPatch& patch,
                 const fe_tire::RollingCase& of,
                 double free_radius) {
  const Eigen::Vector3d &F = forces.force, &M = forces.moment;
  return {F.x(),
          F.y(),
          F.z(),
          M.x(),
          M.y(),
          M.z(),
          free_radius,
          of.height / std::cos(of.camber),
          patch.length,
          patch.width,
          of.spin};
}

/// Samples that are known and not yet passed on.
class RecordedSamples {
 public:
  explicit RecordedSamples(const std::function<void(const Channels&)>& tell) : tell_(tell) {}

  void add(const Moment& moment) {
    moments_.push_back(moment);
    if (moments_.size() >= kSamplesTogether) pass_on();
  }
  void pass_on() {
    if (moments_.empty()) return;
    Channels block;
    for (std::size_t k = 0; k < kRecorded; ++k) {
      Channel channel{kChannels[k].first, kChannels[k].second, {}};
      for (const Moment& moment : moments_) channel.values.push_back(moment[k]);
      block.add(std::move(channel));
    }
    tell_(block);
    moments_.clear();
  }

 private:
  const std::function<void(const Channels&)>& tell_;
  std::vector<Moment> moments_;
};

/// The tire on its way through a record.
class RecordDrive {
 public:
  RecordDrive(TireRig& rig,
              const SlipRecord& record,
              const fe_tire::Inflated& inflated,
              const SlipHistoryConditions& conditions,
              const std::function<void(const Channels&)>& tell)
      : rig_(rig),
        record_(record),
        inflated_(inflated),
        friction_(friction_by_speed(rig, friction_of(rig, conditions.friction), record.pressure)),
        radii_(record.rows),
        passage_(rig.tire(), fe_tire::kTouchingAngle, reduction_of(rig)),
        samples_(tell) {
    passage_.set_history(rig.losses(), inflated);
  }

  Status roll(const SlipHistoryConditions& conditions, std::vector<std::string>& remarks) {
    RollingTest test{.pressure = record_.pressure, .friction = conditions.friction, .rows = {}};
    test.rows = radii_.wheels();
    std::vector<std::size_t> firsts;
    for (std::size_t i = 0; i < record_.rows.size(); ++i)
      if (record_.begins[i]) {
        firsts.push_back(i);
        test.rows.push_back(record_.rows[i]);
        test.rows.back().pressure.reset();
      }
    const auto states = roll_states(rig_, test);
    if (!states)
      return Failure{"before the record, where free wheels and the first samples are steady: " +
                     states.failure().reason};
    std::vector<double> radii;
    for (std::size_t k = 0; k < radii_.wheels().size(); ++k)
      radii.push_back((*states)[k].effective_radius);
    radii_.set(std::move(radii));
    for (std::size_t k = 0; k < firsts.size(); ++k) {
      const std::size_t end = k + 1 < firsts.size() ? firsts[k + 1] : record_.rows.size();
      const RolledState& steady = (*states)[radii_.wheels().size() + k];
      if (const Status done = stretch(firsts[k], end, steady, remarks); !done) return done;
    }
    samples_.pass_on();
    return {};
  }

 private:
  static std::optional<fe_tire::ReductionSettings> reduction_of(const TireRig& rig) {
    if (!rig.reduced_to()) return std::nullopt;
    return fe_tire::ReductionSettings{.highest = *rig.reduced_to()};
  }

  /// Rolls from a steady state through the samples [first, end).
  Status stretch(std::size_t first,
                 std::size_t end,
                 const RolledState& steady,
                 std::vector<std::string>& remarks) {
    const RollingRow& row = record_.rows[first];
    const auto failed = [&](double time, const std::string& why) {
      return Failure{fmt::format("at {:.6g} s of the record: {}", time, why)};
    };
    // The polynomial is moved to the free wheel of the first sample, so that the spin is steady.
    const double moved = steady.effective_radius - radii_.at(row.load, row.speed, row.camber);
    Moment now = moment_of(
        steady.state.forces, patch_of(steady.state), steady.state.of, steady.effective_radius);
    samples_.add(now);
    if (end == first + 1) return {};
    const auto begun =
        passage_.start(steady.state, {.step = record_.step, .rho = kLeftOfVibration});
    if (!begun) return failed(record_.times[first], begun.failure().reason);
    if (first == 0)
      if (const fe_tire::ReducedTire* reduced = passage_.reduced_tire())
        remarks.push_back(words_on_reduction(steady.state, *reduced));
    double time = record_.times[first], height = steady.state.of.height;
    double tan_camber = std::tan(row.camber);
    const double h = record_.step;
    std::size_t next = first + 1;
    for (long k = 1; next < end; ++k) {
      const double before = time;
      time = record_.times[first] + static_cast<double>(k) * h;
      std::size_t later = next;
      while (later + 1 < end && record_.times[later] < time) ++later;
      const Drive drive = drive_between(record_, later, time);
      const double radius = moved + radii_.at(drive.load, drive.speed, std::atan(drive.tan_camber));
      fe_tire::WheelMoment wheel;
      wheel.of = steady.state.of;
      wheel.of.height = height;
      wheel.of.camber = std::atan(drive.tan_camber);
      // The contact center lies h tan(gamma) beside the point below the wheel center.
      const double beside = height * (drive.tan_camber - tan_camber) / h;
      wheel.of.slip_angle = std::atan(drive.tan_alpha - beside / drive.speed);
      wheel.of.speed = drive.speed / std::cos(wheel.of.slip_angle);
      wheel.of.spin = (1.0 + drive.kappa) * drive.speed / radius;
      wheel.of.friction = friction_(wheel.of.speed);
      wheel.load = drive.load;
      const auto found = passage_.advance(wheel, h);
      if (!found) return failed(time, found.failure().reason);
      height = wheel.of.height = found->height;
      tan_camber = drive.tan_camber;
      const Moment last = now;
      now = moment_of(found->ground, patch_of(found->patch), wheel.of, radius);
      for (; next < end && record_.times[next] <= time + kSameTime * h; ++next) {
        const double share = std::clamp((record_.times[next] - before) / h, 0.0, 1.0);
        Moment at = now;
        if (share < 1.0 - kSameTime)
          for (std::size_t c = 0; c < kRecorded; ++c) at[c] = last[c] + share * (now[c] - last[c]);
        samples_.add(at);
      }
    }
    return {};
  }

  /// Says how far the reduced tire is from the full one, if the wheel is lower or higher.
  std::string words_on_reduction(const fe_tire::RollingState& steady,
                                 const fe_tire::ReducedTire& tire) {
    fe_tire::RollingTire full(rig_.tire());
    full.set_history(rig_.losses(), inflated_);
    const std::string reduced =
        fmt::format("the tire is reduced to {} shapes about the steady state of the first sample",
                    tire.shapes());
    fe_tire::RollingState at = steady;
    at.of.load.reset();
    at.of.drive.reset();
    const auto errors =
        fe_tire::reduced_errors(full, at, tire, {kComparedHeight, -kComparedHeight});
    if (!errors)
      return fmt::format("{}; how far it is from the full tire is not known: {}",
                         reduced,
                         errors.failure().reason);
    return fmt::format(
        "{}: at {:.3g} mm more deflection its load rises by {:.4g} N, that of the full tire by "
        "{:.4g} N ({:+.1f} %), at {:.3g} mm less it falls by {:.4g} N and {:.4g} N ({:+.1f} %)",
        reduced,
        1e3 * kComparedHeight,
        (*errors)[0].reduced,
        (*errors)[0].full,
        100.0 * (*errors)[0].error(),
        1e3 * kComparedHeight,
        -(*errors)[1].reduced,
        -(*errors)[1].full,
        100.0 * (*errors)[1].error());
  }

  TireRig& rig_;
  const SlipRecord& record_;
  const fe_tire::Inflated& inflated_;
  std::function<fe_tire::RollingFriction(double speed)> friction_;
  FreeRadii radii_;
  fe_tire::TireInTime passage_;
  RecordedSamples samples_;
};

}  // namespace

Status roll_record(TireRig& rig,
                   const formats::CsvTable& table,
                   const SlipHistoryConditions& conditions,
                   const std::function<void(const Channels&)>& tell,
                   std::vector<std::string>& remarks) {
  const SlipRecord record = read_record(table, conditions, rig.own_pressure());
  const auto spins = rig.spinning(record.pressure, {record.speed, true});
  if (!spins) return spins.failure();
  const auto& inflated = rig.inflated(record.pressure);
  if (!inflated) return inflated.failure();
  return RecordDrive(rig, record, *inflated, conditions, tell).roll(conditions, remarks);
}

Result<Channels> roll_record(TireRig& rig,
                             const formats::CsvTable& table,
                             const SlipHistoryConditions& conditions,
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
  const Status done = roll_record(rig, table, conditions, collect, remarks);
  if (!done) return done.failure();
  Channels record;
  for (Channel& channel : all) record.add(std::move(channel));
  return record;
}

std::vector<std::string> remarks_on_record(const TireRig& rig,
                                           const formats::CsvTable& table,
                                           const SlipHistoryConditions& conditions) {
  const SlipRecord record = read_record(table, conditions, rig.own_pressure());
  std::vector<std::string> remarks;
  magic_formula::Parameters assumed;
  assumed.LONGVL = kAssumedSpeed;
  assumed.INFLPRES = rig.own_pressure();
  for (const std::string& column : slip_states(table, assumed).unused)
    if (column != "time")
      remarks.push_back(fmt::format("{}: column {} is not used", table.file(), in_quotes(column)));
  if (std::string words = assumed_states(table, assumed); !words.empty())
    remarks.push_back(table.file() + ": " + words);
  if (!conditions.friction)
    remarks.push_back(friction_in_words(rig, record.pressure, record.speed));
  RollingTest test{.pressure = record.pressure, .friction = conditions.friction, .rows = {}};
  test.rows = record.rows;
  if (std::string words = words_on_sectors(rig, test); !words.empty())
    remarks.push_back(std::move(words));
  if (std::string words = gaps_in_words(record.times); !words.empty())
    remarks.push_back(std::move(words));
  const double cost =
      static_cast<double>(record.steps) *
      (rig.reduced_to() ? kCostOfReduced : kCostOfUnknown * rig.tire().mesh().free_dofs());
  remarks.push_back(fmt::format(
      "the rig holds the wheel and moves the ground below it, so alpha changes without turn slip; "
      "the record takes {} steps of {:.3g} ms, {:.3g} mm of road at {:.4g} km/h, and some {:.2g} "
      "{} of CPU; faster vibrations are damped",
      record.steps,
      1e3 * record.step,
      1e3 * record.step * record.speed,
      3.6 * record.speed,
      cost < 90.0 ? cost : cost / 60.0,
      cost < 90.0 ? "s" : "min"));
  if (const double way = record.spacing * record.speed; way > kSparse)
    remarks.push_back(
        fmt::format("samples are {:.2g} m of road apart, about what a tire takes to follow a slip: "
                    "between them all quantities change evenly",
                    way));
  if (rig.losses().is_elastic())
    remarks.emplace_back(
        "Fx and My have no rolling resistance but that of sliding, because no rubber of the tire "
        "has Prony terms or a loss factor");
  return remarks;
}

}  // namespace latsch::experiment
