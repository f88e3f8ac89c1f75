// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/rolling_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "base/units.h"
#include "experiment/rigs/slip_states.h"

namespace latsch::experiment {
namespace {

constexpr std::array<const char*, 4> kDirections = {
    "vertical", "longitudinal", "lateral", "torsional"};

/// [from, to]; both 0 where the key is missing.
std::array<double, 2> ends(const Node& root, const char* key, const char* unit, Range range) {
  if (!root.has(key)) return {0.0, 0.0};
  const std::vector<double> values = root.quantities(key, unit, range);
  if (values.size() != 2) root.reject(key, "expected two values, from and to");
  return {values[0], values[1]};
}

SampledSweep read_slip_sweep(const Node& root) {
  root.choice("kind", {"slip_sweep"});
  SampledSweep test;
  SlipSweep& sweep = test.sweep;
  sweep.speed = root.quantity("speed", "m/s", Range::positive());
  sweep.load = root.quantity("load", "N", Range::positive());
  sweep.camber = root.quantity("camber", "rad", Range::between(-0.5, 0.5), 0.0);
  if (root.choice("axle", {"load", "height"}, "load") == "height") sweep.axle = Axle::height;
  sweep.frame = read_frame(root, sweep.frame);
  if (root.has("alpha") == root.has("kappa"))
    root.reject("alpha", "or kappa has to be there, one of the two");
  const auto alpha = ends(root, "alpha", "rad", Range::between(-1.0, 1.0));
  const auto kappa = ends(root, "kappa", "1", Range::between(-1.0, 1.0));
  sweep.alpha_from = alpha[0];
  sweep.alpha_to = alpha[1];
  sweep.kappa_from = kappa[0];
  sweep.kappa_to = kappa[1];
  sweep.run_in = root.quantity("run_in", "s", Range::positive(), sweep.run_in);
  sweep.duration = root.quantity("duration", "s", Range::positive(), sweep.duration);
  sweep.step = root.quantity("step", "s", {0.0, 0.01, true}, sweep.step);
  test.sample_step = root.quantity("sample_step", "s", {0.0, 1.0, true}, sweep.step);
  const double ratio = test.sample_step / sweep.step;
  if (std::abs(ratio - std::round(ratio)) > 1e-6 || ratio < 0.5)
    root.reject("sample_step", "is no multiple of step");
  root.close();
  return test;
}

StaticTest read_static_test(const Node& root) {
  root.choice("kind", {"static_stiffness"});
  StaticTest test;
  if (root.has("deflections"))
    test.deflections = root.quantities("deflections", "m", Range::positive());
  if (root.has("load")) {
    test.load = root.quantity("load", "N", Range::positive());
    std::vector<std::string> names(kDirections.begin(), kDirections.end());
    if (root.has("directions")) names = root.texts("directions");
    for (const std::string& name : names) {
      const auto known = std::find(kDirections.begin(), kDirections.end(), name);
      if (known == kDirections.end())
        root.reject("directions",
                    "has " + in_quotes(name) +
                        R"(, expected "vertical", "longitudinal", "lateral" or "torsional")");
      test.directions.push_back(static_cast<Direction>(known - kDirections.begin()));
    }
  }
  if (test.deflections.empty() == test.directions.empty())
    root.reject("deflections", "or load with directions has to be there, one of the two");
  root.close();
  return test;
}

SteadyStates read_steady_states(const Node& root, const std::filesystem::path& folder) {
  root.choice("kind", {"steady_states"});
  const auto file = folder / root.text("states");
  root.close();
  return {formats::CsvTable::read(file)};
}

/// Every n-th sample from the n-th on.
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

Result<Channels> run(Tire& tire, const SampledSweep& test) {
  auto channels = run(tire, test.sweep);
  if (!channels) return channels;
  return thinned(*channels, std::lround(test.sample_step / test.sweep.step));
}

Result<Channels> run(Tire& tire, const StaticTest& test) {
  Channels channels;
  if (!test.deflections.empty()) {
    Channel deflection{"deflection", "m", test.deflections}, force{"force", "N", {}};
    for (const double d : test.deflections) {
      const auto load = load_at(tire, d);
      if (!load) return load.failure();
      force.values.push_back(*load);
    }
    channels.add(std::move(deflection));
    channels.add(std::move(force));
  }
  for (const Direction direction : test.directions) {
    StiffnessTest one;
    one.direction = direction;
    one.load = test.load;
    const auto found = stiffness(tire, one);
    if (!found) return found.failure();
    channels.add({kDirections[static_cast<int>(direction)],
                  direction == Direction::torsional ? "N m/rad" : "N/m",
                  {*found}});
  }
  return channels;
}

std::string degrees(double angle) {
  return fmt::format("{:.3g} deg", angle * 180.0 / std::numbers::pi);
}

std::string cambered(double camber) {
  return camber == 0.0 ? "" : fmt::format(", camber {}", degrees(camber));
}

std::string words(const DrumTest& test) {
  std::string text =
      fmt::format("drum, {:.4g} km/h, {}{}",
                  test.speed * 3.6,
                  test.load ? format_quantity(*test.load, "N", 4)
                            : format_quantity(test.deflection.value_or(0.0), "mm", 4),
                  cambered(test.camber));
  if (!test.cleat) return text + ", no cleat";
  text += fmt::format(
      ", cleat {:.3g} mm x {:.3g} mm", test.cleat->height * 1e3, test.cleat->length * 1e3);
  if (test.cleat->angle != 0.0) text += fmt::format(" at {}", degrees(test.cleat->angle));
  if (test.passages > 1) text += fmt::format(", {} passages", test.passages);
  if (test.frame != DrumTest().frame) text += fmt::format(", axes {}", name_of(test.frame));
  return text;
}

std::string words(const SampledSweep& test) {
  const SlipSweep& s = test.sweep;
  const bool side = s.alpha_from != s.alpha_to;
  return fmt::format("flat track, {:.4g} km/h, {:.4g} N{}, {}",
                     s.speed * 3.6,
                     s.load,
                     cambered(s.camber),
                     side
                         ? fmt::format("alpha {} to {}", degrees(s.alpha_from), degrees(s.alpha_to))
                         : fmt::format("kappa {:g} to {:g}", s.kappa_from, s.kappa_to));
}

std::string words(const StaticTest& test) {
  std::string text = "standing tire";
  if (!test.deflections.empty()) text += fmt::format(", {} deflections", test.deflections.size());
  for (const Direction direction : test.directions)
    text += fmt::format(", {}", kDirections[static_cast<int>(direction)]);
  return test.directions.empty() ? text : text + fmt::format(" at {:.4g} N", test.load);
}

std::string words(const FootprintTest& test) {
  return fmt::format("footprint at {} {}{}",
                     std::max(test.loads.size(), test.deflections.size()),
                     test.loads.empty() ? "deflections" : "loads",
                     cambered(test.camber));
}

std::string words(const VibrationTest& test) {
  return fmt::format("{} modes {}{}",
                     test.count,
                     test.load ? fmt::format("standing under {:.4g} N", *test.load)
                     : test.deflection
                         ? fmt::format("standing {:.4g} mm deep", *test.deflection * 1e3)
                         : "off the ground",
                     cambered(test.camber));
}

std::string words(const SteadyStates& test) {
  return fmt::format("{} steady states", test.states.rows());
}

std::vector<RecordedChannel> framed(std::vector<RecordedChannel> channels, AxisFrame frame) {
  for (RecordedChannel& channel : channels)
    if (channel.unit == "N" || channel.unit == "N m") channel.frame = name_of(frame);
  return channels;
}

std::vector<RecordedChannel> channels_of(const DrumTest& test) {
  return framed({{"time", "s"},
                 {"Fx", "N"},
                 {"Fy", "N"},
                 {"Fz", "N"},
                 {"Mx", "N m"},
                 {"My", "N m"},
                 {"Mz", "N m"},
                 {"speed", "m/s"},
                 {"wheel_speed", "rad/s"}},
                test.frame);
}

std::vector<RecordedChannel> channels_of(const SampledSweep& test) {
  return framed({{"time", "s"},
                 {"alpha", "rad"},
                 {"kappa", "1"},
                 {"Fx", "N"},
                 {"Fy", "N"},
                 {"Fz", "N"},
                 {"Mx", "N m"},
                 {"My", "N m"},
                 {"Mz", "N m"},
                 {"loaded_radius", "m"}},
                test.sweep.frame);
}

std::vector<RecordedChannel> channels_of(const StaticTest& test) {
  std::vector<RecordedChannel> channels;
  if (!test.deflections.empty()) channels = {{"deflection", "m"}, {"force", "N"}};
  for (const Direction direction : test.directions)
    channels.push_back({kDirections[static_cast<int>(direction)],
                        direction == Direction::torsional ? "N m/rad" : "N/m"});
  return channels;
}

std::vector<RecordedChannel> names_of(const Channels& none) {
  std::vector<RecordedChannel> channels;
  for (const Channel& channel : none.all()) channels.push_back({channel.name, channel.unit});
  return channels;
}

std::vector<RecordedChannel> channels_of(const FootprintTest&) {
  return names_of(to_channels(std::vector<StandingFootprint>{}));
}

std::vector<RecordedChannel> channels_of(const VibrationTest&) {
  return {{"frequency", "Hz"}, {"n", "1"}, {"type", "1"}, {"phase", "1"}, {"damping", "1"}};
}

std::vector<RecordedChannel> channels_of(const SteadyStates&) { return names_of(answers({})); }

}  // namespace

RollingTest read_rolling_test(const std::filesystem::path& file) {
  const Document document = Document::read(file);
  const Node root = document.root();
  const std::string kind = root.choice(
      "kind",
      {"drum_cleat", "slip_sweep", "static_stiffness", "footprint", "modes", "steady_states"});
  if (kind == "drum_cleat") return read_drum_test(root);
  if (kind == "slip_sweep") return read_slip_sweep(root);
  if (kind == "static_stiffness") return read_static_test(root);
  if (kind == "footprint") return read_footprint_test(root);
  if (kind == "modes") return read_vibration_test(root);
  return read_steady_states(root, file.parent_path());
}

std::vector<RecordedChannel> recorded(const RollingTest& test) {
  return std::visit([](const auto& of) { return channels_of(of); }, test);
}

std::optional<Reach> reach(const RollingTest& test, const std::string& channel) {
  if (const auto* drum = std::get_if<DrumTest>(&test); drum && channel == "time") {
    // As drum_rig.cpp records: the first sample one sample step behind the beginning.
    const auto steps = [&](double time) { return std::lround(time / drum->step); };
    const long every = steps(drum->sample_step), lead = steps(drum->lead);
    const long last = steps(drum->duration - drum->lead);
    const auto time = [&](long i) { return static_cast<double>(i) * drum->step; };
    return Reach{time(every - lead), time((last + lead) / every * every - lead)};
  }
  if (const auto* sampled = std::get_if<SampledSweep>(&test); sampled && channel == "time") {
    const SlipSweep& sweep = sampled->sweep;
    const auto steps = [&](double time) { return std::lround(time / sweep.step); };
    const long every = steps(sampled->sample_step);
    const long before = steps(sweep.run_in) + steps(0.5 * sweep.run_in);
    const auto time = [&](long i) { return static_cast<double>(before + i) * sweep.step; };
    return Reach{time(every), time(steps(sweep.duration) / every * every)};
  }
  const auto* standing = std::get_if<StaticTest>(&test);
  if (standing && channel == "deflection" && !standing->deflections.empty()) {
    const auto [least, most] =
        std::minmax_element(standing->deflections.begin(), standing->deflections.end());
    return Reach{*least, *most};
  }
  return std::nullopt;
}

std::optional<long> samples(const RollingTest& test) {
  const auto* steady = std::get_if<SteadyStates>(&test);
  return steady ? std::optional<long>(steady->states.rows()) : std::nullopt;
}

std::string in_words(const RollingTest& test) {
  return std::visit([](const auto& of) { return words(of); }, test);
}

Result<Channels> run(const TireKind& kind, const Document& numbers, const RollingTest& test) {
  if (const auto* steady = std::get_if<SteadyStates>(&test)) {
    if (kind.steady) return kind.steady(numbers, steady->states);
    throw InputError(steady->states.header_place(),
                     "are steady states, which a " + kind.in_words +
                         " does not answer; expected a test in time, or kind = \"magic_formula\"");
  }
  if (const auto* vibration = std::get_if<VibrationTest>(&test)) {
    if (kind.modes) return kind.modes(numbers, *vibration);
    throw InputError("a " + kind.in_words +
                     " has no modes of its belt to ask for; expected kind = \"ring_tire\"");
  }
  const std::unique_ptr<Tire> tire = kind.build(numbers);
  if (const auto* drum = std::get_if<DrumTest>(&test)) return run(*tire, *drum);
  if (const auto* sweep = std::get_if<SampledSweep>(&test)) return run(*tire, *sweep);
  if (const auto* footprint = std::get_if<FootprintTest>(&test)) {
    const auto states = footprints(*tire, *footprint);
    if (!states) return states.failure();
    return to_channels(*states);
  }
  return run(*tire, std::get<StaticTest>(test));
}

}  // namespace latsch::experiment
