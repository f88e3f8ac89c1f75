// SPDX-License-Identifier: Apache-2.0
// The ledger of a file that is no table of measured channels: a model, a test, a road, a bushing, a
// deck, and the files that they name. Files of a reader that lists its keys (.toml, .tir) have a
// row for each key; any other file has one row, which states what it was read as.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "measurement/ledger.h"

namespace latsch::correlation {

/// Returns the ledgers of a file and of the files it names, the file itself first. `by` is its
/// user: "the model", "test kerb". A missing file is skipped; an unreadable one has a row with the
/// reason.
std::vector<Ledger> ledgers_of_file(const std::filesystem::path& file, const std::string& by);

/// The ledgers of the files that a document names, and of those that they name, but for the `known`
/// ones and the document itself. `by`: "the comparison".
std::vector<Ledger> ledgers_of_named_files(const std::filesystem::path& document,
                                           const std::string& by,
                                           const std::vector<Ledger>& known);

/// The ledgers of the study's model, its tests and their files, but for the `known` ones.
std::vector<Ledger> ledgers_of_opened_files(const Study& study, const std::vector<Ledger>& known);

}  // namespace latsch::correlation
