// SPDX-License-Identifier: Apache-2.0
// The Magic Formula as a kind of specimen: rolling with relaxation, and in steady states.
#include <fmt/format.h>

#include "base/text.h"
#include "experiment/kinds/fitted_tir.h"
#include "experiment/kinds/magic_formula_ranges.h"
#include "experiment/kinds/pictures/slip_plots.h"
#include "experiment/kinds/rolling_specimen.h"
#include "experiment/kinds/specimen_kinds.h"
#include "experiment/kinds/tir_numbers.h"
#include "experiment/kinds/tire_sanity.h"
#include "experiment/language/known_limits.h"
#include "experiment/rigs/slip/slip_lag.h"
#include "experiment/rigs/slip/slip_states.h"
#include "experiment/rigs/slip/states_beyond.h"
#include "formats/tire/tir_file.h"
#include "models/magic_formula/limits/file_ranges.h"
#include "models/magic_formula/magic_formula_tire.h"
#include "models/magic_formula/tree/rolling_formula.h"
#include "report/report.h"

namespace latsch::experiment {
namespace {

using magic_formula::Conventions;
using magic_formula::MagicFormula;

constexpr int kStatesAtOnce = 8192;  // states

/// Returns a sentence if a test requests turn slip but the tire has none; else an empty text.
std::string no_turn_slip_in(const MagicFormula& tire, const Conventions& asked) {
  if (!asked.turn_slip || tire.conventions().turn_slip) return "";
  const std::string_view missing = tire.parameters().missing_of_turn_slip();
  if (missing == "QDZ10" || missing == "LKZC")
    return fmt::format(
        "{} is 0, so that the tire has no stiffness against spin, by which the equations of turn "
        "slip divide (4.100): turn_slip = \"on\" has no effect",
        missing);
  return fmt::format(
      "the tire has no turn slip coefficients ({} is 0): turn_slip = \"on\" has no effect",
      missing);
}

/// Returns what has to be known of turn slip in these states, one sentence each.
std::vector<std::string> turn_slip_in(const MagicFormula& tire,
                                      const formats::CsvTable& table,
                                      const Conventions& asked) {
  if (std::string none = no_turn_slip_in(tire, asked); !none.empty()) return {none};
  const Conventions& conventions = tire.conventions();
  if (!conventions.turn_slip || conventions.spin_of_book) return {};
  const std::vector<double> gamma = values_of(table, "gamma");
  if (std::ranges::all_of(gamma, [](double g) { return g == 0.0; })) return {};
  return {
      "turn_slip = \"on\" has the camber's sign of the program MFeval: the camber "
      "force points to the other side than without turn slip; turn_slip = \"book\" keeps its side"};
}

class MagicFormulaSpecimen : public RollingSpecimen,
                             public HasSteadyStates,
                             public LagsBehindSlips,
                             public KnowsLimits {
 public:
  explicit MagicFormulaSpecimen(const Document& numbers)
      : rolling_(numbers), parameters_(rolling_.parameters()) {}

  std::unique_ptr<Tire> tire(const Inflation& pressure) const override {
    return rolling_.tire(pressure);
  }
  std::vector<std::string> limits_met() const override { return rolling_.limits_met(); }
  std::vector<std::string> limits_when_driven(const DrivenWheel& driven) const override {
    return limits_when_driven_of(parameters_, driven);
  }
  bool is_limit(const std::string& path) const override {
    return magic_formula::is_end_of_range(path);
  }
  void stood_under(double load) override { rolling_.stood_under(load); }
  std::string no_stiffness(const std::string& direction) const override {
    return no_stiffness_of(parameters_, direction);
  }
  std::string assumed_stiffness(const std::string& direction) const override {
    return assumed_stiffness_of(parameters_, direction);
  }
  std::optional<double> section_height() const override { return section_height_of(parameters_); }
  std::optional<double> tread_half_width() const override {
    return tread_half_width_of(parameters_);
  }
  std::vector<std::string> limits_on(const Cleat&) const override {
    return {
        "a Magic Formula touches the road at one point: it stands on a cleat as on flat ground, "
        "and "
        "its forces leap where the point steps onto the cleat and off it; a rigid or flexible ring "
        "feels the cleat's length"};
  }
  std::vector<std::string> limits_at_camber(bool rolls) const override {
    return upright_footprint(rolls);
  }
  std::vector<std::string> limits_backward() const override {
    return limits_backward_of(parameters_);
  }
  Result<Channels> steady(const formats::CsvTable& table,
                          const SteadyConditions& conditions) override {
    refuse_soft_pressures(table);
    return answers(MagicFormula(parameters_, conditions.conventions),
                   slip_states(table, parameters_).states);
  }
  Result<std::vector<std::string>> steady_in_blocks(
      const formats::CsvTable& table,
      const SteadyConditions& conditions,
      const std::function<void(const Channels&)>& tell) override {
    refuse_soft_pressures(table);
    const MagicFormula tire(parameters_, conditions.conventions);
    std::vector<magic_formula::SteadyState> results;
    StatesBeyond beyond;
    const auto unused = for_slip_states(table, parameters_, kStatesAtOnce, [&](auto& states) {
      results.resize(states.size());
      tire.evaluate(states, results);
      beyond.add(states, parameters_);
      tell(answers(results));
    });
    std::vector<std::string> notes;
    for (const std::string& column : unused)
      notes.push_back(fmt::format("{}: column {} is not used", table.file(), in_quotes(column)));
    for (std::string& one : beyond.sentences(parameters_, tire.conventions().limits))
      notes.push_back(std::move(one));
    if (const std::string assumed = assumed_states(table, parameters_); !assumed.empty())
      notes.push_back(table.file() + ": " + assumed);
    if (!values_of(table, "p").empty() && !magic_formula::pressure_acts(parameters_))
      notes.push_back("column p has no effect: " + magic_formula::no_pressure_in_words());
    for (std::string& one : turn_slip_in(tire, table, conditions.conventions))
      notes.push_back(std::move(one));
    return notes;
  }
  std::vector<std::string> limits_in(const formats::CsvTable& table,
                                     const SteadyConditions& conditions) override {
    const Conventions& conventions = conditions.conventions;
    StatesBeyond beyond;
    for_slip_states(
        table, parameters_, kStatesAtOnce, [&](auto& states) { beyond.add(states, parameters_); });
    std::vector<std::string> sentences = beyond.sentences(parameters_, conventions.limits);
    for (std::string& one :
         turn_slip_in(MagicFormula(parameters_, conventions), table, conventions))
      sentences.push_back(std::move(one));
    return sentences;
  }
  std::vector<std::string> limits_in_history(
      const formats::CsvTable& table, const SlipHistoryConditions& conditions) const override {
    refuse_step(conditions);
    const auto states = slip_states(table, parameters_).states;
    StatesBeyond beyond;
    beyond.add(states, parameters_);
    std::vector<std::string> sentences = beyond.sentences(parameters_, true, false);
    for (std::string& one :
         lag_limits(MagicFormula(parameters_, {}), states, table.numbers("time", "s")))
      sentences.push_back(std::move(one));
    return sentences;
  }
  Result<Channels> steady_with_slopes(const formats::CsvTable& table,
                                      const SteadyConditions& conditions,
                                      const Asked& asked) override {
    const MagicFormula tire(parameters_, conditions.conventions);
    const SlipStates given = slip_states(table, parameters_);
    return with_slopes(
        answers(tire, given.states), tire, given.states, asked.channels, asked.paths);
  }
  Result<Channels> slip_history(const formats::CsvTable& table,
                                const SlipHistoryConditions& conditions,
                                const Asked& asked,
                                std::vector<std::string>&) override {
    refuse_step(conditions);
    return lagging_answers(MagicFormula(parameters_, {}),
                           slip_states(table, parameters_).states,
                           table.numbers("time", "s"),
                           asked.channels,
                           asked.paths);
  }

 private:
  static void refuse_step(const SlipHistoryConditions& conditions) {
    if (!conditions.step) return;
    throw InputError(fmt::format(
        "the step of a slip_history is {:.4g} ms, and a Magic Formula has no steps of time, since "
        "its lag is exact between samples: expected no `step`",
        1e3 * *conditions.step));
  }
  void refuse_soft_pressures(const formats::CsvTable& table) const {
    const std::vector<double> pressures = values_of(table, "p");
    for (std::size_t row = 0; row < pressures.size(); ++row)
      rolling_.refuse_soft_pressure(pressures[row], table.place(static_cast<int>(row)));
    if (pressures.empty())
      rolling_.refuse_soft_pressure(parameters_.INFLPRES, {rolling_.file(), 0});
  }

  magic_formula::RollingFormula rolling_;
  magic_formula::Parameters parameters_;
};

class MagicFormulaKind : public SpecimenKind {
 public:
  std::string name() const override { return "magic_formula"; }
  std::string in_words() const override { return "Magic Formula"; }
  std::string file() const override { return "a .tir file"; }
  int version() const override { return 3; }
  std::vector<std::string> abilities() const override {
    return abilities_of<MagicFormulaSpecimen>();
  }

  bool recognizes(const std::filesystem::path& file) const override {
    return file.extension() == ".tir";
  }
  Document read(const std::filesystem::path& file) const override { return read_tir_numbers(file); }
  std::string describe(const Document& numbers) const override {
    return SpecimenKind::describe(numbers) + ", " + side_in_words(numbers);
  }
  std::vector<std::string> notes(const std::filesystem::path& file) const override {
    return tir_notes(file);
  }
  std::unique_ptr<Specimen> build(const Document& numbers,
                                  std::unique_ptr<Specimen>) const override {
    return std::make_unique<MagicFormulaSpecimen>(numbers);
  }
  void check(const Document& numbers) const override { MagicFormulaSpecimen(numbers).tire({}); }
  bool knows_slopes_in(const std::string& path) const override {
    return magic_formula::find_parameter(path) != nullptr;
  }
  std::optional<UsualRange> usual_range(const std::string& path) const override {
    return usual_range_of(path);
  }
  std::optional<Size> size(const Document& numbers) const override { return tir_size(numbers); }
  std::string text(const Document& numbers) const override { return tir_text_of(numbers); }
  std::string annotated_text(const Document& numbers, const Provenance& provenance) const override {
    return fitted_tir_text(numbers, provenance);
  }
  std::vector<FaultBeyondData> faults_beyond_data(const Document& numbers,
                                                  const MeasuredAt& values_of) const override {
    return tire_faults(numbers, values_of);
  }
  void draw(const Document& numbers,
            const std::vector<const Test*>&,
            Thoroughness,
            report::StudyReport& page) const override {
    const MagicFormula tire(parameters_of(numbers));
    if (!page.fitted_by) {
      page.slip_plots = slip_plots(tire);
      return;
    }
    const SlipKnowledge knowledge{known_coefficients(numbers.file(), page.fitted_by->paths),
                                  page.fitted_by->measured_at};
    page.slip_plots = slip_plots(tire, &knowledge);
  }
};

}  // namespace

const SpecimenKind& magic_formula_kind() {
  static const MagicFormulaKind kind;
  return kind;
}

}  // namespace latsch::experiment
