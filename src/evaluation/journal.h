// SPDX-License-Identifier: Apache-2.0
// What has been evaluated, for good: an append-only SQLite file with every finished trial, all its
// channels or its failure, and a hash on every row. A trial is acknowledged once it is on the disk;
// restart = read it again.
//
// One process writes (a lock file beside the journal names it); any number may read meanwhile.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluation/study_identity.h"
#include "evaluation/trial.h"

namespace latsch {

/// The journal cannot be written or is damaged: the disk is full, a row does not agree with its
/// hash.
class JournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Journal {
 public:
  /// Opens the journal for writing, or creates it. Throws InputError where it belongs to another
  /// study (naming the part and the line that differ), is no journal or one of another version, is
  /// in use (naming the process), or lies on a network file system.
  static Journal open(const std::filesystem::path& file, const StudyIdentity& identity);

  /// Opens for reading, also while another process writes. append() is not allowed.
  static Journal read(const std::filesystem::path& file);

  Journal(Journal&&) noexcept;
  Journal& operator=(Journal&&) noexcept;
  ~Journal();

  /// On the disk when it returns. Throws JournalError; what was appended before stays.
  void append(const Trial& trial);

  /// Every trial in the order they finished. Throws JournalError naming the row that does not agree
  /// with its hash.
  void for_each(const std::function<void(const Trial&)>& visit) const;
  std::vector<Trial> trials() const;
  long size() const;

  const StudyIdentity& identity() const;

 private:
  struct Impl;
  explicit Journal(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch
