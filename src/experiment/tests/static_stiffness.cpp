// SPDX-License-Identifier: Apache-2.0
// kind = "static_stiffness": its keys are those of rigs/static_stiffness.h.
#include "experiment/rigs/static_stiffness.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "base/text.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/fe_tire/standing_rig.h"
#include "experiment/tests/load_deflection.h"
#include "experiment/tests/test_kinds.h"
#include "models/tire/tared_tire.h"

namespace latsch::experiment {
namespace {

constexpr double kWay = 1e-3;  // m or rad

/// Returns a sentence on a cleat that is shorter than the mesh of a finite-element tire resolves;
/// empty for a longer one.
std::string unresolved_by_mesh(double rows_apart, const Cleat& cleat) {
  constexpr double kRows = 3.0;  // rows of nodes on the cleat
  const double along = cleat.length / std::max(std::abs(std::cos(cleat.angle)), 1e-9);
  if (along >= kRows * rows_apart) return "";
  return fmt::format(
      "the cleat is {:.3g} mm long and the rows of nodes of this tire's mesh are {:.3g} mm apart "
      "at "
      "the ground: it may carry too much, as flat ground would; more sectors resolve it "
      "(latsch mesh --convergence)",
      1e3 * along,
      1e3 * rows_apart);
}

class StaticStiffnessTest : public Test, public TellsLimits {
 public:
  explicit StaticStiffnessTest(StandingTest test) : test_(std::move(test)) {}

  std::string in_words() const override {
    const StandingTest& test = test_;
    std::string text = "standing tire" + inflated(test.pressure);
    if (!test.deflections.empty()) text += fmt::format(", {} deflections", test.deflections.size());
    if (test.cleat)
      text += fmt::format(" on a cleat {:.3g} mm x {:.3g} mm at {:.3g} deg",
                          test.cleat->height * 1e3,
                          test.cleat->length * 1e3,
                          test.cleat->angle * 180.0 / std::numbers::pi);
    for (const Direction direction : test.directions)
      text += fmt::format(", {}", name_of(direction));
    if (!test.directions.empty()) text += fmt::format(" at {:.4g} N", test.load);
    if (test.camber != 0.0)
      text += fmt::format(", camber {:.3g} deg", test.camber * 180.0 / std::numbers::pi);
    if (test.friction) text += fmt::format(", friction {:.3g}", *test.friction);
    return text;
  }

  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    if (!test_.deflections.empty()) channels = {{"deflection", "m"}, {"force", "N"}};
    for (const Direction direction : test_.directions)
      channels.push_back({name_of(direction), unit_of(direction)});
    return channels;
  }

  std::vector<std::string> needs() const override { return kStaticStiffnessTest.needs; }

  std::optional<Reach> reach(const std::string& channel) const override {
    if (channel != "deflection" || test_.deflections.empty()) return std::nullopt;
    const auto [least, most] =
        std::minmax_element(test_.deflections.begin(), test_.deflections.end());
    return Reach{*least, *most};
  }

  std::optional<long> samples_of(const std::string& channel) const override {
    const bool is_of_curve = channel == "deflection" || channel == "force";
    return is_of_curve ? std::ssize(test_.deflections) : 1;
  }

  Result<Channels> run(Specimen& specimen) const override { return run_with_slopes(specimen, {}); }
  std::vector<std::string> limits(Specimen& specimen) const override {
    std::vector<std::string> all = limits_of(specimen, test_.cleat);
    if (const auto* elements = specimen.find<IsFeTire>(); elements && test_.cleat)
      if (std::string unresolved = unresolved_by_mesh(elements->rows_apart(), *test_.cleat);
          !unresolved.empty())
        all.push_back(std::move(unresolved));
    if (const auto* knows = specimen.find<KnowsLimits>())
      for (const Direction direction : test_.directions)
        if (std::string assumed = knows->assumed_stiffness(name_of(direction)); !assumed.empty())
          all.push_back(std::move(assumed));
    std::ranges::move(limits_of_standing(specimen, test_.friction.value_or(0.0)),
                      std::back_inserter(all));
    return all;
  }
  /// The returned sentences state the limits of the specimen and how much the tire slides.
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    Channels found;
    const auto notes = Test::run_in_blocks(specimen, [&](const Channels& block) {
      found = block;
      tell(block);
    });
    if (!notes) return notes;
    std::vector<std::string> all = limits(specimen);
    std::ranges::move(sliding_in(found), std::back_inserter(all));
    return all;
  }
  /// True for a tire that stands; a rolling tire has no slopes.
  bool tells_slopes(const SpecimenKind& kind, const std::string&) const override {
    return has_slopes() && kind.has(IsFeTire::kName);
  }
  /// True if the tire is upright on flat ground without friction.
  bool has_slopes() const {
    const auto is_vertical = [](Direction direction) { return direction == Direction::vertical; };
    return !test_.cleat && test_.camber == 0.0 && test_.friction.value_or(0.0) == 0.0 &&
           std::ranges::all_of(test_.directions, is_vertical);
  }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    refuse_high_cleat(specimen, test_.cleat);
    if (auto* held = specimen.find<IsFeTire>()) {
      const auto press = [this](TireRig& rig, fe_tire::TireSlopes* slopes) {
        return stand(rig.tire(), rig.own_pressure(), test_, slopes);
      };
      return held->drive(press, test_.pressure.has_value(), has_slopes() ? asked : Asked{});
    }
    refuse_without_stiffness(specimen);
    const auto stood = stand(*tared(specimen.find<Rolls>()->tire(test_.pressure)), test_);
    if (stood && !test_.deflections.empty()) stood_under(specimen, (*stood)["force"]);
    if (stood && !test_.directions.empty()) stood_under(specimen, {test_.load});
    return stood;
  }

 private:
  /// Returns a sentence for each direction in which the patch slides as a whole, or nearly, within
  /// the travel: the quotient of force and travel is then no stiffness of the tire.
  std::vector<std::string> sliding_in(const Channels& found) const {
    constexpr double kMuch = 0.7;  // share of the force at which the patch slides as a whole
    std::vector<std::string> all;
    for (const Direction direction : {Direction::longitudinal, Direction::lateral}) {
      const Channel* stiffness = found.find(name_of(direction));
      if (!stiffness || stiffness->values.empty() || !(test_.load > 0.0)) continue;
      const double share = stiffness->values.front() * test_.travel / test_.load;
      if (share < kMuch * test_.friction.value_or(1.0)) continue;
      all.push_back(fmt::format(
          "the {} force after {:.4g} mm of travel is {:.2g} times the load, so most of the patch "
          "slides: the stiffness is force over travel and falls with it; a travel of 1 mm gives "
          "the stiffness of the tire",
          name_of(direction),
          1e3 * test_.travel,
          share));
    }
    return all;
  }
  /// Throws InputError if the file of the tire determines no stiffness in a direction of the test.
  void refuse_without_stiffness(Specimen& specimen) const {
    const auto* knows = specimen.find<KnowsLimits>();
    if (!knows) return;
    for (const Direction direction : test_.directions)
      if (const std::string why = knows->no_stiffness(name_of(direction)); !why.empty())
        throw InputError(
            fmt::format("this tire has no {} stiffness: {}; expected directions "
                        "without \"{}\", or the key in its file",
                        name_of(direction),
                        why,
                        name_of(direction)));
  }

  StandingTest test_;
};

std::unique_ptr<Test> read_static_test(const Node& root, const TestSource& source) {
  StandingTest test;
  if (const auto from = find_measured(root, "deflections"))
    test.deflections = measured_values(*from, {"deflection", "m"}, source.measured);
  else if (root.has("deflections"))
    test.deflections = root.quantities("deflections", "m", Range::positive());
  if (root.has("load")) {
    const auto from = find_measured(root, "load");
    test.load = from ? measured_mean(*from, {"Fz", "N", true, "W"}, source.measured)
                     : root.quantity("load", "N", Range::positive());
    std::vector<std::string> names(kDirections.begin(), kDirections.end());
    if (root.has("directions")) names = root.texts("directions");
    for (const std::string& name : names) {
      const auto known = std::find(kDirections.begin(), kDirections.end(), name);
      if (known == kDirections.end())
        root.reject("directions",
                    "has " + in_quotes(name) +
                        R"(, expected "vertical", "longitudinal", "lateral" or "torsional")");
      const auto direction = static_cast<Direction>(known - kDirections.begin());
      if (std::ranges::find(test.directions, direction) != test.directions.end())
        root.reject("directions", "has " + in_quotes(name) + " twice, expected each once");
      test.directions.push_back(direction);
    }
  }
  test.pressure = read_pressure(root, source.measured);
  test.camber = root.quantity("camber", "rad", Range::between(-0.5, 0.5), 0.0);
  if (test.camber != 0.0 && !test.deflections.empty())
    root.reject("camber",
                "is for stiffnesses under a load: deflections are those of an upright tire");
  if (root.has("friction"))
    test.friction = root.quantity("friction", "1", Range::between(0.0, 5.0));
  // At a larger travel or twist the contact patch of every tire slides, and force over travel is no
  // longer a stiffness.
  constexpr double kFarthest = 0.05, kMostTwist = 0.1;  // m, rad
  test.travel = root.quantity("travel", "m", {0.0, kFarthest, true}, test.travel);
  test.twist = root.quantity("twist", "rad", {0.0, kMostTwist, true}, test.twist);
  if (test.deflections.empty() == test.directions.empty())
    root.reject("deflections", "or load with directions is required, exactly one of the two");
  constexpr double kAlong = 0.5 * std::numbers::pi;  // a bar in the direction of the road
  test.cleat = read_cleat(root, kAlong);
  if (test.cleat && test.deflections.empty())
    root.reject("cleat", "is for deflections: stiffnesses under a load are those on flat ground");
  return std::make_unique<StaticStiffnessTest>(std::move(test));
}

}  // namespace

const KeySection& static_stiffness_keys();

const TestKind kStaticStiffnessTest = {"static_stiffness",
                                       "stands: force over deflection, stiffnesses",
                                       {IsFeTire::kName, Rolls::kName},
                                       read_static_test,
                                       static_stiffness_keys};

}  // namespace latsch::experiment
