// SPDX-License-Identifier: Apache-2.0
// The Magic Formula as a kind of tire: rolling with relaxation, and in steady states.
#include "experiment/kinds/tir_numbers.h"
#include "experiment/kinds/tire_kind.h"
#include "experiment/rigs/slip_states.h"
#include "models/magic_formula/magic_formula_tire.h"

namespace latsch::experiment {
namespace {

using magic_formula::MagicFormulaTire;

std::unique_ptr<Tire> build_magic_formula(const Document& numbers) {
  return std::make_unique<MagicFormulaTire>(parameters_of(numbers));
}

Channels steady(const Document& numbers, const formats::CsvTable& table) {
  const magic_formula::Parameters parameters = parameters_of(numbers);
  const SlipStates given = slip_states(table, parameters);
  const magic_formula::MagicFormula formula(parameters, {});
  std::vector<magic_formula::SteadyState> results(given.states.size());
  formula.evaluate(given.states, results);
  return answers(results);
}

}  // namespace

extern const TireKind kMagicFormulaKind;
const TireKind kMagicFormulaKind = {"magic_formula",
                                    "Magic Formula",
                                    "a .tir file",
                                    read_tir_numbers,
                                    build_magic_formula,
                                    tir_text_of,
                                    steady};

}  // namespace latsch::experiment
