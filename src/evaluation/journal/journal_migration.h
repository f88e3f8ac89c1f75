// SPDX-License-Identifier: Apache-2.0
// Converts a journal of an older format to the present one.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <vector>

#include "evaluation/journal/journal_format.h"

namespace latsch {

/// Returns the file that keeps the original journal: "study.latsch.format1".
std::filesystem::path migration_backup(const std::filesystem::path& journal, int format);

/// Copies the journal to `backup`, then rewrites it in the present format in one transaction.
/// `rows` are the rows of the journal, checked and unpacked.
void rewrite_journal(SQLite::Database& database,
                     const std::filesystem::path& backup,
                     const StudyIdentity& identity,
                     std::vector<journal_format::Row> rows,
                     const std::vector<JournalMark>& marks);

}  // namespace latsch
