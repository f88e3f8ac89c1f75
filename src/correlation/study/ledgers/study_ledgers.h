// SPDX-License-Identifier: Apache-2.0
// The ledgers of all files that a study reads: its [measurement.NAME], files that experiments name,
// tables of its tests, and the model, the tests and the files that these name (file_ledgers.h).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "correlation/study/study.h"
#include "measurement/ledger.h"

namespace latsch::correlation {

/// Returns the ledgers of files with measured numbers, in the order of the study file:
/// measurements, experiments, tests.
std::vector<Ledger> ledgers_of(const Study& study);

/// Returns these ledgers for parts of a study, or for a suite of checks.
std::vector<Ledger> ledgers_of(const Laboratory& laboratory,
                               const std::vector<StudyExperiment>& experiments,
                               const std::vector<StudyTest>& tests);

/// Returns the ledgers of the measurements, followed by those of every other file that the study
/// opens.
std::vector<Ledger> all_ledgers_of(const Study& study);

/// Throws InputError for the first doubt that is an error, naming file, line and column.
void refuse_doubtful(const std::vector<Ledger>& ledgers);

/// Returns the ledger as JSON: {"file", "summary", "rows": [...], "doubts": [...]}.
nlohmann::ordered_json json_of(const Ledger& ledger);

}  // namespace latsch::correlation
