// SPDX-License-Identifier: Apache-2.0
// Builds the ledgers of files that are no tables of measured channels: a model, a test, a road, a
// bushing, a deck, and the files that they name. Files whose readers list their keys (.toml, .tir)
// have a row for each key; any other file has one row, which states as what it was read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "measurement/ledger.h"

namespace latsch::correlation {

/// Returns the ledgers of a file, first, and of the files that it names. `by` is the user of the
/// file: "the model", "test kerb". A missing file is skipped; an unreadable one has a row with the
/// reason.
std::vector<Ledger> ledgers_of_file(const std::filesystem::path& file, const std::string& by);

/// Returns the ledgers of the files that a document names, and of those that these name, except the
/// `known` ones and the document itself. `by` is the user of the files: "the comparison".
std::vector<Ledger> ledgers_of_named_files(const std::filesystem::path& document,
                                           const std::string& by,
                                           const std::vector<Ledger>& known);

/// Returns the ledgers of the study's model, its tests and the files that they name, except the
/// `known` ones.
std::vector<Ledger> ledgers_of_opened_files(const Study& study, const std::vector<Ledger>& known);

}  // namespace latsch::correlation
