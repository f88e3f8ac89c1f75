// SPDX-License-Identifier: Apache-2.0
// Reads a journal while another process writes it. Each call visits the trials that were added
// since the previous call, so that a viewer of fifty thousand trials reads each of them once.
//
// Every row is checked against its hash and the chain of hashes, as in Journal::read. If the
// journal was replaced (latsch run --anew) or overwritten by a copy of another one, the follower
// notices this and reads the new journal from its beginning.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "evaluation/journal/journal_mark.h"
#include "evaluation/journal/study_identity.h"
#include "evaluation/trial/trial.h"

namespace latsch {

class JournalFollower {
 public:
  /// Opens nothing before the first call; the file need not exist yet.
  explicit JournalFollower(std::filesystem::path file);
  ~JournalFollower();
  JournalFollower(JournalFollower&&) noexcept;
  JournalFollower& operator=(JournalFollower&&) noexcept;

  struct News {
    /// True if the trials visited earlier belong to a journal that does not exist any more; the
    /// next call starts at the beginning of the present one.
    bool begins_anew = false;
    long trials = 0;         // number of trials visited by this call
    bool has_more = false;   // true if the limit `most` was reached
    bool has_marks = false;  // true if marks() has changed
  };

  /// Visits at most `most` trials, in the order of the journal. Throws InputError if the file is no
  /// journal, and JournalError if a row is damaged; the trials visited before the damaged one
  /// remain valid. A file that does not exist counts as a journal without trials.
  News read(long most, const std::function<void(const Trial&)>& visit);

  /// Returns the number of rows in the journal at the last read().
  long total() const;
  const StudyIdentity& identity() const;
  const std::vector<JournalMark>& marks() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch
