// SPDX-License-Identifier: Apache-2.0
// Reports the interpretation of files to a person: one line for each file, and every doubt as a
// warning.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "measurement/ledger.h"

namespace latsch::cli {

/// Adds the ledgers of a study to the answer, prints one line for each file if `with_lines`, below
/// `title` if there is one, and warns of every doubt. Returns the number of doubts.
std::size_t say_ledgers(const correlation::Study& study,
                        bool with_lines,
                        const std::string& title = "");

/// Says where the lines go. Standard error, beside a table on standard output, gets only the lines
/// of files in which something is assumed, not used or doubtful.
enum class LinesTo { nowhere, output, standard_error };
/// Reports ledgers of any files in that way.
std::size_t say_ledgers(const std::vector<Ledger>& ledgers,
                        LinesTo to,
                        const std::string& title = "");

/// Returns the name of a ledger's file, with its folder if another of them has the same name.
std::string name_among(const Ledger& ledger, const std::vector<Ledger>& all);

/// Returns the ledgers of a model, of a test, which can be a file, and of the files that the test
/// names, behind those that the test itself knows. A text that is no file names none.
std::vector<Ledger> ledgers_of_test(const std::string& model,
                                    const std::string& test,
                                    const std::vector<std::filesystem::path>& test_files,
                                    std::vector<Ledger> known);

/// Reports the doubts as warnings. Throws InputError for the first that is an error.
std::size_t warn_of_doubts(const std::vector<Ledger>& ledgers);

}  // namespace latsch::cli
