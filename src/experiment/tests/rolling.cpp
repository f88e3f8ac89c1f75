// SPDX-License-Identifier: Apache-2.0
// The test kind = "rolling": steady states of a finite-element tire that rolls on flat ground with
// friction (rigs/fe_tire/rolling_rig.h).
//
// The keys are in experiment/tests/keys/rolling_keys.cpp.
#include <algorithm>

#include "experiment/language/capabilities.h"
#include "experiment/rigs/hub_frame.h"
#include "experiment/tests/rolling_states.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

class FeRollingTest : public RollsFeTire {
 public:
  using RollsFeTire::RollsFeTire;

  std::string in_words() const override { return "rolling " + states_in_words(); }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    const Channels none = channels_of({}, {});
    const auto in_W = force_names({AxisFrame::W});
    for (const Channel& channel : none.all()) {
      const bool is_force = std::ranges::find(in_W, channel.name) != in_W.end();
      channels.push_back(
          {channel.name, channel.unit, is_force ? name_of(AxisFrame::W) : std::string()});
    }
    return channels;
  }
  std::optional<long> samples() const override { return std::ssize(rolling().rows); }
  bool tells_slopes(const SpecimenKind&, const std::string& channel) const override {
    return has_rolling_slopes(channel);
  }

 protected:
  Result<Channels> measure(TireRig& rig, fe_tire::TireSlopes* slopes) const override {
    return roll(rig, rolling(), slopes);
  }
};

std::unique_ptr<Test> read_rolling(const Node& root, const TestSource& source) {
  return std::make_unique<FeRollingTest>(read_rolling_states(root, source));
}

}  // namespace

const KeySection& rolling_keys();

const TestKind kRollingTest = {"rolling",
                               "rolls steadily with friction: forces, moments, radii",
                               {IsFeTire::kName},
                               read_rolling,
                               rolling_keys};

}  // namespace latsch::experiment
