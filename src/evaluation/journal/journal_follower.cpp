// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/journal_follower.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <optional>

#include "base/error.h"
#include "evaluation/journal/journal.h"
#include "evaluation/journal/journal_format.h"
#include "evaluation/journal/readable_journal.h"

namespace latsch {

using namespace journal_format;

namespace {

constexpr int kPatienceOfReader = 2000;  // ms

/// Identity, size and time of last change of the file at a path.
struct FileThere {
  dev_t device;
  ino_t number;
  off_t size;
  timespec written;

  bool is_same_file(const FileThere& other) const {
    return device == other.device && number == other.number;
  }
  /// True if the file was not written since. Content of the log beside it does not count.
  bool is_untouched(const FileThere& other) const {
    return size == other.size && written.tv_sec == other.written.tv_sec &&
           written.tv_nsec == other.written.tv_nsec;
  }
};
std::optional<FileThere> file_at(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return std::nullopt;
  return FileThere{found.st_dev, found.st_ino, found.st_size, found.st_mtim};
}

}  // namespace

struct JournalFollower::Impl {
  std::filesystem::path file;
  std::optional<FileThere> opened;
  std::unique_ptr<SQLite::Database> database;
  int format = kFormat;
  StudyIdentity identity;
  std::vector<JournalMark> marks;
  std::optional<RowDecoder> decoder;
  std::int64_t number = 0;  // number of the last row visited
  std::uint64_t state = 0;  // hash of the chain at the last row visited
  std::int64_t total = 0;   // number of rows at the time of the last read
  std::int64_t marks_seen = -1;

  void close() {
    database.reset();
    opened.reset();
    identity.clear();
    marks.clear();
    number = total = 0;
    marks_seen = -1;
  }

  void open() {
    opened = file_at(file);
    // Throws an InputError that describes any fault of the file.
    identity = Journal::read(file).identity();
    database = open_for_reading(file, kPatienceOfReader);
    format = database->execAndGet("PRAGMA user_version").getInt();
    decoder.emplace(format);
    state = hash_of(identity);
  }

  /// True if the row visited last is still in the file and belongs to the same study. This is
  /// checked whenever the file was written, because another journal can be copied over this one:
  /// the inode stays the same then, and SQLite keeps pages of the old journal.
  bool has_what_was_handed_on() {
    const auto there = file_at(file);
    if (!there || !opened->is_same_file(*there)) return false;
    if (opened->is_untouched(*there)) return true;
    try {
      const StudyIdentity before = identity;
      const std::uint64_t there_before = state;
      open();
      state = there_before;
      if (identity != before) return false;
      if (number == 0) return true;
      SQLite::Statement select(*database, "SELECT hash FROM trials WHERE number = ?");
      select.bind(1, number);
      return select.executeStep() && select.getColumn(0).getInt64() == stored(state);
    } catch (const std::runtime_error&) {  // a half-written file; the next read reports the error
      return false;
    }
  }

  [[noreturn]] void damaged(std::int64_t at, const char* what) const {
    throw JournalError(
        fmt::format("{}: trial {} {}: the file is damaged; latsch doctor says what can be saved",
                    file.string(),
                    at,
                    what));
  }

  void hand_on(const Row& row, const std::function<void(const Trial&)>& visit) {
    if (row.number != number + 1) damaged(number + 1, "is missing");
    const std::uint64_t next = row.chained(format, state);
    if (stored(next) != row.hash || stored(row.own_hash()) != row.content)
      damaged(row.number, "does not agree with its hash");
    const auto trial = decoder->decode(row);
    if (!trial) damaged(row.number, "cannot be decoded");
    state = next;
    number = row.number;
    visit(*trial);
  }

  News read(long most, const std::function<void(const Trial&)>& visit) {
    News news;
    if (opened && !has_what_was_handed_on()) {
      close();
      news.begins_anew = news.has_more = true;
      return news;
    }
    if (!database) {
      if (!file_at(file)) return news;
      open();
    }
    // Reads number of trials, marks and rows as they were at one moment.
    SQLite::Transaction snapshot(*database);
    const auto tally = read_tally(*database, format);
    if (!tally) damaged(number + 1, "or the tally of the trials is missing");
    if (tally->trials < number) damaged(number, "is gone");
    total = tally->trials;
    if (format >= 4 && tally->marks != marks_seen) {
      auto read = read_marks(*database, *tally);
      if (!read) damaged(number, "has marks beside it that do not agree with their hashes");
      marks = std::move(*read);
      news.has_marks = marks_seen >= 0 || !marks.empty();
      marks_seen = tally->marks;
    }
    SQLite::Statement select(
        *database,
        "SELECT " + columns(format) + " FROM trials WHERE number > ? ORDER BY number LIMIT ?");
    select.bind(1, number);
    select.bind(2, static_cast<std::int64_t>(most));
    while (select.executeStep()) {
      hand_on(read_row(select, format), visit);
      ++news.trials;
    }
    news.has_more = number < total;
    return news;
  }
};

JournalFollower::JournalFollower(std::filesystem::path file) : impl_(std::make_unique<Impl>()) {
  impl_->file = std::move(file);
}
JournalFollower::~JournalFollower() = default;
JournalFollower::JournalFollower(JournalFollower&&) noexcept = default;
JournalFollower& JournalFollower::operator=(JournalFollower&&) noexcept = default;

JournalFollower::News JournalFollower::read(long most,
                                            const std::function<void(const Trial&)>& visit) {
  try {
    return impl_->read(most, visit);
  } catch (const SQLite::Exception& error) {
    throw JournalError(
        fmt::format("{}: cannot be read just now ({})", impl_->file.string(), error.what()));
  }
}

long JournalFollower::total() const { return static_cast<long>(impl_->total); }
const StudyIdentity& JournalFollower::identity() const { return impl_->identity; }
const std::vector<JournalMark>& JournalFollower::marks() const { return impl_->marks; }

}  // namespace latsch
