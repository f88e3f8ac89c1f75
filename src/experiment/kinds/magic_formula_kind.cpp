// SPDX-License-Identifier: Apache-2.0
// The Magic Formula as a kind of specimen: rolling with relaxation, and in steady states.
#include "experiment/kinds/magic_formula_ranges.h"
#include "experiment/kinds/rolling_specimen.h"
#include "experiment/kinds/slip_plots.h"
#include "experiment/kinds/tir_numbers.h"
#include "experiment/rigs/slip_states.h"
#include "models/magic_formula/magic_formula_tire.h"
#include "report/report.h"

namespace latsch::experiment {
namespace {

class MagicFormulaSpecimen : public RollingSpecimen, public HasSteadyStates {
 public:
  explicit MagicFormulaSpecimen(const Document& numbers) : parameters_(parameters_of(numbers)) {}

  std::unique_ptr<Tire> tire() const override {
    return std::make_unique<magic_formula::MagicFormulaTire>(parameters_);
  }
  Channels steady(const formats::CsvTable& table) const override {
    return answers(formula(), slip_states(table, parameters_).states);
  }
  Channels steady_with_slopes(const formats::CsvTable& table, const Asked& asked) const override {
    const SlipStates given = slip_states(table, parameters_);
    return with_slopes(
        answers(formula(), given.states), formula(), given.states, asked.channels, asked.paths);
  }

 private:
  magic_formula::MagicFormula formula() const {
    return magic_formula::MagicFormula(parameters_, {});
  }

  magic_formula::Parameters parameters_;
};

class MagicFormulaKind : public SpecimenKind {
 public:
  std::string name() const override { return "magic_formula"; }
  std::string in_words() const override { return "Magic Formula"; }
  std::string file() const override { return "a .tir file"; }
  int version() const override { return 2; }
  std::vector<std::string> abilities() const override {
    return abilities_of<MagicFormulaSpecimen>();
  }

  bool recognizes(const std::filesystem::path& file) const override {
    return file.extension() == ".tir";
  }
  Document read(const std::filesystem::path& file) const override { return read_tir_numbers(file); }
  std::unique_ptr<Specimen> build(const Document& numbers,
                                  std::unique_ptr<Specimen>) const override {
    return std::make_unique<MagicFormulaSpecimen>(numbers);
  }
  void check(const Document& numbers) const override { MagicFormulaSpecimen(numbers).tire(); }
  bool knows_slopes_in(const std::string& path) const override {
    return magic_formula::find_parameter(path) != nullptr;
  }
  std::optional<UsualRange> usual_range(const std::string& path) const override {
    return usual_range_of(path);
  }
  std::string text(const Document& numbers) const override { return tir_text_of(numbers); }
  void draw(const Document& numbers,
            const std::vector<const Test*>&,
            Thoroughness,
            report::StudyReport& page) const override {
    page.slip_plots = slip_plots(magic_formula::MagicFormula(parameters_of(numbers)));
  }
};

}  // namespace

const SpecimenKind& magic_formula_kind() {
  static const MagicFormulaKind kind;
  return kind;
}

}  // namespace latsch::experiment
