// SPDX-License-Identifier: Apache-2.0
// Ledgers of all files with measured numbers that a study reads: its [measurement.NAME], files that
// experiments name, tables of its tests.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "correlation/study/study.h"
#include "measurement/ledger.h"

namespace latsch::correlation {

/// Returns the ledgers in the order measurements, experiments, tests, each in the order of the
/// file.
std::vector<Ledger> ledgers_of(const Study& study);

/// Throws InputError for the first doubt that is an error, naming file, line and column.
void refuse_doubtful(const std::vector<Ledger>& ledgers);

/// Returns {"file", "summary", "rows": [...], "doubts": [...]}.
nlohmann::ordered_json json_of(const Ledger& ledger);

}  // namespace latsch::correlation
