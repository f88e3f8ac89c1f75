// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/journal_doctor.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/file.h"
#include "evaluation/journal/journal_pages.h"
#include "evaluation/journal/readable_journal.h"
#include "evaluation/trial/encoding.h"

namespace latsch {
namespace {

using namespace journal_format;
namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = std::size_t{16} << 30;
constexpr int kShownDamages = 5;   // lines shown of SQLite's list of damages
constexpr long kShownTrials = 12;  // numbers of trials listed in one sentence

std::string read_if_there(const fs::path& file) {
  return fs::exists(file) ? read_text_file(file, kLargestFile) : std::string();
}

/// Returns for example "3, 7, 12 to 15".
std::string ranges(const std::vector<std::int64_t>& numbers) {
  std::string text;
  long shown = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (!text.empty()) text += ", ";
    if (++shown > kShownTrials) return text + "...";
    text += last == i ? fmt::format("{}", numbers[i])
                      : fmt::format("{} to {}", numbers[i], numbers[last]);
    i = last;
  }
  return text;
}

/// Examines a journal step by step.
class Examination {
 public:
  explicit Examination(fs::path file) : file_(std::move(file)) {
    bytes_ = read_text_file(file_, kLargestFile);
    log_ = read_if_there(file_.string() + "-wal");
  }

  JournalReport run() {
    attempt("the file", [&] { open(); });
    if (database_ && report_.format > 0) {
      attempt("its structure", [&] { check_structure(); });
      attempt("the identity of its study", [&] { read_identity(); });
      attempt("the tally of its trials", [&] { read_tally(); });
      attempt("the list of its trials", [&] { last_ = last_number(); });
      for (std::int64_t number = 1; number <= last_; ++number) read_row_number(number);
    }
    check_log_file();
    if (!report_.findings.empty() || !unreadable_.empty()) add_rows_on_pages();
    check_rows();
    return std::move(report_);
  }

 private:
  void find(std::string sentence) { report_.findings.push_back(std::move(sentence)); }

  template <class Action>
  void attempt(const char* what, Action&& action) {
    try {
      action();
    } catch (const SQLite::Exception& error) {
      const int code = error.getErrorCode();
      const bool is_refused =
          code == SQLITE_CANTOPEN || code == SQLITE_PERM || code == SQLITE_READONLY;
      if (is_refused && !may_be_written(file_))
        throw InputError(
            {file_.string(), 0},
            fmt::format("{} cannot be examined here: {}. That is no damage; copy "
                        "the journal, with FILE-wal and FILE-journal beside it, to a folder "
                        "that you may write",
                        what,
                        error.what()));
      const bool foreign = code == SQLITE_NOTADB;
      find(fmt::format("{} cannot be read: {}{}",
                       what,
                       error.what(),
                       foreign ? ": damaged at its beginning, or of another kind than the "
                                 "journal, STUDY.latsch, beside a study"
                               : ""));
    }
  }

  void open() {
    if (std::filesystem::file_size(file_) == 0) return find("it is empty: no byte is in it");
    database_ = open_for_reading(file_, 2000);
    if (database_->execAndGet("PRAGMA application_id").getInt() != kApplicationId) {
      return find("it is not marked as a journal");
    }
    report_.format = database_->execAndGet("PRAGMA user_version").getInt();
    if (report_.format >= 1 && report_.format <= kFormat) return;
    find(fmt::format(
        "it states format {}; this program knows formats 1 to {}", report_.format, kFormat));
    report_.format = 0;
  }

  void check_structure() {
    SQLite::Statement check(*database_, "PRAGMA integrity_check");
    for (int i = 0; i < kShownDamages && check.executeStep(); ++i) {
      const std::string line = text_of(check.getColumn(0));
      if (line != "ok") find("its structure is damaged: " + line);
    }
  }

  void read_identity() {
    StudyIdentity identity;
    std::uint64_t state = kHashStart;
    SQLite::Statement select(*database_, "SELECT name, text, hash FROM identity ORDER BY position");
    while (select.executeStep()) {
      identity.push_back({text_of(select.getColumn(0)), text_of(select.getColumn(1))});
      state = hash_of(identity.back(), state);
      if (stored(state) == select.getColumn(2).getInt64()) continue;
      return find(
          fmt::format("part \"{}\" of the identity of its study does not agree with its hash",
                      identity.back().name));
    }
    if (identity.empty()) return find("the identity of its study is missing");
    report_.identity = std::move(identity);
  }

  void read_tally() {
    const auto tally = journal_format::read_tally(*database_, report_.format);
    if (!tally) return find("the tally of its trials is missing");
    report_.expected = tally->trials;
    tally_hash_ = stored(tally->hash);
    if (report_.format < 4) return;
    auto marks = read_marks(*database_, *tally);
    if (!marks) return find("its marks do not agree with their hashes");
    report_.marks = std::move(*marks);
  }

  std::int64_t last_number() {
    return std::max<std::int64_t>(
        report_.expected, database_->execAndGet("SELECT max(number) FROM trials").getInt64());
  }

  /// Reads each row by a query of its own, so that a damaged page costs only the rows on it.
  void read_row_number(std::int64_t number) {
    try {
      SQLite::Statement select(
          *database_, "SELECT " + columns(report_.format) + " FROM trials WHERE number = ?");
      select.bind(1, number);
      if (!select.executeStep()) {
        unreadable_.push_back(number);
        return;
      }
      Row row = read_row(select, report_.format);
      if (row.content == stored(row.own_hash())) {
        rows_.emplace(number, std::move(row));
      } else {
        unreadable_.push_back(number);
      }
    } catch (const SQLite::Exception&) {
      unreadable_.push_back(number);
    }
  }

  void check_log_file() {
    const LogState log = check_log(log_);
    if (log.intact == log.frames) return;
    const std::string where =
        fmt::format("the log beside it can be read up to page {} of {}", log.intact, log.frames);
    if (log.intact + 1 == log.frames) {
      report_.notes.push_back(where + ": the last commit was not completed");
    } else {
      find(where + ": trials that were committed after it may be missing");
    }
  }

  void add_rows_on_pages() {
    for (Row& row : rows_on_pages(bytes_, log_)) {
      rows_.emplace(row.number, std::move(row));
    }
  }

  /// A row that refers to a lost row cannot be read and is lost, too.
  void unpack_rows() {
    RowDecoder decoder(report_.format ? report_.format : kFormat);
    std::vector<std::int64_t> useless;
    for (const auto& [number, row] : rows_) {
      auto trial = decoder.decode(row);
      // If the format is not known, the row may be in an older format.
      if (!trial && report_.format == 0) trial = row.decode();
      if (trial) {
        report_.rows.push_back(unpacked(row, *trial));
      } else {
        useless.push_back(number);
      }
    }
    if (useless.empty()) return;
    find(fmt::format("trials that cannot be read without those lost before them: {}",
                     ranges(useless)));
  }

  /// Checks that no row number is missing, and that each row's hash continues that of the row
  /// before.
  void check_rows() {
    std::vector<std::int64_t> lost, untied;
    std::int64_t number = 0;
    std::optional<std::uint64_t> before;
    if (report_.identity) before = hash_of(*report_.identity);
    for (auto& [found, row] : rows_) {
      while (++number < found) {
        lost.push_back(number);
        before.reset();
      }
      if (before &&
          row.hash != stored(row.chained(report_.format ? report_.format : kFormat, *before))) {
        untied.push_back(number);
      }
      before = static_cast<std::uint64_t>(row.hash);
    }
    while (++number <= last_) lost.push_back(number);
    if (!lost.empty()) {
      find(fmt::format("trials lost, which are missing or do not agree with their hash: {}",
                       ranges(lost)));
    } else if (!unreadable_.empty()) {
      find(fmt::format("trials that only a search of all pages found: {}", ranges(unreadable_)));
    }
    if (!untied.empty()) {
      find(fmt::format("trials that are intact, but do not continue those before them: {}",
                       ranges(untied)));
      drop_unproven(untied);
    }
    check_tally();
    unpack_rows();
  }

  /// In format 1 a row has no hash of its own, so only the chain of hashes from row to row proves
  /// it.
  void drop_unproven(const std::vector<std::int64_t>& untied) {
    if (report_.format != 1) return;
    for (const std::int64_t number : untied) rows_.erase(number);
  }

  void check_tally() {
    if (report_.expected < 0) return;
    const bool agrees = rows_.empty() ? report_.expected == 0
                                      : rows_.rbegin()->first == report_.expected &&
                                            rows_.rbegin()->second.hash == tally_hash_;
    if (!agrees)
      find(fmt::format("its tally of {} trials does not agree with them", report_.expected));
  }

  fs::path file_;
  std::string bytes_, log_;
  std::unique_ptr<SQLite::Database> database_;
  JournalReport report_;
  std::map<std::int64_t, Row> rows_;
  std::vector<std::int64_t> unreadable_;
  std::int64_t last_ = 0;
  std::int64_t tally_hash_ = 0;
};

/// True if the writing process ended during a commit to a rollback log. Reading alone cannot undo
/// the commit.
bool has_unfinished_commit(const fs::path& file) {
  if (!fs::exists(file.string() + "-journal")) return false;
  try {
    SQLite::Database(file.string(), SQLite::OPEN_READONLY, 2000)
        .execAndGet("SELECT count(*) FROM sqlite_master");
  } catch (const SQLite::Exception& error) {
    return error.getExtendedErrorCode() == SQLITE_READONLY_ROLLBACK;
  }
  return false;
}

/// A copy of a journal and its rollback log, on which SQLite may undo the unfinished commit.
class Copy {
 public:
  explicit Copy(const fs::path& file)
      : folder_(fs::temp_directory_path() / fmt::format("latsch_doctor_{}", ::getpid())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy_file(file, this->file());
    fs::copy_file(file.string() + "-journal", this->file().string() + "-journal");
    SQLite::Database(this->file().string(), SQLite::OPEN_READWRITE)
        .execAndGet("SELECT count(*) FROM sqlite_master");
  }
  ~Copy() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;

  fs::path file() const { return folder_ / "journal"; }

 private:
  fs::path folder_;
};

}  // namespace

JournalReport examine_journal(const fs::path& file) {
  if (!has_unfinished_commit(file)) return Examination(file).run();
  const Copy copy(file);
  JournalReport report = Examination(copy.file()).run();
  report.notes.emplace_back(
      "its process ended during a commit; the log beside it undoes that, as latsch resume does");
  return report;
}

void salvage_journal(const JournalReport& report,
                     const std::optional<StudyIdentity>& identity,
                     const fs::path& file) {
  const std::optional<StudyIdentity>& study = report.identity ? report.identity : identity;
  if (report.rows.empty()) throw InputError("no trial in it is intact: there is nothing to save");
  if (!study) {
    throw InputError(
        "the identity of its study is damaged; name the study, so that the new journal knows which "
        "one it belongs to");
  }
  if (fs::exists(file)) throw InputError({file.string(), 0}, "exists already; name a new file");
  try {
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    SQLite::Transaction transaction(database);
    create_tables(database);
    // A mark states the number of trials before it, so marks are kept only if no trial is missing.
    const bool all = std::ssize(report.rows) == report.expected;
    write_journal_rows(
        database, *study, report.rows, all ? report.marks : std::vector<JournalMark>{});
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    throw InputError({file.string(), 0}, std::string("cannot be written: ") + error.what());
  }
}

}  // namespace latsch
