// SPDX-License-Identifier: Apache-2.0
// The test kind = "rolling_chain": motion, strain, stress and losses of points around a
// finite-element tire that rolls (rigs/fe_tire/rolling_chain_rig.h).
//
// The keys are in experiment/tests/keys/rolling_chain_keys.cpp.
#include <fmt/format.h>

#include "experiment/language/capabilities.h"
#include "experiment/rigs/fe_tire/rolling_chain_rig.h"
#include "experiment/tests/pictures/chain_pictures.h"
#include "experiment/tests/rolling_states.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

class FeRollingChainTest : public RollsFeTire {
 public:
  FeRollingChainTest(RollingStates states, ChainPlaces places)
      : RollsFeTire(std::move(states)), places_(std::move(places)) {}

  std::string in_words() const override {
    const std::size_t chains = places_.positions.size();
    return fmt::format("{} {} of points around a rolling tire, depth {}, {}",
                       chains,
                       chains == 1 ? "chain" : "chains",
                       places_.depth,
                       states_in_words());
  }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    const Channels none = no_chains();
    for (const Channel& channel : none.all()) channels.push_back({channel.name, channel.unit});
    return channels;
  }
  Result<Details> details(Specimen& specimen) const override {
    const auto found = run(specimen);
    if (!found) return found.failure();
    return chain_details(*found);
  }
  const ChainPlaces* chain_places() const override { return &places_; }

 protected:
  Result<Channels> measure(TireRig& rig, fe_tire::TireSlopes*) const override {
    return chains(rig, rolling(), places_);
  }

 private:
  ChainPlaces places_;
};

std::unique_ptr<Test> read_rolling_chain(const Node& root, const TestSource& source) {
  RollingStates states = read_rolling_states(root, source);
  ChainPlaces places;
  if (root.has("position"))
    places.positions = root.one_or_more("position", "1", Range::between(-1.0, 1.0));
  if (places.positions.empty())
    root.reject("position", "is empty, expected -1 (bead at -y) to 1 (bead at +y)");
  places.depth = root.text("depth", places.depth);
  return std::make_unique<FeRollingChainTest>(std::move(states), std::move(places));
}

}  // namespace

const KeySection& rolling_chain_keys();

const TestKind kRollingChainTest = {"rolling_chain",
                                    "rolls: motion, strain, stress, losses around the tire",
                                    {IsFeTire::kName},
                                    read_rolling_chain,
                                    rolling_chain_keys};

}  // namespace latsch::experiment
