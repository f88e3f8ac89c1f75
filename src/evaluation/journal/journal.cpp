// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/journal.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include <cassert>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "evaluation/journal/asked_trials.h"
#include "evaluation/journal/journal_format.h"
#include "evaluation/journal/journal_lock.h"
#include "evaluation/journal/journal_migration.h"
#include "evaluation/journal/local_file_system.h"
#include "evaluation/journal/readable_journal.h"
#include "evaluation/trial/encoding.h"

namespace latsch {

using namespace journal_format;

namespace {

/// Returns the advice that ends a message about a damaged journal.
std::string way_out(const std::string& journal) {
  return "save the intact trials by latsch doctor " + journal +
         " --salvage NEW.latsch, go back to a copy, or start a new journal";
}

constexpr int kBusyTimeout = 2000;  // ms
// Time that a commit waits for readers of a rollback journal, ms.
constexpr int kReaderPatience = 60'000;

/// SQLite names the log of a journal after the name by which the journal was opened. Throws
/// InputError if another hard link to the journal in the same folder has a log that a killed
/// process left behind: its trials would be missing now, and applying the log later would damage
/// the journal.
void refuse_log_of_other_name(const std::filesystem::path& file) {
  std::error_code none;
  const auto own = std::filesystem::canonical(file, none);
  if (none || std::filesystem::hard_link_count(own, none) < 2 || none) return;
  for (const auto& entry : std::filesystem::directory_iterator(own.parent_path(), none)) {
    if (entry.path() == own || entry.is_symlink(none)) continue;
    for (const char* log : {"-wal", "-journal"}) {
      const auto left = entry.path().string() + log;
      const auto size = std::filesystem::file_size(left, none);
      if (none || size == 0 || !std::filesystem::equivalent(entry.path(), own, none)) continue;
      throw InputError({file.string(), 0},
                       "is another name (a hard link) of " + entry.path().string() +
                           ", whose last trials are in " + left + ": open it by that name");
    }
  }
}

/// Identifies a file by its device and its inode number.
using FileId = std::pair<dev_t, ino_t>;

std::optional<FileId> id_of(const std::string& file) {
  struct stat about {};
  if (::stat(file.c_str(), &about) != 0) return std::nullopt;
  return FileId(about.st_dev, about.st_ino);
}

/// Keeps the changed state of the packer only if the transaction is committed. Otherwise the next
/// row must not refer to the rows that were not written.
class PackedForGood {
 public:
  explicit PackedForGood(OutcomePacker& packer) : packer_(packer) {}
  ~PackedForGood() {
    if (!kept_) packer_.begin_anew();
  }
  PackedForGood(const PackedForGood&) = delete;
  PackedForGood& operator=(const PackedForGood&) = delete;
  void keep() { kept_ = true; }

 private:
  OutcomePacker& packer_;
  bool kept_ = false;
};

}  // namespace

struct Journal::Impl {
  std::filesystem::path file;
  std::optional<JournalLock> lock;  // set if this process writes the journal
  std::unique_ptr<SQLite::Database> database;
  // Declared after the database, so that it is destroyed before the database.
  std::optional<SQLite::Statement> insert;
  int format = kFormat;
  StudyIdentity identity;
  Tally tally;
  std::vector<JournalMark> marks;
  OutcomePacker packer;
  // Name by which the journal was opened, with symbolic links resolved.
  std::string opened_as = {};
  std::optional<FileId> log_id = {};  // identity of the write-ahead log of this writer
  // Message for later calls, set once the file is no longer in its place.
  std::optional<std::string> lost = {};

  [[noreturn]] void refuse(const std::string& message) const {
    throw InputError({file.string(), 0}, message);
  }

  void expect(const StudyIdentity& wanted) const {
    if (const auto what = difference(identity, wanted)) {
      if (is_same_but_for_versions(identity, wanted)) {
        refuse("was made by another version of the model or of the program: " + *what +
               ". Its trials may differ from those of this version. Either begin anew, with the "
               "old "
               "journal kept beside: latsch run STUDY --anew; or, if you know that the results "
               "are the same, keep its trials: latsch resume STUDY --adopt");
      }
      refuse(
          fmt::format("belongs to another study: {}. None of its {} trials {} of the study as it "
                      "stands",
                      *what,
                      tally.trials,
                      tally.trials == 1 ? "is" : "are") +
          ". Take the study it was made with or another journal, or begin anew, with this "
          "journal kept beside: latsch run STUDY --anew");
    }
  }

  /// Reports SQLite's error in words that include what to do.
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
                        tally.trials));
      case SQLITE_NOTADB:
        refuse("is not a journal (nor any other SQLite database)");
      case SQLITE_CANTOPEN:
        refuse("cannot be opened; does its folder exist, and is it writable?");
      case SQLITE_READONLY:
        if (error.getExtendedErrorCode() == SQLITE_READONLY_ROLLBACK) {
          refuse("was being written when its process ended; latsch resume puts it in order");
        }
        [[fallthrough]];
      case SQLITE_PERM:
        refuse("may not be written; check its permissions");
      case SQLITE_BUSY:
      case SQLITE_LOCKED:
        refuse("is locked by another program; close that program");
      default:
        throw JournalError(
            fmt::format("{}: is damaged ({}); {}", name, error.what(), way_out(name)));
    }
  }

  template <class Action>
  auto guarded(Action&& action) const {
    if (lost) throw JournalError(*lost);
    try {
      return action();
    } catch (const SQLite::Exception& error) {
      report(error);
    }
  }

  /// Executes `action`, which writes. If the file was renamed, a write with a rollback log fails
  /// and a write with a write-ahead log succeeds, so the place of the file is checked in both
  /// cases.
  template <class Action>
  void write(Action&& action) {
    try {
      guarded(action);
    } catch (const std::exception&) {
      keep_trials_if_lost();
      throw;
    }
    keep_trials_if_lost();
  }

  /// Returns a name beside the journal that no file has yet.
  std::filesystem::path free_name() const {
    for (int number = 1;; ++number) {
      auto name = file;
      name.replace_extension(fmt::format(
          ".saved{}{}", number == 1 ? "" : std::to_string(number), file.extension().string()));
      if (!std::filesystem::exists(name)) return name;
    }
  }

  /// Copies the open journal, whose file may have no name any more, to a file beside it with a free
  /// name. Returns this name.
  std::filesystem::path save_copy() {
    const std::filesystem::path copy = free_name();
    guarded([&] {
      SQLite::Statement into(*database, "VACUUM INTO ?");
      into.bind(1, copy.string());
      into.exec();
    });
    return copy;
  }

  /// Closes the database and removes its log. SQLite leaves the log beside a file that was moved or
  /// deleted, and would later apply it to another file of that name.
  void close_and_remove_log() {
    insert.reset();
    database.reset();
    if (!log_id || id_of(opened_as + "-wal") != log_id) return;
    for (const char* part : {"-wal", "-shm"}) std::filesystem::remove(opened_as + part);
  }

  /// Renames the copy to the journal's own name if no file has this name. Returns the name that the
  /// copy has now.
  std::filesystem::path take_its_place(const std::filesystem::path& copy) {
    for (const char* part : {"", "-wal", "-journal"})
      if (std::filesystem::exists(file.string() + part)) return copy;
    move_file(copy, file);
    return file;
  }

  /// If the file of this writer was deleted, moved or replaced, saves its trials under another name
  /// and throws a JournalError that contains this name. The journal cannot be used afterwards.
  void keep_trials_if_lost() {
    if (!lock || lost || lock->is_in_place()) return;
    insert.reset();
    const std::string name = file.string();
    std::string where;
    const auto moved = lock->moved_to();
    if (moved) {
      guarded([&] { database->exec("PRAGMA wal_checkpoint(TRUNCATE)"); });
      close_and_remove_log();
      where = fmt::format(
          "was moved to {} while it was written; its {} trials are there. Move it "
          "back and continue with latsch resume",
          moved->string(),
          tally.trials);
    } else {
      const bool is_replaced = std::filesystem::exists(file);
      const auto copy = save_copy();
      close_and_remove_log();
      const auto saved = take_its_place(copy);
      where = fmt::format("{} while it was written; its {} trials are saved {}",
                          is_replaced ? "was replaced by another file" : "was deleted",
                          tally.trials,
                          saved == file
                              ? "under its name again: continue with latsch resume"
                              : "in " + saved.string() +
                                    ": give that file the journal's name and continue with latsch "
                                    "resume");
    }
    lost = name + ": " + where;
    throw JournalError(*lost);
  }

  bool is_new() const {
    return database->execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0 &&
           database->execAndGet("PRAGMA application_id").getInt() == 0;
  }

  void choose_log(Log log) {
    if (log == Log::write_ahead) {
      database->exec("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL");
      return;
    }
    database->exec("PRAGMA journal_mode = DELETE; PRAGMA locking_mode = NORMAL");
    database->execAndGet(
        "SELECT count(*) FROM sqlite_master");  // the lock is released only by a read
    // With synchronous = EXTRA, a commit counts only once the removal of the rollback log has also
    // reached the disk.
    database->exec("PRAGMA synchronous = EXTRA");
    database->setBusyTimeout(kReaderPatience);
  }

  void check_format() {
    if (is_new()) {
      refuse(
          "is empty, it holds no study and no trial: run the study, or go back to a copy if it "
          "had trials");
    }
    if (database->execAndGet("PRAGMA application_id").getInt() != kApplicationId) {
      refuse("is an SQLite database, but not a journal");
    }
    format = database->execAndGet("PRAGMA user_version").getInt();
    if (format < 1 || format > kFormat) {
      refuse(
          fmt::format("is a journal of format {}, this program reads and writes format {}; use "
                      "the program that wrote it, or start a new journal",
                      format,
                      kFormat));
    }
  }

  void create(const StudyIdentity& study) {
    SQLite::Transaction transaction(*database);
    create_tables(*database);
    write_identity(*database, study);
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
                      "its hash: the file is damaged; {}",
                      file.string(),
                      identity.back().name,
                      way_out(file.string())));
    }
  }

  void read_tally() {
    const auto read = journal_format::read_tally(*database, format);
    if (!read) {
      throw JournalError(
          fmt::format("{}: the tally of its trials is missing: the file is damaged; "
                      "{}",
                      file.string(),
                      way_out(file.string())));
    }
    tally = *read;
    if (format < 4) return;
    auto read_too = read_marks(*database, tally);
    if (!read_too) {
      throw JournalError(
          fmt::format("{}: its marks do not agree with their hashes: the file is damaged; {}",
                      file.string(),
                      way_out(file.string())));
    }
    marks = std::move(*read_too);
  }

  [[noreturn]] void damaged(std::int64_t number, const char* what) const {
    throw JournalError(fmt::format("{}: trial {} {}: the file is damaged; {}",
                                   file.string(),
                                   number,
                                   what,
                                   way_out(file.string())));
  }

  void for_each_row(const std::function<void(const Row&)>& visit) const {
    // Reads the rows and their number as they were at one moment, while another process may write.
    SQLite::Transaction snapshot(*database);
    std::uint64_t state = hash_of(identity);
    std::int64_t number = 0;
    SQLite::Statement select(*database,
                             "SELECT " + columns(format) + " FROM trials ORDER BY number");
    while (select.executeStep()) {
      const Row row = read_row(select, format);
      if (row.number != ++number) damaged(number, "is missing");
      state = row.chained(format, state);
      if (stored(state) != row.hash || stored(row.own_hash()) != row.content) {
        damaged(number, "does not agree with its hash");
      }
      visit(row);
    }
    const auto counted = journal_format::read_tally(*database, format);
    if (!counted || counted->trials != number || counted->hash != state) {
      damaged(number + 1, "is missing or the tally of the trials is wrong");
    }
  }

  void for_each(const std::function<void(const Trial&)>& visit) const {
    RowDecoder decoder(format);
    for_each_row([&](const Row& row) {
      const auto trial = decoder.decode(row);
      if (!trial) damaged(row.number, "cannot be decoded");
      visit(*trial);
    });
  }

  /// Rewrites the journal in the present format with the identity `as`.
  void rewrite(const StudyIdentity& as, const std::filesystem::path& backup) {
    std::vector<Row> rows;
    RowDecoder decoder(format);
    for_each_row([&](const Row& row) {
      const auto trial = decoder.decode(row);
      if (!trial) damaged(row.number, "cannot be decoded");
      rows.push_back(unpacked(row, *trial));
    });
    rewrite_journal(*database, backup, as, std::move(rows), marks);
    identity = as;
    format = kFormat;
    read_tally();
  }

  void append(std::span<const Trial> more) {
    if (!insert) insert.emplace(*database, kInsert);
    SQLite::Transaction transaction(*database);
    PackedForGood guard{packer};
    Tally next = tally;
    for (const Trial& trial : more) {
      const Row row = make_row(++next.trials, trial, next.hash, packer);
      insert->tryReset();  // the statement may be in any state after the last use
      bind_row(*insert, row);
      insert->exec();
      insert->tryReset();
      next.hash = static_cast<std::uint64_t>(row.hash);
    }
    write_tally(*database, next);
    transaction.commit();
    tally = next;
    guard.keep();
  }

  void mark(const std::string& kind, const std::string& text) {
    SQLite::Transaction transaction(*database);
    Tally next = tally;
    const JournalMark mark{kind, text, static_cast<long>(next.trials)};
    write_mark(*database, mark, next);
    write_tally(*database, next);
    transaction.commit();
    tally = next;
    marks.push_back(mark);
  }
};

Journal::Journal(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Journal::Journal(Journal&&) noexcept = default;
Journal& Journal::operator=(Journal&&) noexcept = default;
Journal::~Journal() = default;

Journal Journal::open(const std::filesystem::path& file, const StudyIdentity& identity) {
  return open(file, identity, shared_file_system(file) ? Log::rollback : Log::write_ahead);
}

Journal Journal::open(const std::filesystem::path& file, const StudyIdentity& identity, Log log) {
  auto impl = std::make_unique<Impl>();
  impl->file = file;
  impl->lock.emplace(file);
  refuse_log_of_other_name(file);
  impl->guarded([&] {
    impl->database = std::make_unique<SQLite::Database>(
        file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kBusyTimeout);
    // The whole file is locked until the type of its log is decided. SQLite then reads a
    // write-ahead log that another machine left without needing shared memory.
    if (log == Log::rollback) impl->database->exec("PRAGMA locking_mode = EXCLUSIVE");
    const bool is_new = impl->is_new();
    if (!is_new) impl->check_format();
    impl->choose_log(log);
    if (is_new) impl->create(identity);
    impl->read_identity();
    impl->read_tally();
    impl->opened_as = std::filesystem::canonical(file).string();
    impl->log_id = id_of(impl->opened_as + "-wal");
    impl->expect(identity);  // checked first, so that a refused journal stays unchanged
    if (impl->format != kFormat) {
      const StudyIdentity same = impl->identity;
      impl->rewrite(same, migration_backup(file, impl->format));
    }
  });
  return Journal(std::move(impl));
}

bool Journal::adopt(const std::filesystem::path& file, const StudyIdentity& identity) {
  const StudyIdentity own = read(file).identity();
  if (!difference(own, identity)) return false;
  Journal journal = open(file, own);
  if (!is_same_but_for_versions(own, identity)) journal.impl_->expect(identity);
  journal.impl_->guarded(
      [&] { journal.impl_->rewrite(identity, file.string() + ".before_adoption"); });
  return true;
}

Journal Journal::read(const std::filesystem::path& file) {
  auto impl = std::make_unique<Impl>();
  impl->file = file;
  if (!std::filesystem::exists(file)) impl->refuse("does not exist; has the study been run?");
  impl->guarded([&] {
    impl->database = open_for_reading(file, kBusyTimeout);
    impl->check_format();
    impl->read_identity();
    impl->read_tally();
  });
  return Journal(std::move(impl));
}

Journal Journal::read(const std::filesystem::path& file, const StudyIdentity& identity) {
  Journal journal = read(file);
  const StudyIdentity whole = journal.impl_->identity;
  journal.impl_->identity = without_program_files(whole);
  journal.impl_->expect(without_program_files(identity));
  journal.impl_->identity = whole;
  return journal;
}

void Journal::append(std::span<const Trial> trials) {
  assert(impl_->lock && "opened for reading");
  impl_->write([&] { impl_->append(trials); });
}

void Journal::for_each(const std::function<void(const Trial&)>& visit) const {
  impl_->keep_trials_if_lost();
  impl_->guarded([&] { impl_->for_each(visit); });
}

std::vector<Trial> Journal::trials() const {
  std::vector<Trial> all;
  for_each([&](const Trial& trial) { all.push_back(trial); });
  return all;
}

void Journal::for_each_asked(const std::function<void(const Trial&)>& visit) const {
  const AskedTrials asked(marks());
  long row = 0;
  for_each([&](const Trial& trial) {
    if (asked.contains(row++, trial.point)) visit(trial);
  });
}

void Journal::begin_asking() {
  if (!AskedTrials(marks()).is_marked()) mark(AskedTrials::kKind, "");
}

void Journal::keep_asked(const std::set<std::string>& points) {
  if (const auto text = AskedTrials(marks()).mark_for(points, size())) {
    mark(AskedTrials::kKind, *text);
  }
}

void Journal::mark(const std::string& kind, const std::string& text) {
  assert(impl_->lock && "opened for reading");
  impl_->write([&] { impl_->mark(kind, text); });
}

const std::vector<JournalMark>& Journal::marks() const { return impl_->marks; }

const std::filesystem::path& Journal::file() const { return impl_->file; }

long Journal::size() const { return static_cast<long>(impl_->tally.trials); }

const StudyIdentity& Journal::identity() const { return impl_->identity; }

}  // namespace latsch
