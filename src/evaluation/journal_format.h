// SPDX-License-Identifier: Apache-2.0
// The tables of a journal file and the hashes on their rows, shared by those who write, check,
// migrate and salvage it.
//
// Every trial carries two hashes [FNV-1a, encoding.h]: `content` over its own columns, so that it
// can be trusted alone, and `hash` over `content` and the `hash` of the row before it, so that a
// row that is missing or exchanged is seen. The chain starts at the hash of the study's identity.
//
//   format 1   no `content`; `hash` is over the columns and the hash before
//   format 2   as above; failures say their cause
//   format 3   outcomes say the CPU time of outside programs
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/study_identity.h"
#include "evaluation/trial.h"

namespace latsch::journal_format {

inline constexpr int kApplicationId = 0x4C747368;  // "Ltsh", so that file(1) and we know our own
inline constexpr int kFormat = 3;

/// Creates the tables; the file says it is a journal of kFormat.
void create_tables(SQLite::Database& database);

std::uint64_t hash_of(const IdentityPart& part, std::uint64_t before);
std::uint64_t hash_of(const StudyIdentity& identity);

/// SQLite's integers have a sign.
inline std::int64_t stored(std::uint64_t hash) { return static_cast<std::int64_t>(hash); }

/// One row of `trials`.
struct Row {
  std::int64_t number = 0;
  std::string point;
  std::string outcome;
  std::string finished;  // UTC, ISO 8601
  std::int64_t content = 0;
  std::int64_t hash = 0;

  /// What `content` has to be.
  std::uint64_t own_hash() const;
  /// What `hash` has to be after a row with that hash.
  std::uint64_t chained(int format, std::uint64_t before) const;
  std::optional<Trial> decode() const;
};

/// A new row for a trial that has just finished.
Row make_row(std::int64_t number, const Trial& trial, std::uint64_t before);

/// Columns of a row in the order of Row, for a journal of that format.
std::string columns(int format);
Row read_row(SQLite::Statement& select, int format);
void bind_row(SQLite::Statement& insert, const Row& row);
inline constexpr const char* kInsert = "INSERT INTO trials VALUES (?, ?, ?, ?, ?, ?)";

/// Writes the identity and an empty tally.
void write_identity(SQLite::Database& database, const StudyIdentity& identity);
/// Counts the trials and keeps the last hash, so that a lost last row is seen.
void write_tally(SQLite::Database& database, std::int64_t trials, std::uint64_t last_hash);

/// Writes identity, trials, numbered anew from 1, and tally into empty tables.
void write_journal_rows(SQLite::Database& database,
                        const StudyIdentity& identity,
                        std::vector<Row> rows);

std::string text_of(const SQLite::Column& column);

}  // namespace latsch::journal_format
