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
  int format = 0;                          // 0: not known, or no journal at all
  long expected = -1;                      // number of trials in its own tally; -1: not readable
  std::optional<StudyIdentity> identity;   // set if the identity is intact
  std::vector<journal_format::Row> rows;   // intact rows, unpacked, in the order of their numbers
  std::vector<JournalMark> marks = {};     // set if all of them are intact
  std::vector<std::string> findings = {};  // one sentence each; empty: everything is as written
  std::vector<std::string> notes = {};     // information that is no damage

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
