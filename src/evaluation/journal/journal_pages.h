// SPDX-License-Identifier: Apache-2.0
// The bytes of a journal file read without SQLite, for when SQLite cannot: rows of trials found on
// its pages, and how far its write-ahead log can be trusted.
//
// A row lies in one piece on a page, its long tail on a chain of overflow pages. Every offset of
// every page is tried as the beginning of a row of the right shape; the hash of its content decides
// whether it is one. So neither a broken tree nor a broken page hides the rows that are whole.
// [https://www.sqlite.org/fileformat2.html, sections 1.5, 1.6, 2.1, 4]
#pragma once

#include <string>
#include <vector>

#include "evaluation/journal/journal_format.h"

namespace latsch {

/// Rows of format 2 and later whose content agrees with its hash, in the order of their numbers,
/// each once. `database` and `log` are the bytes of the journal and of the "-wal" file beside it.
std::vector<journal_format::Row> rows_on_pages(const std::string& database, const std::string& log);

struct LogState {
  long frames = 0;  // of the present log: pages that were written to it
  long intact = 0;  // of these, before the first whose checksum is wrong
};
LogState check_log(const std::string& log);

}  // namespace latsch
