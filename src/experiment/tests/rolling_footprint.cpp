// SPDX-License-Identifier: Apache-2.0
// The test kind = "rolling_footprint": pressure, shear, sliding speed and grip in the patch of a
// finite-element tire that rolls (rigs/fe_tire/rolling_footprint.h).
//
// The keys are in experiment/tests/keys/rolling_footprint_keys.cpp.
#include "experiment/rigs/fe_tire/rolling_footprint.h"

#include "experiment/language/capabilities.h"
#include "experiment/tests/pictures/rolling_footprint_pictures.h"
#include "experiment/tests/rolling_states.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

class FeRollingFootprintTest : public RollsFeTire {
 public:
  FeRollingFootprintTest(RollingStates states, GroundSensors sensors)
      : RollsFeTire(std::move(states)), sensors_(std::move(sensors)) {}

  std::string in_words() const override {
    return "footprints of a rolling tire " + states_in_words();
  }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    const Channels none = footprint_channels(sensors_, {});
    for (const Channel& channel : none.all()) channels.push_back({channel.name, channel.unit});
    return channels;
  }
  std::optional<long> samples() const override {
    if (!sensors_.at.empty()) return std::nullopt;  // the channels of sensors have more values
    return std::ssize(rolling().rows);
  }
  Result<Details> details(Specimen& specimen) const override {
    Details details;
    const auto done = specimen.find<IsFeTire>()->drive(
        [&](TireRig& rig, fe_tire::TireSlopes*) -> Result<Channels> {
          const auto states = roll_states(rig, rolling());
          if (!states) return states.failure();
          details = rolling_footprint_details(*states);
          return Channels();
        },
        rolling().pressure.has_value(),
        {});
    if (!done) return done.failure();
    return details;
  }

 protected:
  Result<Channels> measure(TireRig& rig, fe_tire::TireSlopes*) const override {
    const auto states = roll_states(rig, rolling());
    if (!states) return states.failure();
    return footprint_channels(sensors_, *states);
  }

 private:
  GroundSensors sensors_;
};

std::unique_ptr<Test> read_rolling_footprint(const Node& root, const TestSource& source) {
  RollingStates states = read_rolling_states(root, source);
  GroundSensors sensors;
  constexpr double kLeastSensor = 1e-3, kMostSensor = 0.1;  // m
  sensors.side =
      root.quantity("sensor", "m", Range::between(kLeastSensor, kMostSensor), sensors.side);
  if (root.has("sensors"))
    for (const std::vector<double>& at : root.rows("sensors", {"m", "m"}))
      sensors.at.emplace_back(at[0], at[1]);
  return std::make_unique<FeRollingFootprintTest>(std::move(states), std::move(sensors));
}

}  // namespace

const KeySection& rolling_footprint_keys();

const TestKind kRollingFootprintTest = {"rolling_footprint",
                                        "rolls: pressure, shear, sliding, grip in its patch",
                                        {IsFeTire::kName},
                                        read_rolling_footprint,
                                        rolling_footprint_keys};

}  // namespace latsch::experiment
