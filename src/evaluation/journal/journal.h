// SPDX-License-Identifier: Apache-2.0
// What has been evaluated, for good: an append-only SQLite file with every finished trial, all its
// channels or its failure, and a hash on every row. A trial is acknowledged once it is on the disk;
// restart = read it again.
//
// One process writes (a lock file beside the journal names it); any number may read meanwhile.
//
// SQLite's write-ahead log needs memory that reader and writer share, which network file systems do
// not have: there the journal keeps a rollback log. A commit then waits for the disk several
// times instead of once, and for readers.
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
  enum class Log { write_ahead, rollback };

  /// Opens the journal for writing, or creates it. Throws InputError where it belongs to another
  /// study (naming the part and the line that differ), is no journal or one of a newer format, or
  /// is in use (naming the process). A journal of an older format is brought to the present one; a
  /// copy as it was stays beside it.
  static Journal open(const std::filesystem::path& file, const StudyIdentity& identity);
  /// With that log, wherever it lies.
  static Journal open(const std::filesystem::path& file, const StudyIdentity& identity, Log log);

  /// Takes the trials of a journal for those of this study although the version of the model or of
  /// an outside program was another one; a copy as it was stays beside it. False where nothing
  /// differs. Throws InputError where more does.
  static bool adopt(const std::filesystem::path& file, const StudyIdentity& identity);

  /// Opens for reading, also while another process writes. append() is not allowed.
  static Journal read(const std::filesystem::path& file);
  /// Throws InputError where it belongs to another study, as open() does, the files of an outside
  /// program aside.
  static Journal read(const std::filesystem::path& file, const StudyIdentity& identity);

  Journal(Journal&&) noexcept;
  Journal& operator=(Journal&&) noexcept;
  ~Journal() override;

  /// On the disk, all of them in one transaction, when it returns.
  void append(std::span<const Trial> trials) override;
  void append(const Trial& trial) { append(std::span(&trial, 1)); }

  /// Throws JournalError naming the row that does not agree with its hash.
  void for_each(const std::function<void(const Trial&)>& visit) const override;
  std::vector<Trial> trials() const;
  /// Without what nobody asked for (asked_trials.h): what results are taken from.
  void for_each_asked(const std::function<void(const Trial&)>& visit) const;

  /// As marks, where they say anything new.
  void begin_asking() override;
  void keep_asked(const std::set<std::string>& points) override;

  /// On the disk when it returns. In the order they were made.
  void mark(const std::string& kind, const std::string& text);
  const std::vector<JournalMark>& marks() const;

  long size() const;
  const std::filesystem::path& file() const;

  const StudyIdentity& identity() const;

 private:
  struct Impl;
  explicit Journal(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch
