// SPDX-License-Identifier: Apache-2.0
// kind = "steady_states": forces of a tire in a table of states (rigs/slip/slip_states.h).
//
// A measurement is resolved into numbers when the study is read: Fz is required, quantities that
// were not recorded are left out. A journal depends on these numbers, not on the measured forces.
// A table of few states may stand in the test itself; a quantity with one value there has it in all
// states.
//
// A Magic Formula has the friction of its coefficients. A finite-element tire takes it from the
// test, else from its file (rigs/fe_rolling/steady_table.h).
//
// latsch test computes a table of any length block by block. A file above 16 MB is not copied into
// memory, and must not be written to while it is read.
//
// The keys are in experiment/tests/keys/steady_states_keys.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "base/file.h"
#include "base/mapped_file.h"
#include "experiment/language/capabilities.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/fe_tire/rolling_rig.h"
#include "experiment/rigs/hub_frame.h"
#include "experiment/rigs/slip/slip_states.h"
#include "experiment/tests/test_kinds.h"

namespace latsch::experiment {
namespace {

using magic_formula::Angles;
using magic_formula::Conventions;

/// Returns why a column phit has no effect; empty if it has.
std::string no_turn_slip(const Conventions& conventions) {
  if (conventions.turn_slip) return "";
  return "turn_slip of the test is \"off\"; turn_slip = \"on\" computes with it";
}

class SteadyStatesTest : public Test, public TellsLimits {
 public:
  SteadyStatesTest(std::shared_ptr<const MappedFile> table,
                   const std::string& name,
                   const SteadyConditions& conditions,
                   bool is_measured)
      : states_(formats::CsvTable::parse(std::move(table), name)),
        conditions_(conditions),
        is_measured_(is_measured) {}

  std::string in_words() const override {
    return fmt::format(
        "{} steady states{}",
        states_.rows(),
        conditions_.friction ? fmt::format(", friction {:.3g}", *conditions_.friction) : "");
  }
  std::vector<ChannelInfo> channels() const override {
    std::vector<ChannelInfo> channels;
    const Channels none = answers({});
    const auto in_W = force_names({AxisFrame::W});
    for (const Channel& channel : none.all()) {
      const bool is_force = std::find(in_W.begin(), in_W.end(), channel.name) != in_W.end();
      channels.push_back(
          {channel.name, channel.unit, is_force ? name_of(AxisFrame::W) : std::string()});
    }
    return channels;
  }
  std::vector<std::string> needs() const override {
    if (conditions_.friction) return {TakesConditions::kName};
    return kSteadyStatesTest.needs;
  }
  std::vector<Ledger> ledgers(const std::string& by) const override {
    if (is_measured_) return {};  // the measurement has a ledger of its own
    return {ledger_of_states(states_, by, no_turn_slip(conditions_.conventions))};
  }
  std::vector<double> driven_at(const std::string& condition) const override {
    return values_of(states_, condition);
  }
  std::optional<long> samples() const override { return states_.rows(); }
  std::vector<std::string> limits(Specimen& specimen) const override {
    return specimen.find<HasSteadyStates>()->limits_in(states_, conditions_);
  }
  Result<Channels> run(Specimen& specimen) const override {
    return specimen.find<HasSteadyStates>()->steady(states_, conditions_);
  }
  Result<std::vector<std::string>> run_in_blocks(
      Specimen& specimen, const std::function<void(const Channels&)>& tell) const override {
    return specimen.find<HasSteadyStates>()->steady_in_blocks(states_, conditions_, tell);
  }
  bool tells_slopes(const SpecimenKind& kind, const std::string& channel) const override {
    return !kind.has(IsFeTire::kName) || has_rolling_slopes(channel);
  }
  Result<Channels> run_with_slopes(Specimen& specimen, const Asked& asked) const override {
    return specimen.find<HasSteadyStates>()->steady_with_slopes(states_, conditions_, asked);
  }

 protected:
  RigSettings rig_settings() const override { return &conditions_; }

 private:
  formats::CsvTable states_;
  SteadyConditions conditions_;
  bool is_measured_;  // true: from a measurement of the study, not a file
};

constexpr std::size_t kKept = std::size_t{16} << 20;         // bytes
constexpr std::size_t kLargestTable = std::size_t{1} << 30;  // bytes

/// Keeps the table in memory unless it is long: a file may be written to while a study runs for
/// hours.
std::shared_ptr<const MappedFile> table_of(const std::filesystem::path& file) {
  std::error_code unknown;  // error of a missing file
  const auto size = std::filesystem::file_size(file, unknown);
  if (!unknown && size <= kKept) return std::make_shared<MappedFile>(read_text_file(file));
  return std::make_shared<MappedFile>(file, kLargestTable);
}

Conventions read_conventions(const Node& root) {
  Conventions conventions;
  conventions.limits = root.choice("limits", {"on", "off"}, "on") == "on";
  if (root.choice("angles", {"direct", "tangent"}, "direct") == "tangent")
    conventions.angles = Angles::tangent;
  const std::string turn_slip = root.choice("turn_slip", {"off", "on", "book"}, "off");
  conventions.turn_slip = turn_slip != "off";
  conventions.spin_of_book = turn_slip == "book";
  conventions.mirrored = root.choice("side", {"measured", "other"}, "measured") == "other";
  return conventions;
}

SteadyConditions read_conditions(const Node& root) {
  SteadyConditions conditions{read_conventions(root)};
  if (root.has("friction"))
    conditions.friction = root.quantity("friction", "1", Range::between(0.0, 5.0));
  return conditions;
}

/// Returns the table {Fz = "4 kN", alpha = ["0 deg", "2 deg"]} under `states`; nullopt if the key
/// names a file.
std::optional<Node> find_stated(const Node& root) {
  try {
    return root.find_table("states");
  } catch (const InputError&) {  // the key holds the name of a file
    return std::nullopt;
  }
}

/// True for a state that is above 0: the load and the pressure.
bool is_positive(const MeasuredCondition& state) { return state.is_needed || state.unit == "Pa"; }

/// Reads states that stand in the test. Throws if two quantities have different numbers of values.
Channels stated_states(const Node& table) {
  std::vector<Channel> columns;
  std::size_t rows = 1;
  for (const MeasuredCondition& state : measured_states()) {
    if (!state.is_needed && !table.has(state.channel)) continue;
    columns.push_back(
        {state.channel,
         state.unit,
         table.one_or_more(
             state.channel, state.unit, is_positive(state) ? Range::positive() : Range{})});
    const std::size_t count = columns.back().values.size();
    if (count == 0 || (count > 1 && rows > 1 && count != rows))
      table.reject(state.channel,
                   fmt::format("has {} values beside {} of another state, expected one for all "
                               "states or equally many",
                               count,
                               rows));
    rows = std::max(rows, count);
  }
  Channels states;
  for (Channel& column : columns) {
    if (column.values.size() == 1) column.values.resize(rows, column.values.front());
    states.add(std::move(column));
  }
  return states;
}

/// Throws InputError if the file is a recording of another format than a table, such as TYDEX.
void expect_table(const Node& root, const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  // The readers of these formats are not named here, because exported units would contain them.
  constexpr std::array kRecordings{
      ".tdx", ".tydex", ".mat", ".mf4", ".uff", ".tdms", ".rsp", ".ld"};
  if (std::ranges::count(kRecordings, ending) == 0) return;
  root.reject("states",
              "names " + in_quotes(file.filename().string()) +
                  ", which ends as a recording, expected a table (.csv); a study takes states of a "
                  "recording by states = {from = \"measurement.NAME\"}");
}

std::unique_ptr<Test> read_steady_states(const Node& root, const TestSource& source) {
  const auto measured = find_measured(root, "states");
  const SteadyConditions conditions = read_conditions(root);
  const auto stated = measured ? std::nullopt : find_stated(root);
  if (stated)
    return std::make_unique<SteadyStatesTest>(
        std::make_shared<MappedFile>(formats::csv_text(stated_states(root.table("states")))),
        stated->path(),
        conditions,
        false);
  if (!measured) {
    const auto file = source.file(root, "states");
    expect_table(root, file);
    return std::make_unique<SteadyStatesTest>(table_of(file), file.string(), conditions, false);
  }
  const std::string from = measured->text("from");
  return std::make_unique<SteadyStatesTest>(
      std::make_shared<MappedFile>(formats::csv_text(take_measured(
          *measured, measured_states(no_turn_slip(conditions.conventions)), source.measured))),
      from,
      conditions,
      true);
}

}  // namespace

const KeySection& steady_states_keys();

const TestKind kSteadyStatesTest = {"steady_states",
                                    "rolls steadily in the states of a table",
                                    {HasSteadyStates::kName},
                                    read_steady_states,
                                    steady_states_keys};

}  // namespace latsch::experiment
