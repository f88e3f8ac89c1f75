// SPDX-License-Identifier: Apache-2.0
// What files were taken for, for a person: a line a file, and every doubt as a warning.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "correlation/study/study.h"
#include "measurement/ledger.h"

namespace latsch::cli {

/// The ledgers of a study into the answer, a line a file on the terminal if `with_lines`, below
/// `title` where there is one, and a warning for every doubt. Returns how many doubts there are.
std::size_t say_ledgers(const correlation::Study& study,
                        bool with_lines,
                        const std::string& title = "");

/// The doubts as warnings. Throws InputError for the first that is an error.
std::size_t warn_of_doubts(const std::vector<Ledger>& ledgers);

}  // namespace latsch::cli
