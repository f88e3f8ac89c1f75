// SPDX-License-Identifier: Apache-2.0
// What is wrong with a journal file, in words, and what can be saved of it.
//
// Nothing is believed that does not agree with its hash: what a report calls intact is what was
// written, bit by bit. The file itself is never changed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/journal/journal_format.h"

namespace latsch {

struct JournalReport {
  int format = 0;                          // 0: not known, or not a journal at all
  long expected = -1;                      // trials by its own tally; -1: not readable
  std::optional<StudyIdentity> identity;   // where it is intact
  std::vector<journal_format::Row> rows;   // intact ones, unpacked, in the order of their numbers
  std::vector<JournalMark> marks = {};     // where all of them are intact
  std::vector<std::string> findings = {};  // a sentence each; empty: everything is as written
  std::vector<std::string> notes = {};     // worth knowing, but no damage

  bool healthy() const { return findings.empty(); }
};

/// Reads every page and checks every hash. Throws InputError only where the file cannot be read at
/// all.
JournalReport examine_journal(const std::filesystem::path& file);

/// Writes the intact trials to a new journal, which must not exist. `identity` stands in for a
/// damaged one. Throws InputError where there is nothing to save or no identity.
void salvage_journal(const JournalReport& report,
                     const std::optional<StudyIdentity>& identity,
                     const std::filesystem::path& file);

}  // namespace latsch
