// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal_migration.h"

#include <fmt/format.h>

#include "evaluation/encoding.h"

namespace latsch {

using namespace journal_format;

std::filesystem::path migration_backup(const std::filesystem::path& journal, int format) {
  return journal.string() + ".format" + std::to_string(format);
}

void migrate_journal(SQLite::Database& database,
                     const std::filesystem::path& file,
                     int format,
                     const StudyIdentity& identity,
                     std::vector<Row> rows) {
  // With VACUUM INTO what still lies in the write-ahead log is copied too.
  const auto backup = migration_backup(file, format);
  std::filesystem::remove(backup);  // of an attempt that did not come to its end
  SQLite::Statement copy(database, "VACUUM INTO ?");
  copy.bind(1, backup.string());
  copy.exec();

  SQLite::Transaction transaction(database);
  database.exec("DROP TABLE trials; DROP TABLE identity; DROP TABLE tally");
  create_tables(database);
  write_identity(database, identity);
  std::uint64_t state = hash_of(identity);
  for (Row& row : rows) {
    state = row.chained(kFormat, state);
    row.hash = stored(state);
    SQLite::Statement insert(database, kInsert);
    bind_row(insert, row);
    insert.exec();
  }
  write_tally(database, std::ssize(rows), state);
  transaction.commit();
}

}  // namespace latsch
