// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/ledgers/study_ledgers.h"

#include <nlohmann/json.hpp>
#include <set>

namespace latsch::correlation {

std::vector<Ledger> ledgers_of(const Study& study) {
  std::vector<Ledger> all;
  std::set<const Measurement*> seen;
  const auto add = [&](const std::shared_ptr<const Measurement>& measurement) {
    if (!measurement || !seen.insert(measurement.get()).second) return;
    for (Ledger& ledger : measurement->ledgers()) all.push_back(std::move(ledger));
  };
  for (const auto& measurement : study.laboratory) add(measurement);
  for (const StudyExperiment& experiment : study.experiments) add(experiment.read_from);
  for (const StudyTest& test : study.tests)
    for (Ledger& ledger : test.test->ledgers(test.in_words())) all.push_back(std::move(ledger));
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
