// SPDX-License-Identifier: Apache-2.0
// kind = "rolling_stiffness" (rigs/slip/rolling_stiffness.h): slopes of a tire's forces at free
// rolling.
#include "experiment/rigs/slip/rolling_stiffness.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/drum_rig.h"
#include "experiment/rigs/duration_limit.h"
#include "experiment/rigs/fe_rolling/rolling_slopes.h"
#include "experiment/rigs/fe_rolling/steady_table.h"
#include "experiment/rigs/fe_tire/rolling_rig.h"
#include "experiment/rigs/slip/lift_watch.h"
#include "experiment/rigs/wheel_scheme.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

// Default of the distance, m, that the tire rolls within a step, at most. The blocks of a flexible
// ring then take several steps to come into contact, and its camber stiffness differs by less than
// 3 % from that with short steps. A longer step is faster.
constexpr double kUsualStep = 0.01;

const std::vector<std::string> kMeasures = {"slip", "cornering", "camber"};

// Share of the load: a stiffness below it, such as that of camber without its coefficients, is 0.
constexpr double kRounding = 1e-6;

// Consequence of a negative stiffness, for each kind of stiffness.
constexpr std::pair<const char*, const char*> kWrongSign[] = {
    {"slip_stiffness", "a driven wheel is pushed backward"},
    {"cornering_stiffness", "a steered wheel is pushed out of the turn"},
    {"camber_stiffness", "a cambered wheel is pushed to the side that it leans away from"}};

class RollingStiffness : public Test, public TellsLimits {
 public:
  RollingStiffness(const RollingStiffnessTest& test, std::vector<std::string> measures)
      : test_(test), measures_(std::move(measures)) {}

  std::string in_words() const override {
    return fmt::format("rolling freely, {:.4g} km/h, {:.4g} N{}: {}",
                       3.6 * test_.speed,
                       test_.load,
                       inflated(test_.pressure),
                       fmt::join(measures_, ", "));
  }

  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    if (wants("slip")) channels.push_back({"slip_stiffness", "N"});
    if (wants("cornering")) {
      channels.push_back({"cornering_stiffness", "N/rad"});
      channels.push_back({"pneumatic_trail", "m"});
    }
    if (wants("camber")) channels.push_back({"camber_stiffness", "N/rad"});
    return channels;
  }

  std::vector<std::string> needs() const override { return kRollingStiffnessTest.needs; }
  std::optional<long> samples() const override { return 1; }

  std::vector<std::string> limits(Specimen& specimen) const override {
    if (auto* tire = specimen.find<IsFeTire>()) return assumed_by(*tire);
    std::vector<std::string> limits = limits_of_model(specimen);
    DrivenWheel driven = {{"Fz", {test_.load, test_.load}}, {"speed", {test_.speed, test_.speed}}};
    if (test_.pressure) driven["p"] = {*test_.pressure, *test_.pressure};
    for (std::string& limit : limits_of_driven(specimen, driven))
      limits.push_back(std::move(limit));
    return limits;
  }

  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    auto notes = Test::run_in_blocks(specimen, tell);
    if (!notes) return notes;
    for (std::string& limit : limits_of_model(specimen)) notes->push_back(std::move(limit));
    return notes;
  }

  Result<Channels> run(Specimen& specimen) const override { return run_with_slopes(specimen, {}); }
  bool tells_slopes(const SpecimenKind& kind, const std::string&) const override {
    return kind.has(IsFeTire::kName);
  }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    auto* elements = specimen.find<IsFeTire>();
    auto measured = elements ? measure(*elements, asked) : measure(specimen);
    if (!measured) return measured.failure();
    const Channels recorded = *std::move(measured);
    for (const auto& [name, effect] : kWrongSign)
      if (const Channel* channel = recorded.find(name);
          channel && channel->values.front() < -kRounding * test_.load)
        record_limit(specimen,
                     fmt::format("{} is negative, {:.4g} {}: {}, which no tire does",
                                 name,
                                 channel->values.front(),
                                 channel->unit,
                                 effect));
    return recorded;
  }

 private:
  /// Returns the limits that a run does not report by itself. A run reports ranges that it left.
  std::vector<std::string> limits_of_model(Specimen& specimen) const {
    if (auto* tire = specimen.find<IsFeTire>()) return assumed_by(*tire);
    return limits_of_camber(specimen, wants("camber") ? test_.camber : 0.0, /*rolls=*/true);
  }
  /// Returns the channels, each with one value and its slopes.
  Channels recorded(const std::vector<double>& values,
                    const std::vector<std::vector<double>>& slopes) const {
    Channels recorded;
    for (const ChannelInfo& info : channels()) {
      const std::size_t k = recorded.all().size();
      Channel channel{info.name, info.unit, {values[k]}};
      if (!slopes.empty()) channel.slopes = slopes[k];
      recorded.add(std::move(channel));
    }
    return recorded;
  }
  /// Returns the channels of a tire that rolls in steps of time.
  Result<Channels> measure(Specimen& specimen) const {
    LiftLog lifts;
    const auto tire = watched(specimen.find<Rolls>()->tire(test_.pressure), lifts);
    std::vector<double> values;
    if (wants("slip")) {
      const auto found = slip_stiffness(*tire, test_);
      if (!found) return found.failure();
      values.push_back(*found);
    }
    if (wants("cornering")) {
      const auto found = cornering(*tire, test_);
      if (!found) return found.failure();
      values.insert(values.end(), {found->stiffness, found->trail});
    }
    if (wants("camber")) {
      const auto found = camber_stiffness(*tire, test_);
      if (!found) return found.failure();
      values.push_back(*found);
    }
    record_limit(specimen, lifts.sentence());
    return recorded(values, {});
  }

  /// Returns the channels of a tire that has steady states of its own.
  Result<Channels> measure(IsFeTire& tire, const Asked& asked) const {
    return tire.drive(
        [&](TireRig& rig, fe_tire::TireSlopes* slopes) -> Result<Channels> {
          const WantedSlopes wanted{wants("slip"), wants("cornering"), wants("camber")};
          const auto found = rolling_slopes(rig, test_, wanted, slopes);
          if (!found) return found.failure();
          const double all[] = {found->slip, found->cornering, found->trail, found->camber};
          const bool are_wanted[] = {
              wanted.slip, wanted.cornering, wanted.cornering, wanted.camber};
          std::vector<double> values;
          std::vector<std::vector<double>> rates;
          for (std::size_t k = 0; k < std::size(all); ++k) {
            if (!are_wanted[k]) continue;
            values.push_back(all[k]);
            if (found->rates.empty()) continue;
            rates.emplace_back();
            for (const auto& by : found->rates) rates.back().push_back(by[k]);
          }
          return recorded(values, rates);
        },
        test_.pressure.has_value(),
        asked);
  }

  /// Returns a sentence about the friction of a finite-element tire, which the test does not state.
  std::vector<std::string> assumed_by(IsFeTire& tire) const {
    std::vector<std::string> sentences;
    (void)tire.drive(
        [&](TireRig& rig, fe_tire::TireSlopes*) -> Result<Channels> {
          sentences.push_back(
              friction_in_words(rig, test_.pressure.value_or(rig.own_pressure()), test_.speed));
          return Channels();
        },
        true,
        {});
    return sentences;
  }

  bool wants(const char* measure) const {
    return std::find(measures_.begin(), measures_.end(), measure) != measures_.end();
  }

  RigSettings rig_settings() const override { return &test_; }

  RollingStiffnessTest test_;
  std::vector<std::string> measures_;
};

std::unique_ptr<Test> read_rolling_stiffness(const Node& root, const TestSource& source) {
  RollingStiffnessTest test;
  const auto load = find_measured(root, "load"), speed = find_measured(root, "speed");
  test.load = load ? measured_mean(*load, {"Fz", "N", true, "W"}, source.measured)
                   : root.quantity("load", "N", Range::positive());
  test.speed = speed ? measured_mean(*speed, {"Vx", "m/s"}, source.measured)
                     : root.quantity("speed", "m/s", Range::between(1.0, 100.0), test.speed);
  if (!(test.speed >= 1.0))
    root.reject("speed", fmt::format("is {:.3g} m/s as measured, expected 1 at least", test.speed));
  test.pressure = read_pressure(root, source.measured);
  test.step = std::min(test.step, kUsualStep / test.speed);
  test.slip = root.quantity("slip", "1", {0.0, 0.1, true}, test.slip);
  test.angle = root.quantity("angle", "rad", {0.0, 0.1, true}, test.angle);
  test.camber = root.quantity("camber", "rad", {0.0, 0.2, true}, test.camber);
  test.step = root.quantity("step", "s", Range::between(kShortestStep, 0.01), test.step);
  check_step(root, test.speed, test.step);
  std::vector<std::string> measures = root.has("measures") ? root.texts("measures") : kMeasures;
  for (const std::string& name : measures)
    if (std::find(kMeasures.begin(), kMeasures.end(), name) == kMeasures.end())
      root.reject("measures", "has " + in_quotes(name) + ", expected " + list_of(kMeasures));
    else if (std::count(measures.begin(), measures.end(), name) > 1)
      root.reject("measures", "has " + in_quotes(name) + " twice, expected each once");
  if (measures.empty()) root.reject("measures", "is empty, expected some of " + list_of(kMeasures));
  return std::make_unique<RollingStiffness>(test, std::move(measures));
}

}  // namespace

const KeySection& rolling_stiffness_keys();

const TestKind kRollingStiffnessTest = {"rolling_stiffness",
                                        "rolls freely: slip, cornering and camber stiffness, trail",
                                        {Rolls::kName, IsFeTire::kName},
                                        read_rolling_stiffness,
                                        rolling_stiffness_keys,
                                        kWheelScheme};

}  // namespace latsch::experiment
