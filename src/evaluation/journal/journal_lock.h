// SPDX-License-Identifier: Apache-2.0
// Admits one writer for each journal, by an advisory lock on a file beside it that names the
// process holding it. The system releases the lock when that process ends, however it ends.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace latsch {

/// The process that writes a journal.
struct JournalHolder {
  std::string words;           // "process 4711 on lab7 since 2026-03-01 10:12:44 UTC"
  std::optional<int> process;  // process on this machine; nullopt: on another one, or not known
};

class JournalLock {
 public:
  /// Waits briefly while a child of a killed process still holds the lock, until it executes
  /// another program. Throws InputError naming the holder and its machine if another process (or
  /// another Journal of this process) has the lock, or the reason if the file system gives no
  /// locks.
  explicit JournalLock(const std::filesystem::path& journal);
  ~JournalLock();
  JournalLock(const JournalLock&) = delete;
  JournalLock& operator=(const JournalLock&) = delete;

 private:
  std::filesystem::path file_;
  int fd_ = -1;
};

/// Looks up the holder without taking the lock even briefly, so it does not disturb a process that
/// opens the journal. Returns nullopt if nobody holds the lock. A holder on another machine is
/// recognized by the name in the file.
std::optional<JournalHolder> journal_holder(const std::filesystem::path& journal);

}  // namespace latsch
