// SPDX-License-Identifier: Apache-2.0
// Describes the damage of a journal file in words and saves what is intact.
//
// Only rows that agree with their hash count as intact, so intact rows are exactly as written. The
// file itself is never changed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/journal/journal_format.h"

namespace latsch {

struct JournalReport {
  /// Format of the journal; 0: not known, or no journal at all.
  int format = 0;
  /// Number of trials that the file states; -1: not readable.
  long expected = -1;
  std::optional<StudyIdentity> identity;   // set if the identity is intact
  std::vector<journal_format::Row> rows;   // intact rows, unpacked, in the order of their numbers
  std::vector<JournalMark> marks = {};     // set if all marks are intact
  std::vector<std::string> findings = {};  // damages, one sentence each; empty if there are none
  std::vector<std::string> notes = {};     // information that is not about damages

  bool healthy() const { return findings.empty(); }
};

/// Reads every page and checks every hash. Throws InputError only if the file cannot be read at
/// all.
JournalReport examine_journal(const std::filesystem::path& file);

/// Writes the intact trials to a new journal, which must not exist. `identity` replaces a damaged
/// one. Throws InputError if there is nothing to save or no identity.
void salvage_journal(const JournalReport& report,
                     const std::optional<StudyIdentity>& identity,
                     const std::filesystem::path& file);

}  // namespace latsch
