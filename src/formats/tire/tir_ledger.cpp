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

/// A coefficient that has an effect in one version of the Magic Formula alone.
struct OfOneVersion {
  const char* name;
  bool of_mf52;         // acts in MF 5.2; otherwise in MF 6.1 and 6.2
  const char* instead;  // the source of its quantity in the other version
};
constexpr OfOneVersion kOfOneVersion[] = {
    {"PKY6", false, "PHY3 shifts the side force with camber"},
    {"PKY7", false, "PHY3 shifts the side force with camber"},
    {"PPY5", false, "PHY3 shifts the side force with camber"},
    {"PHY3", true, "PKY6 and PKY7 are the camber stiffness"},
    {"PTX1", true, "relaxation lengths come from LONGITUDINAL_STIFFNESS"},
    {"PTX2", true, "relaxation lengths come from LONGITUDINAL_STIFFNESS"},
    {"PTX3", true, "relaxation lengths come from LONGITUDINAL_STIFFNESS"},
    {"PTY1", true, "relaxation lengths come from LATERAL_STIFFNESS"},
    {"PTY2", true, "relaxation lengths come from LATERAL_STIFFNESS"},
    {"LSGKP", true, "relaxation lengths come from LONGITUDINAL_STIFFNESS"},
    {"LSGAL", true, "relaxation lengths come from LATERAL_STIFFNESS"},
    {"LGAX", true, "the inclination has no scaling factors"},
    {"LGAY", true, "LKYC scales the camber stiffness"},
    {"LGAZ", true, "LKZC scales the camber torque"},
    {"Q_A1", true, "Q_RA1 and Q_RB1 are those of the contact patch"},
    {"Q_A2", true, "Q_RA2 and Q_RB2 are those of the contact patch"}};

/// Takes coefficients of another version than the file's for unused, and doubts those whose value
/// is not that of a file without them.
void add_other_version(const TirFile& tir, Ledger& ledger) {
  const bool is_mf52 = tir.parameters.version == magic_formula::Version::mf52;
  const char* const version = is_mf52 ? "MF 5.2" : "MF 6.1 and 6.2";
  std::string names;
  int line = 0;
  for (LedgerRow& row : ledger.rows) {
    const auto* one = std::ranges::find_if(
        kOfOneVersion, [&](const OfOneVersion& other) { return row.taken_as == other.name; });
    if (one == std::end(kOfOneVersion) || one->of_mf52 == is_mf52 || row.state != LedgerState::used)
      continue;
    row.state = LedgerState::not_used;
    row.used_by.clear();
    row.remark = fmt::format("has no effect in {}: {}", version, one->instead);
    const auto* field = magic_formula::find_parameter(one->name);
    if (tir.parameters.*field->member == field->fallback) continue;
    names += (names.empty() ? "" : ", ") + row.written;
    if (line == 0) line = row.line;
  }
  if (names.empty()) return;
  ledger.doubts.push_back(
      {names,
       fmt::format("{} {} no effect in {}, which the file states: is FITTYP right?",
                   names,
                   names.find(',') == names.npos ? "has" : "have",
                   version),
       {tir.source.file(), line}});
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
    const bool is_unit = key.section == "UNITS" && key.remark != kUnknownKey;
    const bool unused =
        !is_unit && (key.parameter.empty() || reason_unused(key.key, "").has_value());
    row.state = key.remark == kUnknownKey ? LedgerState::doubtful
                : unused                  ? LedgerState::not_used
                                          : LedgerState::used;
    if (row.state == LedgerState::used)
      Ledger::use(row, is_unit ? "all numbers of the file" : "Magic Formula");
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
  add_other_version(tir, ledger);
  return ledger;
}

}  // namespace latsch::formats
