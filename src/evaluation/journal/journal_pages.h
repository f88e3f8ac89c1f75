// SPDX-License-Identifier: Apache-2.0
// Reads a journal file without SQLite, for damaged files that SQLite cannot read: finds rows of
// trials on its pages and checks its write-ahead log.
//
// The beginning of a row lies on one page, and the rest of a long row on a chain of overflow pages.
// Every offset of every page is tried as the beginning of a row; a row is accepted if its columns
// have plausible lengths and its content agrees with its hash. So neither a broken tree nor a
// broken page hides intact rows. [https://www.sqlite.org/fileformat2.html, sections 1.5, 1.6, 2.1,
// 4]
#pragma once

#include <string>
#include <vector>

#include "evaluation/journal/journal_format.h"

namespace latsch {

/// Returns rows of format 2 and later whose content agrees with its hash, each once, in the order
/// of their numbers. `database` and `log` are the bytes of the journal and of the "-wal" file
/// beside it.
std::vector<journal_format::Row> rows_on_pages(const std::string& database, const std::string& log);

struct LogState {
  long frames = 0;  // number of pages before the first one with a wrong checksum
  long intact = 0;  // pages before the first one with a wrong checksum
};
LogState check_log(const std::string& log);

}  // namespace latsch
