// SPDX-License-Identifier: Apache-2.0
// The ledger of a file that is no table of measured channels: a model, a test, a road, a bushing, a
// deck, and the files that they name. Files of a reader that lists its keys (.toml, .tir) have a
// row for each key; of any other file one row says what it was taken for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "measurement/ledger.h"

namespace latsch::correlation {

/// The ledger of a file and of those it names, the file itself first. `by`: "the model", "test
/// kerb". Reads nothing that is not there; a file that cannot be read has a row with the reason.
std::vector<Ledger> ledgers_of_file(const std::filesystem::path& file, const std::string& by);

/// The ledgers of the files that a document names, and of those that they name, but for the `known`
/// ones and the document itself. `by`: "the comparison".
std::vector<Ledger> ledgers_of_named_files(const std::filesystem::path& document,
                                           const std::string& by,
                                           const std::vector<Ledger>& known);

/// The ledgers of the study's model, its tests and their files, but for the `known` ones.
std::vector<Ledger> ledgers_of_opened_files(const Study& study, const std::vector<Ledger>& known);

}  // namespace latsch::correlation
