// SPDX-License-Identifier: Apache-2.0
// The test kind = "rolling_response": forces of a rolling finite-element tire that follow slips
// which change harmonically, and its relaxation lengths (rigs/fe_rolling/rolling_response_rig.h).
//
// The keys are in experiment/tests/keys/rolling_response_keys.cpp.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "experiment/language/capabilities.h"
#include "experiment/rigs/fe_rolling/rolling_response_rig.h"
#include "experiment/rigs/hub_frame.h"
#include "experiment/tests/modes.h"
#include "experiment/tests/pictures/rolling_response_pictures.h"
#include "experiment/tests/response_frequencies.h"
#include "experiment/tests/rolling_states.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

/// Highest frequency, Hz; a mesh mostly allows less.
constexpr double kHighestOfSlips = 200.0;
/// Friction above which a message states that the swing of a response is small.
constexpr double kMuchFriction = 1.5;

class FeRollingResponseTest : public RollsFeTire {
 public:
  FeRollingResponseTest(RollingStates states, RollingResponseTest test)
      : RollsFeTire(std::move(states)), test_(std::move(test)) {
    test_.states = rolling();
  }

  std::string in_words() const override {
    std::vector<std::string> slips;
    for (const ResponseSlip& slip : test_.slips) slips.emplace_back(slip.of_slip);
    return fmt::format("response to a changing {}, {:g} to {:g} Hz, rolling {}",
                       fmt::join(slips, ", "),
                       test_.frequencies.front(),
                       test_.frequencies.back(),
                       states_in_words());
  }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    const Channels none = rolling_response_channels(test_, {}, {});
    for (const Channel& channel : none.all()) {
      const bool is_force = channel.name.find("_by_") != std::string::npos;
      channels.push_back(
          {channel.name, channel.unit, is_force ? name_of(AxisFrame::W) : std::string()});
    }
    return channels;
  }
  std::optional<Reach> reach(const std::string& channel) const override {
    if (channel != "frequency") return std::nullopt;
    return Reach{test_.frequencies.front(), test_.frequencies.back()};
  }
  std::optional<long> samples() const override {
    return std::ssize(rolling().rows) * std::ssize(test_.frequencies);
  }
  std::vector<std::string> limits(Specimen& specimen) const override {
    std::vector<std::string> limits = limits_but_swings(specimen);
    if (std::string words = swings_with_much_friction(specimen); !words.empty())
      limits.push_back(std::move(words));
    return limits;
  }
  /// Adds over which swings the response holds, which takes steady states besides.
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    std::vector<std::string> remarks;
    const auto found = specimen.find<IsFeTire>()->drive(
        [&](TireRig& rig, fe_tire::TireSlopes*) { return rolling_response(rig, test_, &remarks); },
        rolling().pressure.has_value(),
        {});
    if (!found) return found.failure();
    tell(*found);
    for (std::string& limit : limits_but_swings(specimen)) remarks.push_back(std::move(limit));
    return remarks;
  }
  Result<Details> details(Specimen& specimen) const override {
    const auto found = run(specimen);
    if (!found) return found.failure();
    return rolling_response_details(*found);
  }

 protected:
  Result<Channels> measure(TireRig& rig, fe_tire::TireSlopes*) const override {
    return rolling_response(rig, test_);
  }

 private:
  std::vector<std::string> limits_but_swings(Specimen& specimen) const {
    std::vector<std::string> limits = {
        "rolling_response: the inertia of the change is left out, gyroscopic forces of the belt "
        "included, so responses hold far below the lowest mode of the tire on the ground (test "
        "modes)"};
    if (has_losses(specimen))
      limits.emplace_back(
          "rolling_response: rubber and cords relax in the steady state; its change has their "
          "storage moduli at twice the frequency of rotation and no losses, so that slopes differ "
          "from those of steady forces, by 12 % of Fy at a loss factor of 0.15");
    for (std::string& limit : RollsFeTire::limits(specimen)) limits.push_back(std::move(limit));
    return limits;
  }
  /// Returns a sentence if friction is far above that of usual ground, else nothing.
  std::string swings_with_much_friction(Specimen& specimen) const {
    double friction = 0.0;
    (void)specimen.find<IsFeTire>()->drive(
        [&](TireRig& rig, fe_tire::TireSlopes*) -> Result<Channels> {
          friction = friction_of(rig, test_.states.friction).at_rest;
          return Channels();
        },
        true,
        {});
    if (friction <= kMuchFriction) return "";
    return fmt::format(
        "rolling_response: with friction {0:g} few points slide, and the traction of each changes "
        "{0:g} times as much as its pressure, so a response may hold only for swings below 0.01 "
        "deg or a slip of 1e-4; latsch test compares it with steady states over larger swings",
        friction);
  }

  RollingResponseTest test_;
};

/// Reads the slips that change. Throws InputError for an unknown name and for a name that is stated
/// twice.
std::vector<ResponseSlip> read_slips(const Node& root) {
  std::vector<std::string> names = {"alpha", "kappa"};
  if (root.has("inputs")) names = root.texts("inputs");
  std::vector<ResponseSlip> slips;
  std::vector<std::string> known;
  for (const ResponseSlip& slip : response_slips()) known.emplace_back(slip.name);
  for (const std::string& name : names) {
    const auto at = std::ranges::find(known, name);
    if (at == known.end())
      root.reject("inputs",
                  fmt::format("names {}, expected some of {}", in_quotes(name), list_of(known)));
    const ResponseSlip& slip = response_slips()[at - known.begin()];
    if (std::ranges::find(slips, slip.input, &ResponseSlip::input) != slips.end())
      root.reject("inputs", fmt::format("names {} twice, expected it once", in_quotes(name)));
    slips.push_back(slip);
  }
  if (slips.empty())
    root.reject("inputs", fmt::format("is empty, expected some of {}", list_of(known)));
  return slips;
}

/// Throws InputError for states about which there is no response.
void refuse_states(const Node& root, const RollingTest& states) {
  if (root.has("drum_radius"))
    root.reject("drum_radius",
                "stands beside a response, which is computed on flat ground alone: expected none");
  if (states.friction.value_or(1.0) == 0.0)
    root.reject("friction",
                "is 0: on frictionless ground no force follows a slip; expected friction above 0");
}

std::unique_ptr<Test> read_rolling_response(const Node& root, const TestSource& source) {
  RollingStates states = read_rolling_states(root, source);
  refuse_states(root, states.test);
  RollingResponseTest test;
  test.slips = read_slips(root);
  test.frequencies = read_frequencies(
      root, source, kHighestOfSlips, "the inertia of the change, which is left out, then matters");
  test.axle = root.choice("axle", {"load", "height"}, "load") == "height" ? fe_tire::Axle::held
                                                                          : fe_tire::Axle::follows;
  return std::make_unique<FeRollingResponseTest>(std::move(states), std::move(test));
}

}  // namespace

const KeySection& rolling_response_keys();

const TestKind kRollingResponseTest = {"rolling_response",
                                       "rolls: forces behind a changing slip, relaxation lengths",
                                       {IsFeTire::kName},
                                       read_rolling_response,
                                       rolling_response_keys};

}  // namespace latsch::experiment
