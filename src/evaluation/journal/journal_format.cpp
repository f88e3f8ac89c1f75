// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/journal_format.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "evaluation/trial/encoding.h"

namespace latsch::journal_format {
namespace {

// Rows are only added, never changed. The one exception is `tally`, which is rewritten in the
// transaction that adds trials.
constexpr const char* kTables = R"(
  CREATE TABLE identity (position INTEGER PRIMARY KEY, name TEXT NOT NULL, text TEXT NOT NULL,
                         hash INTEGER NOT NULL);
  CREATE TABLE trials (number INTEGER PRIMARY KEY, point BLOB NOT NULL, outcome BLOB NOT NULL,
                       finished TEXT NOT NULL, content INTEGER NOT NULL, hash INTEGER NOT NULL);
  CREATE TABLE marks (number INTEGER PRIMARY KEY, kind TEXT NOT NULL, text TEXT NOT NULL,
                      trials INTEGER NOT NULL, hash INTEGER NOT NULL);
  CREATE TABLE tally (only INTEGER PRIMARY KEY CHECK (only = 1), trials INTEGER NOT NULL,
                      hash INTEGER NOT NULL, marks INTEGER NOT NULL, marks_hash INTEGER NOT NULL);
  )";

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

std::uint64_t hash_of_columns(const Row& row, std::uint64_t before) {
  std::uint64_t state = before;
  for (const std::string& part :
       {std::to_string(row.number), row.point, row.outcome, row.finished}) {
    state = hash(part, hash(std::to_string(part.size()) + ":", state));
  }
  return state;
}

}  // namespace

void create_tables(SQLite::Database& database) {
  database.exec(fmt::format("PRAGMA application_id = {}", kApplicationId));
  database.exec(fmt::format("PRAGMA user_version = {}", kFormat));
  database.exec(kTables);
}

std::uint64_t hash_of(const IdentityPart& part, std::uint64_t before) {
  return hash(part.text, hash(part.name + "\n", before));
}

std::uint64_t hash_of(const StudyIdentity& identity) {
  std::uint64_t state = kHashStart;
  for (const IdentityPart& part : identity) state = hash_of(part, state);
  return state;
}

std::uint64_t Row::own_hash() const { return hash_of_columns(*this, kHashStart); }

std::uint64_t Row::chained(int format, std::uint64_t before) const {
  if (format == 1) return hash_of_columns(*this, before);
  const std::uint64_t own = own_hash();
  return latsch::hash({reinterpret_cast<const char*>(&own), sizeof own}, before);
}

std::optional<Trial> Row::decode() const {
  auto decoded_point = decode_point(point);
  auto decoded_outcome = decode_outcome(outcome);
  if (!decoded_point || !decoded_outcome) return std::nullopt;
  return Trial{std::move(*decoded_point), std::move(*decoded_outcome)};
}

std::optional<Trial> RowDecoder::decode(const Row& row) {
  if (format_ < 4) return row.decode();
  auto point = decode_point(row.point);
  auto outcome = unpacker_.unpack(row.number, row.outcome);
  if (!point || !outcome) return std::nullopt;
  return Trial{std::move(*point), std::move(*outcome)};
}

Row unpacked(Row row, const Trial& trial) {
  row.outcome = encode(trial.outcome);
  return row;
}

Row make_row(std::int64_t number, const Trial& trial, std::uint64_t before, OutcomePacker& packer) {
  Row row{number, encode(trial.point), packer.pack(number, trial.outcome), utc_now()};
  const std::uint64_t own = row.own_hash();
  row.content = stored(own);
  row.hash = stored(hash({reinterpret_cast<const char*>(&own), sizeof own}, before));
  return row;
}

std::string columns(int format) {
  return format == 1 ? "number, point, outcome, finished, 0, hash"
                     : "number, point, outcome, finished, content, hash";
}

Row read_row(SQLite::Statement& select, int format) {
  Row row{select.getColumn(0).getInt64(),
          text_of(select.getColumn(1)),
          text_of(select.getColumn(2)),
          text_of(select.getColumn(3)),
          select.getColumn(4).getInt64(),
          select.getColumn(5).getInt64()};
  if (format == 1) row.content = stored(row.own_hash());
  return row;
}

void bind_row(SQLite::Statement& insert, const Row& row) {
  insert.bind(1, row.number);
  insert.bindNoCopy(2, row.point.data(), static_cast<int>(row.point.size()));
  insert.bindNoCopy(3, row.outcome.data(), static_cast<int>(row.outcome.size()));
  insert.bind(4, row.finished);
  insert.bind(5, row.content);
  insert.bind(6, row.hash);
}

void write_identity(SQLite::Database& database, const StudyIdentity& identity) {
  std::uint64_t state = kHashStart;
  for (std::size_t i = 0; i < identity.size(); ++i) {
    state = hash_of(identity[i], state);
    SQLite::Statement insert(database, "INSERT INTO identity VALUES (?, ?, ?, ?)");
    insert.bind(1, static_cast<std::int64_t>(i + 1));
    insert.bind(2, identity[i].name);
    insert.bind(3, identity[i].text);
    insert.bind(4, stored(state));
    insert.exec();
  }
  write_tally(database, {.hash = state});
}

void write_tally(SQLite::Database& database, const Tally& tally) {
  SQLite::Statement insert(database, "INSERT OR REPLACE INTO tally VALUES (1, ?, ?, ?, ?)");
  insert.bind(1, tally.trials);
  insert.bind(2, stored(tally.hash));
  insert.bind(3, tally.marks);
  insert.bind(4, stored(tally.marks_hash));
  insert.exec();
}

std::optional<Tally> read_tally(SQLite::Database& database, int format) {
  SQLite::Statement select(
      database,
      format < 4 ? fmt::format("SELECT trials, hash, 0, {} FROM tally", stored(kHashStart))
                 : "SELECT trials, hash, marks, marks_hash FROM tally");
  if (!select.executeStep()) return std::nullopt;
  return Tally{select.getColumn(0).getInt64(),
               static_cast<std::uint64_t>(select.getColumn(1).getInt64()),
               select.getColumn(2).getInt64(),
               static_cast<std::uint64_t>(select.getColumn(3).getInt64())};
}

namespace {

std::uint64_t hash_of(const JournalMark& mark, std::int64_t number, std::uint64_t before) {
  std::uint64_t state = before;
  for (const std::string& part :
       {std::to_string(number), mark.kind, mark.text, std::to_string(mark.trials)}) {
    state = hash(part, hash(std::to_string(part.size()) + ":", state));
  }
  return state;
}

}  // namespace

void write_mark(SQLite::Database& database, const JournalMark& mark, Tally& tally) {
  tally.marks_hash = hash_of(mark, ++tally.marks, tally.marks_hash);
  SQLite::Statement insert(database, "INSERT INTO marks VALUES (?, ?, ?, ?, ?)");
  insert.bind(1, tally.marks);
  insert.bind(2, mark.kind);
  insert.bind(3, mark.text);
  insert.bind(4, static_cast<std::int64_t>(mark.trials));
  insert.bind(5, stored(tally.marks_hash));
  insert.exec();
}

std::optional<std::vector<JournalMark>> read_marks(SQLite::Database& database, const Tally& tally) {
  std::vector<JournalMark> marks;
  std::uint64_t state = kHashStart;
  SQLite::Statement select(database,
                           "SELECT number, kind, text, trials, hash FROM marks ORDER BY number");
  while (select.executeStep()) {
    marks.push_back({text_of(select.getColumn(1)),
                     text_of(select.getColumn(2)),
                     static_cast<long>(select.getColumn(3).getInt64())});
    state = hash_of(marks.back(), select.getColumn(0).getInt64(), state);
    if (stored(state) != select.getColumn(4).getInt64()) return std::nullopt;
  }
  if (std::ssize(marks) != tally.marks || state != tally.marks_hash) return std::nullopt;
  return marks;
}

void write_journal_rows(SQLite::Database& database,
                        const StudyIdentity& identity,
                        std::vector<Row> rows,
                        const std::vector<JournalMark>& marks) {
  write_identity(database, identity);
  std::uint64_t state = hash_of(identity);
  SQLite::Statement insert(database, kInsert);
  OutcomePacker packer;
  std::int64_t number = 0;
  for (Row& row : rows) {
    row.number = ++number;
    if (const auto outcome = decode_outcome(row.outcome)) {
      row.outcome = packer.pack(number, *outcome);
    }
    row.content = stored(row.own_hash());
    state = row.chained(kFormat, state);
    row.hash = stored(state);
    bind_row(insert, row);
    insert.exec();
    insert.reset();
  }
  Tally tally{.trials = number, .hash = state};
  for (const JournalMark& mark : marks) write_mark(database, mark, tally);
  write_tally(database, tally);
}

std::string text_of(const SQLite::Column& column) {
  const auto* bytes = static_cast<const char*>(column.getBlob());
  return bytes ? std::string(bytes, column.getBytes()) : std::string();
}

}  // namespace latsch::journal_format
