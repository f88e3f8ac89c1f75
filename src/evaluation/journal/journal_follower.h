// SPDX-License-Identifier: Apache-2.0
// Reads a journal while another process writes it. Each call visits the trials that came since the
// call before, so that a viewer of fifty thousand trials reads each of them once.
//
// Every row is checked against its hash and the chain of the rows before it, as in Journal::read. A
// journal that was replaced (latsch run --anew), or copied over, is noticed and read from its
// beginning.
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
    bool begins_anew = false;  // true if earlier trials belong to a journal that is gone; the next
                               // call starts at the beginning of the present one
    long trials = 0;           // number of trials visited by this call
    bool has_more = false;     // true if `most` was reached
    bool has_marks = false;    // true if marks() changed
  };

  /// Visits at most `most` trials, in the order of the journal. Throws InputError if the file is no
  /// journal, JournalError if a row is damaged; trials visited before stay valid. A file that does
  /// not exist has no trials.
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
