// SPDX-License-Identifier: Apache-2.0
// kind = "steady_states": what a tire answers to a table of states (rigs/slip_states.h has its
// columns).
//
//   kind = "steady_states"
//   states = "cornering.csv"         # beside the file
#include <fmt/format.h>

#include "base/file.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/test.h"
#include "experiment/rigs/slip_states.h"

namespace latsch::experiment {

extern const TestKind kSteadyStates;
namespace {

class SteadyStatesTest : public Test {
 public:
  explicit SteadyStatesTest(formats::CsvTable states) : states_(std::move(states)) {}

  std::string in_words() const override { return fmt::format("{} steady states", states_.rows()); }
  std::string identity() const override {
    return "steady_states\n" + read_text_file(states_.file());
  }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    const Channels none = answers({});
    for (const Channel& channel : none.all()) channels.push_back({channel.name, channel.unit});
    return channels;
  }
  std::vector<std::string> needs() const override { return kSteadyStates.needs; }
  std::vector<std::filesystem::path> files() const override { return {states_.file()}; }
  std::optional<long> samples() const override { return states_.rows(); }
  Result<Channels> run(Specimen& specimen) const override {
    return specimen.find<HasSteadyStates>()->steady(states_);
  }
  bool tells_slopes() const override { return true; }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    return specimen.find<HasSteadyStates>()->steady_with_slopes(states_, asked);
  }

 private:
  formats::CsvTable states_;
};

std::unique_ptr<Test> read_steady_states(const Node& root, const std::filesystem::path& folder) {
  return std::make_unique<SteadyStatesTest>(formats::CsvTable::read(folder / root.text("states")));
}

}  // namespace

const TestKind kSteadyStates = {"steady_states",
                                "rolls steadily in the states of a table",
                                {HasSteadyStates::kName},
                                read_steady_states};

}  // namespace latsch::experiment
