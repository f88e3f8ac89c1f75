// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/ledgers/study_ledgers.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "base/units.h"
#include "correlation/study/ledgers/file_ledgers.h"
#include "formats/tables/csv_table.h"

namespace latsch::correlation {

namespace {

/// Adds the ledger of a table whose reader rejects every unused column, such as load-deflection
/// curves and modes.
void add_table(const std::filesystem::path& file,
               const std::string& by,
               std::vector<Ledger>& ledgers) {
  if (file.extension() != ".csv" || !std::filesystem::exists(file)) return;
  const auto table = formats::CsvTable::read(file);
  Ledger ledger{file.string()};
  for (const std::string& column : table.columns()) {
    LedgerRow row;
    row.written = row.taken_as = column;
    row.line = table.header_place().line;
    row.column = static_cast<int>(ledger.rows.size()) + 1;
    row.unit_written = table.unit(column);
    if (const auto unit = Unit::find(row.unit_written); unit && !row.unit_written.empty()) {
      row.unit = si_unit(unit->dimension());
      row.offset = unit->to_si(0.0L);
      row.factor = unit->to_si(1.0L) - row.offset;
    }
    Ledger::use(row, by);
    ledger.rows.push_back(std::move(row));
  }
  ledgers.push_back(std::move(ledger));
}

}  // namespace

std::vector<Ledger> ledgers_of(const Study& study) {
  return ledgers_of(study.laboratory, study.experiments, study.tests);
}

std::vector<Ledger> ledgers_of(const Laboratory& laboratory,
                               const std::vector<StudyExperiment>& experiments,
                               const std::vector<StudyTest>& tests) {
  std::vector<Ledger> all;
  std::set<const Measurement*> seen;
  const auto add = [&](const std::shared_ptr<const Measurement>& measurement) {
    if (!measurement || !seen.insert(measurement.get()).second) return;
    for (Ledger& ledger : measurement->ledgers()) all.push_back(std::move(ledger));
  };
  for (const auto& measurement : laboratory) add(measurement);
  for (const StudyExperiment& experiment : experiments) {
    add(experiment.read_from);
    if (experiment.read_from) continue;
    for (const auto* file : {&experiment.measurement_file, &experiment.shapes_file})
      add_table(*file, "experiment " + experiment.name, all);
  }
  for (const StudyTest& test : tests)
    for (Ledger& ledger : test.test->ledgers(test.in_words())) all.push_back(std::move(ledger));
  return all;
}

std::vector<Ledger> all_ledgers_of(const Study& study) {
  std::vector<Ledger> all = ledgers_of(study);
  for (Ledger& ledger : ledgers_of_opened_files(study, all)) all.push_back(std::move(ledger));
  return all;
}

void refuse_doubtful(const std::vector<Ledger>& ledgers) {
  for (const Ledger& ledger : ledgers)
    for (const LedgerDoubt& doubt : ledger.doubts)
      if (doubt.is_error) throw InputError(doubt.place, doubt.sentence);
}

nlohmann::ordered_json json_of(const Ledger& ledger) {
  nlohmann::ordered_json json = {{"file", ledger.file},
                                 {"summary", in_one_line(ledger)},
                                 {"rows", nlohmann::ordered_json::array()},
                                 {"doubts", nlohmann::ordered_json::array()}};
  for (const LedgerRow& row : ledger.rows)
    json["rows"].push_back({{"written", row.written},
                            {"line", row.line},
                            {"column", row.column},
                            {"taken_as", row.taken_as},
                            {"meaning", row.meaning},
                            {"unit_written", row.unit_written},
                            {"unit", row.unit},
                            {"factor", row.factor},
                            {"offset", row.offset},
                            {"axes", row.axes},
                            {"used_by", row.used_by},
                            {"state", name_of(row.state)},
                            {"remark", row.remark}});
  for (const LedgerDoubt& doubt : ledger.doubts)
    json["doubts"].push_back({{"name", doubt.name},
                              {"sentence", doubt.sentence},
                              {"file", doubt.place.file},
                              {"line", doubt.place.line},
                              {"is_error", doubt.is_error}});
  return json;
}

}  // namespace latsch::correlation
