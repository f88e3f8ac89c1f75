// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/readable_journal.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <unistd.h>

#include <cctype>
#include <string>

namespace latsch {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFirstRead = "SELECT count(*) FROM sqlite_master";

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Returns the path in the form of a SQLite URI. [sqlite.org/uri.html]
std::string uri_of(const fs::path& file) {
  std::string uri = "file:";
  for (const char c : fs::absolute(file).string()) {
    const bool is_plain =
        std::isalnum(static_cast<unsigned char>(c)) || c == '/' || c == '.' || c == '_' || c == '-';
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

bool has_log(const fs::path& file) {
  std::error_code absent;
  for (const char* log : {"-wal", "-journal"}) {
    const auto size = fs::file_size(file.string() + log, absent);
    if (!absent && size > 0) return true;
  }
  return false;
}

/// Opens a copy of the journal and its log, which SQLite may merge there. The folder of the copy is
/// removed at once, because open files stay readable.
std::unique_ptr<SQLite::Database> open_copy(const fs::path& file, int patience) {
  std::string folder = (fs::temp_directory_path() / "latsch_reading_XXXXXX").string();
  if (!::mkdtemp(folder.data())) throw SQLite::Exception("no temporary folder", SQLITE_CANTOPEN);
  const fs::path copy = fs::path(folder) / "journal";
  std::error_code ignored;
  try {
    fs::copy_file(file, copy);
    for (const char* log : {"-wal", "-journal"})
      if (fs::exists(file.string() + log)) fs::copy_file(file.string() + log, copy.string() + log);
    fs::permissions(copy, fs::perms::owner_write, fs::perm_options::add);
    auto database =
        std::make_unique<SQLite::Database>(copy.string(), SQLite::OPEN_READWRITE, patience);
    database->exec("PRAGMA locking_mode = EXCLUSIVE");
    database->execAndGet(kFirstRead);
    fs::remove_all(folder, ignored);
    return database;
  } catch (...) {
    fs::remove_all(folder, ignored);
    throw;
  }
}

}  // namespace

bool may_be_written(const fs::path& file) {
  return ::access(folder_of(file).c_str(), W_OK) == 0 &&
         (!fs::exists(file) || ::access(file.c_str(), W_OK) == 0);
}

std::unique_ptr<SQLite::Database> open_for_reading(const fs::path& file, int patience) {
  try {
    auto database =
        std::make_unique<SQLite::Database>(file.string(), SQLite::OPEN_READONLY, patience);
    database->execAndGet(kFirstRead);
    return database;
  } catch (const SQLite::Exception& error) {
    const int code = error.getErrorCode();
    const bool is_of_folder = code == SQLITE_CANTOPEN || code == SQLITE_READONLY;
    if (!is_of_folder || ::access(file.c_str(), R_OK) != 0 || may_be_written(file)) throw;
  }
  if (has_log(file)) return open_copy(file, patience);
  return std::make_unique<SQLite::Database>(
      uri_of(file) + "?immutable=1", SQLite::OPEN_READONLY | SQLite::OPEN_URI, patience);
}

}  // namespace latsch
