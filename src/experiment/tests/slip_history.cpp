// SPDX-License-Identifier: Apache-2.0
// kind = "slip_history": slips as recorded, sample by sample, which the tire's forces follow.
//
// A Magic Formula lags by its relaxation lengths (rigs/slip/slip_lag.h), and has the lagged slips
// "kappa" and "alpha" as channels besides those of steady_states. Formula 6 has its lengths from
// LATERAL_STIFFNESS and LONGITUDINAL_STIFFNESS, none if these are 0, formula 5.2 from PTX1 to PTX3,
// PTY1 and PTY2. A finite-element tire rolls in time (rigs/fe_rolling/slip_record.h).
//
// The keys are in experiment/tests/keys/slip_history_keys.cpp.
#include <fmt/format.h>

#include <algorithm>

#include "base/file.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/duration_limit.h"
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
  SlipHistoryTest(const std::string& text,
                  const std::string& name,
                  const SlipHistoryConditions& conditions,
                  bool is_measured)
      : history_(formats::CsvTable::parse(text, name)),
        conditions_(conditions),
        is_measured_(is_measured) {
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
  std::vector<std::string> needs() const override {
    if (conditions_.friction) return {TakesConditions::kName};
    return kSlipHistoryTest.needs;
  }
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
    return specimen.find<LagsBehindSlips>()->limits_in_history(history_, conditions_);
  }
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    std::vector<std::string> notes = limits(specimen);
    const Status done =
        specimen.find<LagsBehindSlips>()->history_in_blocks(history_, conditions_, tell, notes);
    if (!done) return done.failure();
    return notes;
  }
  Result<Channels> run(Specimen& specimen) const override { return run_with_slopes(specimen, {}); }
  bool tells_slopes(const SpecimenKind& kind, const std::string&) const override {
    return !kind.has(IsFeTire::kName);
  }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    std::vector<std::string> remarks;
    auto channels =
        specimen.find<LagsBehindSlips>()->slip_history(history_, conditions_, asked, remarks);
    for (const std::string& remark : remarks) record_limit(specimen, remark);
    return channels;
  }

 private:
  formats::CsvTable history_;
  SlipHistoryConditions conditions_;
  bool is_measured_;  // true: from a measurement of the study, not a file
};

std::unique_ptr<Test> read_slip_history(const Node& root, const TestSource& source) {
  constexpr std::size_t kLargest = std::size_t{256} << 20;  // bytes
  SlipHistoryConditions conditions;
  if (root.has("friction"))
    conditions.friction = root.quantity("friction", "1", Range::between(0.0, 5.0));
  if (root.has("step"))
    conditions.step = root.quantity("step", "s", Range::between(kShortestStep, 0.1));
  if (const auto measured = find_measured(root, "states")) {
    std::vector<MeasuredCondition> wanted = {{"time", "s", true}};
    for (const MeasuredCondition& state : measured_states(kNoTurnSlip)) wanted.push_back(state);
    return std::make_unique<SlipHistoryTest>(
        formats::csv_text(take_measured(*measured, wanted, source.measured)),
        measured->text("from"),
        conditions,
        true);
  }
  const auto file = source.file(root, "states");
  return std::make_unique<SlipHistoryTest>(
      read_text_file(file, kLargest), file.string(), conditions, false);
}

}  // namespace

const KeySection& slip_history_keys();

const TestKind kSlipHistoryTest = {"slip_history",
                                   "rolls through slips as they were recorded, lagging",
                                   {LagsBehindSlips::kName},
                                   read_slip_history,
                                   slip_history_keys};

}  // namespace latsch::experiment
