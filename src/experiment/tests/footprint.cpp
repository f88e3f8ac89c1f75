// SPDX-License-Identifier: Apache-2.0
// kind = "footprint": the contact patch of a tire that stands on the ground (rigs/footprint_rig.h
// has the channels).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/language/test_words.h"
#include "experiment/tests/load_deflection.h"
#include "experiment/tests/pictures/footprint_pictures.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

class StandingFootprintTest : public Test, public TellsLimits {
 public:
  explicit StandingFootprintTest(FootprintTest test) : test_(std::move(test)) {}

  std::string in_words() const override {
    const FootprintTest& test = test_;
    return fmt::format("footprint at {} {}{}{}",
                       std::max(test.loads.size(), test.deflections.size()),
                       test.loads.empty() ? "deflections" : "loads",
                       cambered(test.camber),
                       inflated(test.pressure));
  }

  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    const Channels none = to_channels(test_, {});
    for (const Channel& channel : none.all()) channels.push_back({channel.name, channel.unit});
    return channels;
  }

  std::vector<std::string> needs() const override {
    if (test_.elements) return {HasTreadElements::kName};
    if (test_.friction) return {TakesConditions::kName};
    return kFootprintTest.needs;
  }

  std::optional<long> samples() const override {
    if (!test_.sensors.empty()) return std::nullopt;  // the channels of sensors have more values
    return std::ssize(test_.loads) + std::ssize(test_.deflections);
  }

  Result<Channels> run(Specimen& specimen) const override { return run_with_slopes(specimen, {}); }
  /// Only a finite-element tire has derivatives, a rolling tire has none. The reading of a sensor
  /// jumps as its position changes.
  bool tells_slopes(const SpecimenKind& kind, const std::string& channel) const override {
    return test_.friction.value_or(0.0) == 0.0 && test_.camber == 0.0 &&
           kind.has(IsPressed::kName) && channel != "peak_pressure" && channel != "pressure" &&
           !channel.starts_with("sensor_");
  }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    const auto printed = specimen.find<HasFootprint>()->print(test_, asked);
    if (!printed) return printed;
    return with_slopes_of(asked.channels, *printed);
  }
  std::vector<std::string> limits(Specimen& specimen) const override {
    std::vector<std::string> limits = limits_of_camber(specimen, test_.camber, /*rolls=*/false);
    std::ranges::move(limits_of_standing(specimen, test_.friction.value_or(0.0)),
                      std::back_inserter(limits));
    return limits;
  }
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    auto notes = Test::run_in_blocks(specimen, tell);
    if (!notes) return notes;
    for (std::string& limit : limits(specimen)) notes->push_back(std::move(limit));
    return notes;
  }
  Result<Details> details(Specimen& specimen) const override {
    const auto states = specimen.find<HasFootprint>()->footprints(test_);
    if (!states) return states.failure();
    return footprint_details(*states);
  }

 private:
  FootprintTest test_;
};

std::unique_ptr<Test> read_footprint(const Node& root, const TestSource& source) {
  return std::make_unique<StandingFootprintTest>(read_footprint_test(root, source.measured));
}

}  // namespace

const KeySection& footprint_keys();

const TestKind kFootprintTest = {"footprint",
                                 "stands: length, width, area of its patch",
                                 {HasFootprint::kName},
                                 read_footprint,
                                 footprint_keys};

}  // namespace latsch::experiment
