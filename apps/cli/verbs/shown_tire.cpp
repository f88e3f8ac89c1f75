// SPDX-License-Identifier: Apache-2.0
// Implements `latsch show` for a Magic Formula tire: its file as written, and the forces of the
// tire.
#include <map>

#include "cli/verbs/shown_file.h"
#include "experiment/kinds/pictures/slip_plots.h"
#include "formats/tire/tir_file.h"
#include "models/magic_formula/magic_formula.h"

namespace latsch::cli {

ShownFile shown_tire(const std::filesystem::path& tir) {
  const formats::TirFile file = formats::read_tir(tir);
  ShownFile shown;
  shown.kind = "Magic Formula tire (.tir)";
  shown.facts = file.notes;
  std::map<int, const formats::TirKey*> taken;  // keys are line numbers
  for (const formats::TirKey& key : file.keys) taken[key.line] = &key;
  ShownTable table{"As written, and what it is taken for",
                   {"section", "key", "value", "taken as", "remark", "comment"},
                   {}};
  for (const auto& section : file.source.sections()) {
    for (const auto& entry : section.entries()) {
      const auto key = taken.find(entry.line);
      const bool known = key != taken.end();
      table.rows.push_back({section.name(),
                            entry.key,
                            entry.value,
                            known && !key->second->parameter.empty() ? key->second->parameter : "-",
                            known ? key->second->remark : "",
                            entry.comment});
    }
  }
  shown.tables.push_back(std::move(table));
  shown.plots = experiment::slip_plots(magic_formula::MagicFormula(file.parameters));
  return shown;
}

}  // namespace latsch::cli
