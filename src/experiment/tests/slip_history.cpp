// SPDX-License-Identifier: Apache-2.0
// kind = "slip_history": slips as recorded, sample by sample, with the lag of the tire's relaxation
// lengths (rigs/slip/slip_lag.h).
//
// Channels are those of steady_states, and the lagged slips "kappa" and "alpha". Relaxation lengths
// are those of the tire: of formula 6 from LATERAL_STIFFNESS and LONGITUDINAL_STIFFNESS, none if
// these are 0; of 5.2 from PTX1 to PTX3, PTY1 and PTY2.
//
// The keys are in experiment/tests/keys/slip_history_keys.cpp.
#include <fmt/format.h>

#include <algorithm>

#include "base/file.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/hub_frame.h"
#include "experiment/rigs/slip/slip_lag.h"
#include "experiment/rigs/slip/slip_states.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

constexpr const char* kNoTurnSlip =
    "a slip_history has no turn slip; steady_states with turn_slip = \"on\" computes with it";

class SlipHistoryTest : public Test, public TellsLimits {
 public:
  SlipHistoryTest(const std::string& text, const std::string& name, bool is_measured)
      : history_(formats::CsvTable::parse(text, name)), is_measured_(is_measured) {
    std::size_t sample = 0;
    if (const std::string why = no_record(history_.numbers("time", "s"), sample); !why.empty())
      throw InputError(history_.place(static_cast<int>(sample)), why);
  }

  std::string in_words() const override {
    return fmt::format("slips of {} samples, lagging", history_.rows());
  }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    const auto in_W = force_names({AxisFrame::W});
    const Channels none = answers({});
    for (const Channel& channel : none.all()) {
      const bool is_force = std::find(in_W.begin(), in_W.end(), channel.name) != in_W.end();
      channels.push_back(
          {channel.name, channel.unit, is_force ? name_of(AxisFrame::W) : std::string()});
    }
    channels.push_back({"kappa", "1"});
    channels.push_back({"alpha", "rad"});
    return channels;
  }
  std::vector<std::string> needs() const override { return kSlipHistoryTest.needs; }
  std::vector<Ledger> ledgers(const std::string& by) const override {
    if (is_measured_) return {};  // the measurement has a ledger of its own
    Ledger ledger = ledger_of_states(history_, by, kNoTurnSlip);
    if (LedgerRow* time = ledger.find_written("time")) Ledger::use(*time, by);
    return {std::move(ledger)};
  }
  std::vector<double> driven_at(const std::string& condition) const override {
    return values_of(history_, condition);
  }
  std::optional<long> samples() const override { return history_.rows(); }
  std::vector<std::string> limits(Specimen& specimen) const override {
    return specimen.find<LagsBehindSlips>()->limits_in_history(history_);
  }
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    const auto notes = Test::run_in_blocks(specimen, tell);
    if (!notes) return notes;
    return limits(specimen);
  }
  Result<Channels> run(Specimen& specimen) const override {
    return specimen.find<LagsBehindSlips>()->slip_history(history_, {});
  }
  bool tells_slopes(const SpecimenKind&, const std::string&) const override { return true; }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    return specimen.find<LagsBehindSlips>()->slip_history(history_, asked);
  }

 private:
  formats::CsvTable history_;
  bool is_measured_;  // true: from a measurement of the study, not a file
};

std::unique_ptr<Test> read_slip_history(const Node& root, const TestSource& source) {
  constexpr std::size_t kLargest = std::size_t{256} << 20;  // bytes
  if (const auto measured = find_measured(root, "states")) {
    std::vector<MeasuredCondition> wanted = {{"time", "s", true}};
    for (const MeasuredCondition& state : measured_states(kNoTurnSlip)) wanted.push_back(state);
    return std::make_unique<SlipHistoryTest>(
        formats::csv_text(take_measured(*measured, wanted, source.measured)),
        measured->text("from"),
        true);
  }
  const auto file = source.file(root, "states");
  return std::make_unique<SlipHistoryTest>(read_text_file(file, kLargest), file.string(), false);
}

}  // namespace

const KeySection& slip_history_keys();

const TestKind kSlipHistoryTest = {"slip_history",
                                   "rolls through slips as they were recorded, lagging",
                                   {LagsBehindSlips::kName},
                                   read_slip_history,
                                   slip_history_keys};

}  // namespace latsch::experiment
