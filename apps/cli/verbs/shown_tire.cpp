// SPDX-License-Identifier: Apache-2.0
// A Magic Formula tire to look at: its file as written, and what the tire does.
#include "cli/verbs/shown_file.h"
#include "experiment/kinds/slip_plots.h"
#include "formats/tire/tir_file.h"
#include "models/magic_formula/magic_formula.h"

namespace latsch::cli {

ShownFile shown_tire(const std::filesystem::path& tir) {
  const formats::TirFile file = formats::read_tir(tir);
  ShownFile shown;
  shown.kind = "Magic Formula tire (.tir)";
  shown.facts = file.notes;
  ShownTable table{"As written", {"section", "key", "value", "comment"}, {}};
  for (const auto& section : file.source.sections()) {
    for (const auto& entry : section.entries()) {
      table.rows.push_back({section.name(), entry.key, entry.value, entry.comment});
    }
  }
  shown.tables.push_back(std::move(table));
  shown.plots = experiment::slip_plots(magic_formula::MagicFormula(file.parameters));
  return shown;
}

}  // namespace latsch::cli
