// SPDX-License-Identifier: Apache-2.0
// Reports to a person how files were interpreted: one line for each file, and every doubt as a
// warning. A ledger is the list of everything that a reader used, ignored, assumed and doubted in a
// file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "measurement/ledger.h"

namespace latsch::cli {

/// Adds the ledgers of a study's files to the answer and warns of every doubt. If `with_lines`,
/// prints one line for each file, below `title` if it is not empty. Returns the number of doubts.
std::size_t say_ledgers(const correlation::Study& study,
                        bool with_lines,
                        const std::string& title = "");

/// Destination of the lines about files. On standard error, when standard output carries a table,
/// only files in which something was assumed, ignored or doubted get a line.
enum class LinesTo { nowhere, output, standard_error };
/// Reports the ledgers of any files like those of a study.
std::size_t say_ledgers(const std::vector<Ledger>& ledgers,
                        LinesTo to,
                        const std::string& title = "");

/// Returns the file name of a ledger, with its folder if another ledger has the same file name.
std::string name_among(const Ledger& ledger, const std::vector<Ledger>& all);

/// Returns the ledgers of a model, of a test, of the files that the test names and of those that
/// the test itself knows. `test` is a file or the text of a test; a text names no file of its own.
std::vector<Ledger> ledgers_of_test(const std::string& model,
                                    const std::string& test,
                                    const std::vector<std::filesystem::path>& test_files,
                                    std::vector<Ledger> known);

/// Reports the doubts of all ledgers as warnings. Throws InputError for the first doubt that counts
/// as an error.
std::size_t warn_of_doubts(const std::vector<Ledger>& ledgers);

}  // namespace latsch::cli
