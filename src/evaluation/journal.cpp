// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <cassert>
#include <ctime>
#include <optional>

#include "base/error.h"
#include "evaluation/encoding.h"
#include "evaluation/journal_lock.h"

namespace latsch {
namespace {

constexpr int kApplicationId = 0x4C747368;  // "Ltsh", so that file(1) and we know our own
constexpr int kSchemaVersion = 1;

// Rows are only ever added; `tally` alone is rewritten, in the transaction that adds a trial, so
// that a lost last row is seen. hash of a trial: over its columns and the hash of the row before
// it.
constexpr const char* kSchema = R"(
  CREATE TABLE identity (position INTEGER PRIMARY KEY, name TEXT NOT NULL, text TEXT NOT NULL,
                         hash INTEGER NOT NULL);
  CREATE TABLE trials (number INTEGER PRIMARY KEY, point BLOB NOT NULL, outcome BLOB NOT NULL,
                       finished TEXT NOT NULL, hash INTEGER NOT NULL);
  CREATE TABLE tally (only INTEGER PRIMARY KEY CHECK (only = 1), trials INTEGER NOT NULL,
                      hash INTEGER NOT NULL);
  )";

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

std::int64_t stored(std::uint64_t hash) { return static_cast<std::int64_t>(hash); }

std::string text_of(const SQLite::Column& column) {
  const auto* bytes = static_cast<const char*>(column.getBlob());
  return bytes ? std::string(bytes, column.getBytes()) : std::string();
}

/// One row of `trials`.
struct Row {
  std::int64_t number;
  std::string point;
  std::string outcome;
  std::string finished;

  std::uint64_t hash(std::uint64_t before) const {
    std::uint64_t state = before;
    for (const std::string& part : {std::to_string(number), point, outcome, finished}) {
      state = latsch::hash(part, latsch::hash(std::to_string(part.size()) + ":", state));
    }
    return state;
  }
};

std::uint64_t hash_of(const IdentityPart& part, std::uint64_t before) {
  return hash(part.text, hash(part.name + "\n", before));
}

std::uint64_t hash_of(const StudyIdentity& identity) {
  std::uint64_t state = kHashStart;
  for (const IdentityPart& part : identity) state = hash_of(part, state);
  return state;
}

}  // namespace

struct Journal::Impl {
  std::filesystem::path file;
  std::optional<JournalLock> lock;  // held by a writer
  std::unique_ptr<SQLite::Database> database;
  StudyIdentity identity;
  std::uint64_t last_hash = kHashStart;
  long trials = 0;

  [[noreturn]] void refuse(const std::string& message) const {
    throw InputError({file.string(), 0}, message);
  }

  /// What SQLite said, in words that tell what to do.
  [[noreturn]] void report(const SQLite::Exception& error) const {
    const std::string name = file.string();
    switch (error.getErrorCode()) {
      case SQLITE_FULL:
      case SQLITE_IOERR:
        throw JournalError(
            fmt::format("{}: cannot be written ({}): the disk is full or broken. "
                        "The {} trials in it are safe; make room and resume",
                        name,
                        error.what(),
                        trials));
      case SQLITE_NOTADB:
        refuse("is not a journal (nor any other SQLite database)");
      case SQLITE_CANTOPEN:
        refuse("cannot be opened; does its folder exist, may it be written?");
      case SQLITE_READONLY:
      case SQLITE_PERM:
        refuse("may not be written; check its permissions");
      case SQLITE_BUSY:
      case SQLITE_LOCKED:
        refuse("is locked by another program; close that program");
      default:
        throw JournalError(fmt::format(
            "{}: is damaged ({}); go back to a copy or start a new journal", name, error.what()));
    }
  }

  template <class Action>
  auto guarded(Action&& action) const {
    try {
      return action();
    } catch (const SQLite::Exception& error) {
      report(error);
    }
  }

  bool is_new() const {
    return database->execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0 &&
           database->execAndGet("PRAGMA application_id").getInt() == 0;
  }

  void check_format() const {
    if (database->execAndGet("PRAGMA application_id").getInt() != kApplicationId) {
      refuse("is an SQLite database, but not a journal");
    }
    const int version = database->execAndGet("PRAGMA user_version").getInt();
    if (version != kSchemaVersion) {
      refuse(
          fmt::format("is a journal of format {}, this program reads and writes format {}; use "
                      "the program that wrote it, or start a new journal",
                      version,
                      kSchemaVersion));
    }
  }

  void create(const StudyIdentity& study) {
    SQLite::Transaction transaction(*database);
    database->exec(fmt::format("PRAGMA application_id = {}", kApplicationId));
    database->exec(fmt::format("PRAGMA user_version = {}", kSchemaVersion));
    database->exec(kSchema);
    std::uint64_t state = kHashStart;
    for (std::size_t i = 0; i < study.size(); ++i) {
      state = hash_of(study[i], state);
      SQLite::Statement insert(*database, "INSERT INTO identity VALUES (?, ?, ?, ?)");
      insert.bind(1, static_cast<std::int64_t>(i + 1));
      insert.bind(2, study[i].name);
      insert.bind(3, study[i].text);
      insert.bind(4, stored(state));
      insert.exec();
    }
    SQLite::Statement tally(*database, "INSERT INTO tally VALUES (1, 0, ?)");
    tally.bind(1, stored(state));
    tally.exec();
    transaction.commit();
  }

  void read_identity() {
    std::uint64_t state = kHashStart;
    SQLite::Statement select(*database, "SELECT name, text, hash FROM identity ORDER BY position");
    while (select.executeStep()) {
      identity.push_back({text_of(select.getColumn(0)), text_of(select.getColumn(1))});
      state = hash_of(identity.back(), state);
      if (stored(state) == select.getColumn(2).getInt64()) continue;
      throw JournalError(
          fmt::format("{}: \"{}\" in the identity of the study does not agree with "
                      "its hash: the file is damaged; go back to a copy",
                      file.string(),
                      identity.back().name));
    }
  }

  void read_tally() {
    SQLite::Statement select(*database, "SELECT trials, hash FROM tally");
    if (!select.executeStep()) {
      throw JournalError(
          fmt::format("{}: the tally of its trials is missing: the file is damaged; "
                      "go back to a copy",
                      file.string()));
    }
    trials = select.getColumn(0).getInt64();
    last_hash = static_cast<std::uint64_t>(select.getColumn(1).getInt64());
  }

  [[noreturn]] void damaged(std::int64_t number, const char* what) const {
    throw JournalError(
        fmt::format("{}: trial {} {}: the file is damaged; go back to a copy or "
                    "start a new journal",
                    file.string(),
                    number,
                    what));
  }

  Trial checked_trial(const Row& row) const {
    auto point = decode_point(row.point);
    auto outcome = decode_outcome(row.outcome);
    if (!point || !outcome) damaged(row.number, "cannot be decoded");
    return {std::move(*point), std::move(*outcome)};
  }

  void for_each(const std::function<void(const Trial&)>& visit) const {
    SQLite::Transaction snapshot(*database);  // rows and tally of one moment, while another writes
    std::uint64_t state = hash_of(identity);
    std::int64_t number = 0;
    SQLite::Statement select(*database,
                             "SELECT number, point, outcome, finished, hash FROM trials "
                             "ORDER BY number");
    while (select.executeStep()) {
      const Row row{select.getColumn(0).getInt64(),
                    text_of(select.getColumn(1)),
                    text_of(select.getColumn(2)),
                    text_of(select.getColumn(3))};
      if (row.number != ++number) damaged(number, "is missing");
      state = row.hash(state);
      if (stored(state) != select.getColumn(4).getInt64()) {
        damaged(number, "does not agree with its hash");
      }
      visit(checked_trial(row));
    }
    SQLite::Statement tally(*database, "SELECT trials, hash FROM tally");
    if (!tally.executeStep() || tally.getColumn(0).getInt64() != number ||
        tally.getColumn(1).getInt64() != stored(state)) {
      damaged(number + 1, "is missing or the tally of the trials is wrong");
    }
  }

  void append(const Trial& trial) {
    const Row row{trials + 1, encode(trial.point), encode(trial.outcome), utc_now()};
    const std::uint64_t row_hash = row.hash(last_hash);
    SQLite::Transaction transaction(*database);
    SQLite::Statement insert(*database, "INSERT INTO trials VALUES (?, ?, ?, ?, ?)");
    insert.bind(1, row.number);
    insert.bind(2, row.point.data(), static_cast<int>(row.point.size()));
    insert.bind(3, row.outcome.data(), static_cast<int>(row.outcome.size()));
    insert.bind(4, row.finished);
    insert.bind(5, stored(row_hash));
    insert.exec();
    SQLite::Statement tally(*database, "UPDATE tally SET trials = ?, hash = ?");
    tally.bind(1, row.number);
    tally.bind(2, stored(row_hash));
    tally.exec();
    transaction.commit();
    trials = row.number;
    last_hash = row_hash;
  }
};

Journal::Journal(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Journal::Journal(Journal&&) noexcept = default;
Journal& Journal::operator=(Journal&&) noexcept = default;
Journal::~Journal() = default;

Journal Journal::open(const std::filesystem::path& file, const StudyIdentity& identity) {
  auto impl = std::make_unique<Impl>();
  impl->file = file;
  impl->lock.emplace(file);
  impl->guarded([&] {
    impl->database = std::make_unique<SQLite::Database>(
        file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, 2000);
    const bool is_new = impl->is_new();
    if (!is_new) impl->check_format();
    impl->database->exec("PRAGMA journal_mode = WAL");
    impl->database->exec("PRAGMA synchronous = FULL");
    if (is_new) impl->create(identity);
    impl->read_identity();
    impl->read_tally();
  });
  if (const auto what = difference(impl->identity, identity)) {
    impl->refuse("belongs to another study: " + *what +
                 ". Take the study it was made with, or another journal");
  }
  return Journal(std::move(impl));
}

Journal Journal::read(const std::filesystem::path& file) {
  auto impl = std::make_unique<Impl>();
  impl->file = file;
  if (!std::filesystem::exists(file)) impl->refuse("does not exist; has the study been run?");
  impl->guarded([&] {
    impl->database = std::make_unique<SQLite::Database>(file.string(), SQLite::OPEN_READONLY, 2000);
    impl->check_format();
    impl->read_identity();
    impl->read_tally();
  });
  return Journal(std::move(impl));
}

void Journal::append(const Trial& trial) {
  assert(impl_->lock && "opened for reading");
  impl_->guarded([&] { impl_->append(trial); });
}

void Journal::for_each(const std::function<void(const Trial&)>& visit) const {
  impl_->guarded([&] { impl_->for_each(visit); });
}

std::vector<Trial> Journal::trials() const {
  std::vector<Trial> all;
  for_each([&](const Trial& trial) { all.push_back(trial); });
  return all;
}

long Journal::size() const { return impl_->trials; }

const StudyIdentity& Journal::identity() const { return impl_->identity; }

}  // namespace latsch
