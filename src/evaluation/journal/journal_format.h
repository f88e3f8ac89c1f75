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
//   format 4   outcomes are packed (outcome_packing.h); there are marks
//   format 5   channels have slopes
//
// A mark says what happened between two trials: that a search began which knew all of those before
// it, that failed ones are to be tried again, which limits hold from here on. So a run that goes on
// knows what it knew at first.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/journal/journal_mark.h"
#include "evaluation/journal/outcome_packing.h"
#include "evaluation/journal/study_identity.h"
#include "evaluation/trial/encoding.h"
#include "evaluation/trial/trial.h"

namespace latsch::journal_format {

inline constexpr int kApplicationId = 0x4C747368;  // "Ltsh", so that file(1) and we know our own
inline constexpr int kFormat = 5;

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
  /// Where its outcome is not packed.
  std::optional<Trial> decode() const;
};

/// A new row for a trial that has just finished.
Row make_row(std::int64_t number, const Trial& trial, std::uint64_t before, OutcomePacker& packer);

/// Trials of rows of one journal, in the order of their numbers.
class RowDecoder {
 public:
  explicit RowDecoder(int format) : format_(format) {}
  /// nullopt also where the row refers to one that is missing.
  std::optional<Trial> decode(const Row& row);

 private:
  int format_;
  OutcomeUnpacker unpacker_;
};

/// With its outcome as it was before it was packed.
Row unpacked(Row row, const Trial& trial);

/// Columns of a row in the order of Row, for a journal of that format.
std::string columns(int format);
Row read_row(SQLite::Statement& select, int format);
void bind_row(SQLite::Statement& insert, const Row& row);
inline constexpr const char* kInsert = "INSERT INTO trials VALUES (?, ?, ?, ?, ?, ?)";

/// Writes the identity and an empty tally.
void write_identity(SQLite::Database& database, const StudyIdentity& identity);
/// How many rows there are, and the hash of the last one: so a lost last row is seen.
struct Tally {
  std::int64_t trials = 0;
  std::uint64_t hash = 0;
  std::int64_t marks = 0;
  std::uint64_t marks_hash = kHashStart;
};
void write_tally(SQLite::Database& database, const Tally& tally);
/// nullopt where it is missing.
std::optional<Tally> read_tally(SQLite::Database& database, int format);

/// Writes identity, trials, numbered anew from 1, marks and tally into empty tables. The outcomes
/// of the rows are not packed.
void write_journal_rows(SQLite::Database& database,
                        const StudyIdentity& identity,
                        std::vector<Row> rows,
                        const std::vector<JournalMark>& marks = {});

/// Adds a mark and counts it; the tally is left to the caller to write.
void write_mark(SQLite::Database& database, const JournalMark& mark, Tally& tally);
/// nullopt where one does not agree with its hash, or with the tally.
std::optional<std::vector<JournalMark>> read_marks(SQLite::Database& database, const Tally& tally);

std::string text_of(const SQLite::Column& column);

}  // namespace latsch::journal_format
