// SPDX-License-Identifier: Apache-2.0
// Reads a journal while another process writes it: each call hands on what has come since the one
// before, so that who watches fifty thousand trials reads each of them once.
//
// Every row is held against its hash and the chain of those before it, as Journal::read does. A
// journal that was put in another's place (latsch run --anew), or copied over it, is noticed and
// read from its beginning.
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
  /// Nothing is opened before the first call; the file need not exist yet.
  explicit JournalFollower(std::filesystem::path file);
  ~JournalFollower();
  JournalFollower(JournalFollower&&) noexcept;
  JournalFollower& operator=(JournalFollower&&) noexcept;

  struct News {
    bool begins_anew = false;  // what was handed on before is of a journal that is gone; the next
                               // call hands on from the beginning of what is there now
    long trials = 0;           // handed on now
    bool has_more = false;     // `most` was reached
    bool has_marks = false;    // marks() are others than before
  };

  /// At most `most` trials, in the order they were kept. Throws InputError where the file is no
  /// journal, JournalError where a row is damaged; trials handed on before stay good. A file that
  /// does not exist has no trials.
  News read(long most, const std::function<void(const Trial&)>& visit);

  /// Of all rows, as far as read() has seen the journal.
  long total() const;
  const StudyIdentity& identity() const;
  const std::vector<JournalMark>& marks() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch
