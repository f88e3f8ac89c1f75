// SPDX-License-Identifier: Apache-2.0
// kind = "steady_states": what a tire answers to a table of states (rigs/slip_states.h has its
// columns).
//
//   kind = "steady_states"
//   states = "cornering.csv"         # beside the file; or as they were measured:
//   states = {from = "measurement.cornering"}    # of a [measurement.NAME] of the study
//
// What was measured is resolved into numbers when the study is read: Fz has to be there, what was
// not recorded is left out. A journal depends on these numbers, not on the forces beside them.
#include <fmt/format.h>

#include "base/file.h"
#include "base/text.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/test.h"
#include "experiment/rigs/slip_states.h"

namespace latsch::experiment {

extern const TestKind kSteadyStates;
namespace {

class SteadyStatesTest : public Test {
 public:
  /// `text` of the table; an empty path: it stands in no file of its own.
  SteadyStatesTest(const std::string& text, const std::string& name, std::filesystem::path file)
      : text_(text), states_(formats::CsvTable::parse(text, name)), file_(std::move(file)) {}

  std::string in_words() const override { return fmt::format("{} steady states", states_.rows()); }
  std::string identity() const override { return "steady_states\n" + text_; }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    const Channels none = answers({});
    for (const Channel& channel : none.all()) channels.push_back({channel.name, channel.unit});
    return channels;
  }
  std::vector<std::string> needs() const override { return kSteadyStates.needs; }
  std::vector<std::filesystem::path> files() const override {
    return file_.empty() ? std::vector<std::filesystem::path>{} : std::vector{file_};
  }
  std::optional<long> samples() const override { return states_.rows(); }
  Result<Channels> run(Specimen& specimen) const override {
    return specimen.find<HasSteadyStates>()->steady(states_);
  }
  bool tells_slopes() const override { return true; }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    return specimen.find<HasSteadyStates>()->steady_with_slopes(states_, asked);
  }

 private:
  std::string text_;
  formats::CsvTable states_;
  std::filesystem::path file_;
};

/// nullopt where it is a text.
std::optional<Node> measured_states(const Node& root) {
  try {
    return root.find_table("states");
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::unique_ptr<Test> read_steady_states(const Node& root, const TestSource& source) {
  const auto measured = measured_states(root);
  if (!measured) {
    constexpr std::size_t kLargestTable = std::size_t{1} << 30;  // bytes
    const auto file = source.folder / root.text("states");
    return std::make_unique<SteadyStatesTest>(
        read_text_file(file, kLargestTable), file.string(), file);
  }
  const std::string from = measured->text("from");
  if (!source.measured)
    measured->reject("from", "is " + in_quotes(from) + ", which only a test of a study can name");
  std::vector<MeasuredCondition> wanted;
  for (const StateName& state : state_names())
    wanted.push_back({state.name, state.unit, state.name == "Fz"});
  return std::make_unique<SteadyStatesTest>(
      formats::csv_text(source.measured(*measured, wanted)), from, std::filesystem::path());
}

}  // namespace

const TestKind kSteadyStates = {"steady_states",
                                "rolls steadily in the states of a table",
                                {HasSteadyStates::kName},
                                read_steady_states};

}  // namespace latsch::experiment
