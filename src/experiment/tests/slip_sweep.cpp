// SPDX-License-Identifier: Apache-2.0
// kind = "slip_sweep": the belt of a flat track (rigs/slip/flat_track.h) below a wheel that is
// steered or braked.
//
// The keys are in experiment/tests/keys/slip_sweep_keys.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/language/test_words.h"
#include "experiment/rigs/drum_rig.h"
#include "experiment/rigs/duration_limit.h"
#include "experiment/rigs/slip/flat_track.h"
#include "experiment/rigs/slip/lift_watch.h"
#include "experiment/rigs/slip/relaxation.h"
#include "experiment/rigs/wheel_scheme.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

/// Reads [from, to]; both are 0 if the key is missing.
std::array<double, 2> ends(const Node& root, const char* key, const char* unit, Range range) {
  if (!root.has(key)) return {0.0, 0.0};
  const std::vector<double> values = root.quantities(key, unit, range);
  if (values.size() != 2) root.reject(key, "expected two values, from and to");
  return {values[0], values[1]};
}

/// Returns every n-th sample, beginning with the n-th.
Channels thinned(const Channels& all, long every) {
  Channels kept;
  for (Channel channel : all.all()) {
    std::vector<double> values;
    for (std::size_t i = every - 1; i < channel.values.size(); i += every)
      values.push_back(channel.values[i]);
    channel.values = std::move(values);
    kept.add(std::move(channel));
  }
  return kept;
}

class SlipSweepTest : public Test, public TellsLimits {
 public:
  SlipSweepTest(const SlipSweep& sweep, double sample_step)
      : sweep_(sweep), sample_step_(sample_step) {}

  std::string in_words() const override {
    const SlipSweep& s = sweep_;
    const bool side = s.alpha_from != s.alpha_to;
    return fmt::format(
        "flat track, {:.4g} km/h, {:.4g} N{}{}, {}",
        s.speed * 3.6,
        s.load,
        cambered(s.camber),
        inflated(s.pressure),
        side ? fmt::format("alpha {} to {}", degrees(s.alpha_from), degrees(s.alpha_to))
             : fmt::format("kappa {:g} to {:g}", s.kappa_from, s.kappa_to));
  }

  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels = {{"time", "s"}, {"alpha", "rad"}, {"kappa", "1"}};
    for (ChannelInfo& force : force_channels(sweep_.frames)) channels.push_back(std::move(force));
    channels.push_back({"loaded_radius", "m"});
    return channels;
  }

  std::vector<std::string> needs() const override { return kSlipSweepTest.needs; }

  std::optional<Reach> reach(const std::string& channel) const override {
    if (channel != "time") return std::nullopt;
    const auto steps = [&](double time) { return std::lround(time / sweep_.step); };
    const long every = steps(sample_step_);
    const long before = steps(sweep_.run_in) + steps(0.5 * sweep_.run_in);
    const auto time = [&](long i) { return static_cast<double>(before + i) * sweep_.step; };
    return Reach{time(every), time(steps(sweep_.duration) / every * every)};
  }

  Result<Channels> run(Specimen& specimen) const override {
    LiftLog lifts;
    auto channels =
        experiment::run(*watched(specimen.find<Rolls>()->tire(sweep_.pressure), lifts), sweep_);
    if (!channels) return channels;
    record_limit(specimen, lifts.sentence());
    return thinned(*channels, std::lround(sample_step_ / sweep_.step));
  }

  std::vector<std::string> limits(Specimen& specimen) const override {
    std::vector<std::string> limits = limits_of_model(specimen);
    DrivenWheel driven = {{"Fz", {sweep_.load, sweep_.load}},
                          {"gamma", {sweep_.camber, sweep_.camber}},
                          {"alpha", std::minmax(sweep_.alpha_from, sweep_.alpha_to)},
                          {"kappa", std::minmax(sweep_.kappa_from, sweep_.kappa_to)},
                          {"speed", {sweep_.speed, sweep_.speed}}};
    if (sweep_.pressure) driven["p"] = {*sweep_.pressure, *sweep_.pressure};
    for (std::string& limit : limits_of_driven(specimen, driven))
      limits.push_back(std::move(limit));
    return limits;
  }

  /// Returns a sentence if the sweep is too short for the tire to follow it.
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    double most = 0.0;  // N
    const auto see = [&](const Channels& channels) {
      for (const ChannelInfo& force : force_channels(sweep_.frames))
        if (force.name.starts_with(sweep_.alpha_from != sweep_.alpha_to ? "Fy" : "Fx"))
          for (const double F : channels[force.name]) most = std::max(most, std::abs(F));
      tell(channels);
    };
    auto notes = Test::run_in_blocks(specimen, see);
    if (!notes) return notes;
    for (std::string& limit : limits_of_model(specimen)) notes->push_back(std::move(limit));
    const auto tire = specimen.find<Rolls>()->tire(sweep_.pressure);
    const auto lag = relaxation(*tire, sweep_);
    if (!lag) return notes;  // the sweep itself has succeeded, so a failure here is not reported
    if (std::string text = lag_in_words(*lag, sweep_, most); !text.empty())
      notes->push_back(std::move(text));
    return notes;
  }

 private:
  /// Returns the limits that a run does not report by itself. A run reports ranges that it left.
  std::vector<std::string> limits_of_model(Specimen& specimen) const {
    std::vector<std::string> limits = limits_of_camber(specimen, sweep_.camber, /*rolls=*/true);
    for (std::string& assumed : specimen.find<Rolls>()->assumed_in_time())
      limits.push_back(std::move(assumed));
    return limits;
  }

  SlipSweep sweep_;
  double sample_step_;  // s
};

std::unique_ptr<Test> read_slip_sweep(const Node& root, const TestSource& source) {
  SlipSweep sweep;
  const auto speed = find_measured(root, "speed"), load = find_measured(root, "load");
  sweep.speed = speed ? measured_mean(*speed, {"Vx", "m/s"}, source.measured)
                      : root.quantity("speed", "m/s", Range::between(0.1, 200.0));
  sweep.load = load ? measured_mean(*load, {"Fz", "N", true, "W"}, source.measured)
                    : root.quantity("load", "N", Range::positive());
  sweep.pressure = read_pressure(root, source.measured);
  sweep.camber = root.quantity("camber", "rad", Range::between(-0.5, 0.5), 0.0);
  if (root.choice("axle", {"load", "height"}, "load") == "height") sweep.axle = AxleHold::height;
  sweep.frames = read_frames(root, sweep.frames);
  if (root.has("alpha") == root.has("kappa"))
    root.reject("alpha", "or kappa is required, exactly one of the two");
  const auto alpha = ends(root, "alpha", "rad", Range::between(-1.0, 1.0));
  const auto kappa = ends(root, "kappa", "1", Range::between(-1.0, 1.0));
  sweep.alpha_from = alpha[0];
  sweep.alpha_to = alpha[1];
  sweep.kappa_from = kappa[0];
  sweep.kappa_to = kappa[1];
  sweep.run_in = root.quantity("run_in", "s", Range::positive(), sweep.run_in);
  sweep.duration = root.quantity("duration", "s", Range::positive(), sweep.duration);
  sweep.step = root.quantity("step", "s", Range::between(kShortestStep, 0.01), sweep.step);
  check_step(root, sweep.speed, sweep.step);
  check_duration(root, "run_in", sweep.run_in, sweep.step);
  check_duration(root, "duration", sweep.duration, sweep.step);
  const double sample_step = root.quantity("sample_step", "s", {0.0, 1.0, true}, sweep.step);
  const double ratio = sample_step / sweep.step;
  if (std::abs(ratio - std::round(ratio)) > 1e-6 || ratio < 0.5)
    root.reject("sample_step", "is no multiple of step");
  if (2.0 * sample_step > sweep.duration)
    root.reject("sample_step",
                fmt::format("leaves less than two samples of {:.4g} s: expected a shorter one",
                            sweep.duration));
  return std::make_unique<SlipSweepTest>(sweep, sample_step);
}

}  // namespace

const KeySection& slip_sweep_keys();

const TestKind kSlipSweepTest = {"slip_sweep",
                                 "is steered or braked on a flat track",
                                 {Rolls::kName},
                                 read_slip_sweep,
                                 slip_sweep_keys,
                                 kWheelScheme};

}  // namespace latsch::experiment
