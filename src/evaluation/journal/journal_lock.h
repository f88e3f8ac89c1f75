// SPDX-License-Identifier: Apache-2.0
// Admits one writer at a time for each journal, by two advisory locks. The first is on a file
// beside the journal that names the process holding it. The second is on the journal itself, so
// that hard links in other folders share it. The system releases both locks when that process ends,
// however it ends.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace latsch {

/// The process that writes a journal.
struct JournalHolder {
  std::string words;           // "process 4711 on lab7 since 2026-03-01 10:12:44 UTC"
  std::optional<int> process;  // number of the process; nullopt: on another machine, or not known
};

class JournalLock {
 public:
  /// Creates an empty journal if there is none. Waits briefly while a child of a killed process
  /// still holds the lock, until it executes another program. Throws InputError naming the holder
  /// and its machine if another process (or another Journal of this process) has the lock, or the
  /// reason if the file system gives no locks.
  explicit JournalLock(const std::filesystem::path& journal);
  ~JournalLock();
  JournalLock(const JournalLock&) = delete;
  JournalLock& operator=(const JournalLock&) = delete;

  /// Returns true if the path still leads to the journal that was locked: nobody has deleted, moved
  /// or replaced it. On file systems that are not local, only a missing file is noticed, because
  /// such systems may change the inode number of a file.
  bool is_in_place() const;
  /// Returns the present name of a journal that was moved; nullopt if it was deleted.
  std::optional<std::filesystem::path> moved_to() const;

 private:
  void lock_itself();

  std::filesystem::path journal_;
  std::filesystem::path file_;
  int fd_ = -1;  // descriptor of the lock file beside the journal
  /// The journal. It is closed after its database, because close(2) releases the locks of SQLite.
  int itself_ = -1;
  bool is_local_ = true;
};

/// Looks up the holder without taking the lock even briefly, so it does not disturb a process that
/// opens the journal. Returns nullopt if nobody holds the lock. A holder on another machine is
/// recognized by the name in the file.
std::optional<JournalHolder> journal_holder(const std::filesystem::path& journal);

}  // namespace latsch
