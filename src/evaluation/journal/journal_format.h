// SPDX-License-Identifier: Apache-2.0
// Tables of a journal file and the hashes on their rows, shared by the code that writes, checks,
// migrates and salvages journals.
//
// Every trial has two hashes [FNV-1a, encoding.h]: `content` over its own columns, so that the
// trial can be verified alone, and `hash` over `content` and the `hash` of the row before it, so
// that a missing or exchanged row is detected. The chain starts at the hash of the study's
// identity.
//
//   format 1   no `content`; `hash` is over the columns and the `hash` of the row before
//   format 2   hashes as above; failures state their cause
//   format 3   outcomes state the CPU time of outside programs
//   format 4   outcomes are packed (outcome_packing.h); there are marks
//   format 5   channels have slopes
//
// A mark records an event between two trials: a search that knew all earlier trials began, failed
// trials are to be repeated, or new limits hold. A resumed run therefore starts with the same
// knowledge as the interrupted one.
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

/// Identifies the file type for file(1) and for Latsch; the bytes spell "Ltsh".
inline constexpr int kApplicationId = 0x4C747368;
inline constexpr int kFormat = 5;

/// Creates the tables and marks the file as a journal of kFormat.
void create_tables(SQLite::Database& database);

std::uint64_t hash_of(const IdentityPart& part, std::uint64_t before);
std::uint64_t hash_of(const StudyIdentity& identity);

/// Converts a hash to SQLite's signed integer.
inline std::int64_t stored(std::uint64_t hash) { return static_cast<std::int64_t>(hash); }

/// One row of `trials`.
struct Row {
  std::int64_t number = 0;
  std::string point;
  std::string outcome;
  std::string finished;  // UTC, ISO 8601
  std::int64_t content = 0;
  std::int64_t hash = 0;

  /// Returns the value that the column `content` must have.
  std::uint64_t own_hash() const;
  /// Returns the value that the column `hash` must have if the previous row's is `before`.
  std::uint64_t chained(int format, std::uint64_t before) const;
  /// Decodes the trial of a row whose outcome is not packed.
  std::optional<Trial> decode() const;
};

/// Makes the row of a trial that has just finished.
Row make_row(std::int64_t number, const Trial& trial, std::uint64_t before, OutcomePacker& packer);

/// Decodes the trials of one journal's rows, in the order of their numbers.
class RowDecoder {
 public:
  explicit RowDecoder(int format) : format_(format) {}
  /// Returns nullopt if the row is damaged or refers to a missing row.
  std::optional<Trial> decode(const Row& row);

 private:
  int format_;
  OutcomeUnpacker unpacker_;
};

/// Returns the row with its unpacked outcome.
Row unpacked(Row row, const Trial& trial);

/// Returns the columns of a row in the order of Row, for a journal of that format.
std::string columns(int format);
Row read_row(SQLite::Statement& select, int format);
void bind_row(SQLite::Statement& insert, const Row& row);
inline constexpr const char* kInsert = "INSERT INTO trials VALUES (?, ?, ?, ?, ?, ?)";

/// Writes the identity and an empty tally.
void write_identity(SQLite::Database& database, const StudyIdentity& identity);
/// Number of trials and hash of the last row, by which the loss of the last rows is detected.
struct Tally {
  std::int64_t trials = 0;
  std::uint64_t hash = 0;
  std::int64_t marks = 0;
  std::uint64_t marks_hash = kHashStart;
};
void write_tally(SQLite::Database& database, const Tally& tally);
/// Returns nullopt if the tally is missing.
std::optional<Tally> read_tally(SQLite::Database& database, int format);

/// Writes identity, trials (renumbered from 1), marks and tally into empty tables. The outcomes of
/// `rows` must not be packed.
void write_journal_rows(SQLite::Database& database,
                        const StudyIdentity& identity,
                        std::vector<Row> rows,
                        const std::vector<JournalMark>& marks = {});

/// Adds a mark and counts it; the caller writes the tally.
void write_mark(SQLite::Database& database, const JournalMark& mark, Tally& tally);
/// Returns nullopt if a mark does not agree with its hash, or with the tally.
std::optional<std::vector<JournalMark>> read_marks(SQLite::Database& database, const Tally& tally);

std::string text_of(const SQLite::Column& column);

}  // namespace latsch::journal_format
