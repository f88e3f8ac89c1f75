// SPDX-License-Identifier: Apache-2.0
// Permanent record of all evaluations: an append-only SQLite file with every finished trial, all
// its channels or its failure, and a hash on every row. A trial is acknowledged once it is on the
// disk. A restart reads the file again.
//
// One process writes (a lock file beside the journal names it); any number of processes may read
// meanwhile. If somebody deletes, moves or replaces the file while it is written, the writer
// notices this at its next read or write: it saves all trials under another name and throws a
// JournalError that contains this name.
//
// SQLite's write-ahead log needs memory that reader and writer share, which network file systems do
// not offer. On these the journal uses a rollback log. A commit then waits for the disk several
// times instead of once, and waits until readers have finished.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "evaluation/journal/journal_mark.h"
#include "evaluation/journal/study_identity.h"
#include "evaluation/journal/trial_store.h"

namespace latsch {

class Journal : public TrialStore {
 public:
  /// The log by which SQLite makes a commit complete or void. Readers need not wait for the
  /// write-ahead log. The rollback journal also works on file systems that several machines share.
  enum class Log { write_ahead, rollback };

  /// Opens the journal for writing, or creates it. Throws InputError if it belongs to another study
  /// (naming the part and the line that differ), if it is no journal or one of a newer format, or
  /// if it is in use (naming the process). A journal of an older format is converted to the present
  /// one; a copy of the original stays beside it.
  static Journal open(const std::filesystem::path& file, const StudyIdentity& identity);
  /// Opens the journal with the given type of log, whatever its file system.
  static Journal open(const std::filesystem::path& file, const StudyIdentity& identity, Log log);

  /// Assigns the trials of a journal to this study although the version of the model or of an
  /// outside program differs; a copy of the original stays beside it. Returns false if nothing
  /// differs. Throws InputError if more than the version differs.
  static bool adopt(const std::filesystem::path& file, const StudyIdentity& identity);

  /// Opens for reading, also while another process writes. append() is not allowed.
  static Journal read(const std::filesystem::path& file);
  /// Opens the journal for reading. Throws InputError if it belongs to another study, as open()
  /// does, but ignores differences in the files of an outside program.
  static Journal read(const std::filesystem::path& file, const StudyIdentity& identity);

  /// A journal can be moved, not copied. The journal that was moved from must not be used.
  Journal(Journal&&) noexcept;
  /// Closes this journal and takes over the other.
  Journal& operator=(Journal&&) noexcept;
  ~Journal() override;

  /// Writes all trials in one transaction. They are on the disk when it returns.
  void append(std::span<const Trial> trials) override;
  /// Writes one trial. It is on the disk when it returns.
  void append(const Trial& trial) { append(std::span(&trial, 1)); }

  /// Throws JournalError naming the row that does not agree with its hash.
  void for_each(const std::function<void(const Trial&)>& visit) const override;
  /// Returns all trials in the order in which they were written.
  std::vector<Trial> trials() const;
  /// Visits only the requested trials (asked_trials.h), from which results are taken.
  void for_each_asked(const std::function<void(const Trial&)>& visit) const;

  /// Begins to record which points the search requests; marks are written for them if these add
  /// information.
  void begin_asking() override;
  /// Stores these points as requested by the search.
  void keep_asked(const std::set<std::string>& points) override;

  /// Writes a mark, which is on the disk when it returns. Marks keep their order.
  void mark(const std::string& kind, const std::string& text);
  /// Returns the marks in the order in which they were written.
  const std::vector<JournalMark>& marks() const;

  /// Returns the number of trials.
  long size() const;
  /// The file of the journal.
  const std::filesystem::path& file() const;

  /// The identity of the study that the trials belong to.
  const StudyIdentity& identity() const;

 private:
  struct Impl;
  explicit Journal(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch
