// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_ledger.h"

#include "formats/tire/tir_keys.h"
#include "formats/tire/tir_modes.h"
#include "formats/tire/tir_reader.h"

namespace latsch::formats {

Ledger ledger_of(const TirFile& tir) {
  Ledger ledger{tir.source.file()};
  const TeimOrbitUnits units = tir.source.units(TeimOrbitUnits::Missing::is_si);
  for (const TirKey& key : tir.keys) {
    LedgerRow row;
    row.written = key.key;
    row.line = key.line;
    row.taken_as = key.parameter;
    row.meaning = key.section;
    row.remark = key.remark;
    const auto* field = magic_formula::find_parameter(key.parameter);
    if (field != nullptr) {
      const auto scale = tir.scales.find(field->name);
      row.factor =
          si_factor(field->unit, units) * (scale == tir.scales.end() ? 1.0 : scale->second);
    }
    const bool unused = key.parameter.empty() || reason_unused(key.key, "").has_value();
    row.state = key.remark == kUnknownKey ? LedgerState::doubtful
                : unused                  ? LedgerState::not_used
                                          : LedgerState::used;
    if (row.state == LedgerState::used) Ledger::use(row, "Magic Formula");
    if (key.parameter == "USE_MODE")
      row.meaning = key.section + "; asks for " + asked_by_use_mode(tir);
    ledger.rows.push_back(std::move(row));
  }
  for (const std::string& key : tir.assumed_units) {
    LedgerRow row;
    row.taken_as = key;
    row.state = LedgerState::assumed;
    row.remark =
        "is taken as " + TeimOrbitUnits::si_in_words(key) + ", because the file has no such line";
    ledger.rows.push_back(std::move(row));
  }
  ledger.doubts = tir.doubts;
  return ledger;
}

}  // namespace latsch::formats
