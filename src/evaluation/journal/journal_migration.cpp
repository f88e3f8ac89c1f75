// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/journal_migration.h"

#include <string>
#include <utility>

namespace latsch {

using namespace journal_format;

std::filesystem::path migration_backup(const std::filesystem::path& journal, int format) {
  return journal.string() + ".format" + std::to_string(format);
}

void rewrite_journal(SQLite::Database& database,
                     const std::filesystem::path& backup,
                     const StudyIdentity& identity,
                     std::vector<Row> rows,
                     const std::vector<JournalMark>& marks) {
  // VACUUM INTO also copies the content of the write-ahead log.
  std::filesystem::remove(backup);  // an interrupted attempt may have left it
  SQLite::Statement copy(database, "VACUUM INTO ?");
  copy.bind(1, backup.string());
  copy.exec();

  SQLite::Transaction transaction(database);
  database.exec(
      "DROP TABLE trials; DROP TABLE identity; DROP TABLE tally; DROP TABLE IF EXISTS marks");
  create_tables(database);
  write_journal_rows(database, identity, std::move(rows), marks);
  transaction.commit();
}

}  // namespace latsch
