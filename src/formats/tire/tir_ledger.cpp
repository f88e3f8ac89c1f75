// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_ledger.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/tire/tir_keys.h"
#include "formats/tire/tir_modes.h"
#include "formats/tire/tir_reader.h"

namespace latsch::formats {

namespace {

/// Adds a row for each parameter of a slow, standing or turning wheel that the file lacks and whose
/// value is assumed (models/magic_formula/standstill.h).
void add_assumed_at_rest(const TirFile& tir, Ledger& ledger) {
  struct Assumed {
    const char *name, *value;
  };
  constexpr Assumed kAssumed[] = {
      {"VXLOW", "is taken as 1 m/s: a slower wheel fades to one at rest"},
      {"DAMP_VLOW", "is taken as 1 ms: damping of a standing wheel"},
      {"QCRP1", "is taken as that of a round patch: torque of a wheel turned on the spot"},
      {"YAW_STIFFNESS", "is taken as that torque over 0.05 rad"}};
  const auto is_stated = [&](const char* name) {
    for (const TirKey& key : tir.keys)
      if (key.parameter == name)
        return key.parameter == "VXLOW" ||
               tir.parameters.*magic_formula::find_parameter(name)->member > 0.0;
    return false;
  };
  for (const Assumed& one : kAssumed) {
    if (is_stated(one.name)) continue;
    LedgerRow row;
    row.taken_as = one.name;
    row.state = LedgerState::assumed;
    row.remark = one.value;
    ledger.rows.push_back(std::move(row));
  }
}

/// Adds a row for the unit of pressure if the file uses it without stating it.
void add_unit_of_pressure(const TirFile& tir, const TeimOrbitUnits& units, Ledger& ledger) {
  const TeimOrbitSection* stated = tir.source.find("UNITS");
  const bool is_used = std::ranges::any_of(tir.keys, [](const TirKey& key) {
    return key.parameter == "INFLPRES" || key.parameter == "NOMPRES";
  });
  if (stated == nullptr || stated->has("PRESSURE") || !is_used) return;
  LedgerRow row;
  row.taken_as = "PRESSURE";
  row.state = LedgerState::assumed;
  row.remark = fmt::format("is taken as FORCE/LENGTH^2, {} Pa, because the file has no such line",
                           units.pressure());
  ledger.rows.push_back(std::move(row));
}

}  // namespace

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
  add_unit_of_pressure(tir, units, ledger);
  add_assumed_at_rest(tir, ledger);
  ledger.doubts = tir.doubts;
  return ledger;
}

}  // namespace latsch::formats
